//! Runs of vehicles: coupling with external dampers, and indices.

mod coupled;
mod vehicle_indices;
