#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod accuracy_limits;
pub mod bench_sheet;
pub mod bench_test;
pub mod compiled;
mod error;
pub mod excitation;
pub mod health;
pub mod limits;
pub mod measured_sheet;
pub mod motion;
pub mod plate;
pub mod published;
pub mod recorded_health;
pub mod replay;
pub mod response;
pub mod shim_report;
pub mod shim_valves;
pub mod smoothing;
pub mod steady;
pub mod step_errors;
pub mod swept_sine;
pub mod trend;
pub mod verification;

pub use error::TestbenchError;
