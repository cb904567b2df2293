//! The health estimator: it finds faults over many rides and dampers, reports none in healthy ones, and handles data
//! from outside the core and input that no sensor should deliver.

mod faults;
mod healthy;
mod other_data;
mod robustness;
mod sensor_faults;
mod sensors;
mod synthetic;
mod vehicle;

mod dead_force_channel_was_called_healthy;
mod force_offset_broke_intervals;
mod friction_was_called_flow_and_clearance;
mod late_force_was_called_stiffness;
mod little_motion_kept_old_intervals;
