//! The estimator of health: faults found over many rides and dampers, none found where there is none, data that the
//! core did not make, and input that no sensor should give.

mod faults;
mod healthy;
mod made;
mod other_data;
mod robustness;
mod vehicle;
