//! Compares real-time steps of the locomotive with closed forms, balances and an independent solution.

mod curving;
mod eigenvalues;
mod energy;
mod flexible_rails_diverged;
mod mirror;
mod rails;
mod reference;
mod rest;
mod state_of_another_vehicle_panicked;
mod states;
mod support;
mod wrong_number_was_ignored;
mod yaw_dampers_had_no_modes;
