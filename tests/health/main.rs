//! The estimator of health: faults found over many rides and dampers, none found where there is none, data that the
//! core did not make, and input that no sensor should give.

mod faults;
mod healthy;
mod made;
mod other_data;
mod robustness;
mod sensor_faults;
mod sensors;
mod vehicle;

mod dead_force_channel_was_called_healthy;
mod force_offset_broke_intervals;
mod friction_was_called_flow_and_clearance;
mod late_force_was_called_stiffness;
mod little_motion_kept_old_intervals;
