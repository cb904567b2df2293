//! Runs of vehicles: coupling with external dampers, and indices.

mod contacts;
mod coupled;
mod events;
mod vehicle_indices;
mod wear;
