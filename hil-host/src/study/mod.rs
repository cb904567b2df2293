//! Studies of a damper: replay of a recording, bench test, verification against the reference; of its shim packs as plates; of a vehicle on a track.

pub mod accuracy_limits;
pub mod bench_index;
pub mod bench_sheet;
pub mod bench_test;
pub mod calibration;
mod error;
pub mod excitation;
pub mod health;
pub mod motion;
pub mod plate;
pub mod published;
pub mod replay;
pub mod response;
mod scalar;
pub mod shim_valves;
mod smoothing;
pub mod step_errors;
mod stretches;
pub mod sweep;
pub mod swept_sine;
pub mod tick_grid;
pub mod vehicle;
pub mod verification;
pub mod wheelset_geometry;
pub mod workers;

pub use error::StudyError;
pub use scalar::Scalar;
