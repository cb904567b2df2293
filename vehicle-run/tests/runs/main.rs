//! Runs of vehicles: starts, events, coupling with external dampers, and indices.

mod contacts;
mod coupled;
mod documented_indices;
mod events;
mod start;
mod vehicle_indices;
mod wear;
