//! Runs of vehicles: coupling with dampers outside, and indices.

mod coupled;
mod vehicle_indices;
