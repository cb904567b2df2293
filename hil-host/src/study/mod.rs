//! Studies of a damper: replay of a recording, bench test, verification against the reference.

pub mod bench_test;
mod error;
pub mod excitation;
pub mod promise;
pub mod published;
pub mod replay;
mod scalar;
pub mod shim_valves;
pub mod verification;

use std::ops::RangeInclusive;

pub use error::StudyError;
pub use scalar::{NamedScalar, Scalar};

/// Steps that dampers are built for (s).
pub const STEP_RANGE_S: RangeInclusive<f64> = 1e-6..=2e-2;
