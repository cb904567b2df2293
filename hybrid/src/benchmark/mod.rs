//! The published benchmark of real-time hybrid simulation.
//!
//! A frame of three storeys stands on moving ground. Its first storey is a specimen that an actuator moves; the rest is
//! computed at 4096 Hz. C. E. Silva, D. Gomez, A. Maghareh, S. J. Dyke, B. F. Spencer Jr., "Benchmark control problem
//! for real-time hybrid simulation", Mechanical Systems and Signal Processing 135 (2020) 106381.

mod criteria;
mod ground;
mod plant;
mod run;
mod structure;

pub use criteria::Criteria;
pub use ground::{at_ticks, chirp, earthquake};
pub use plant::Plant;
pub use run::{Control, RunError, Sensors, run};

/// Rate of the ticks (Hz).
pub const RATE_HZ: f64 = 4096.0;
/// Number of cases of the structure.
pub const CASES: usize = 4;
