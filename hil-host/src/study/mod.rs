//! Studies of a damper: replay of a recording, bench test, verification against the reference.

pub mod accuracy_limits;
pub mod bench_test;
mod error;
pub mod excitation;
pub mod published;
pub mod replay;
mod scalar;
pub mod shim_valves;
pub mod verification;

pub use error::StudyError;
pub use scalar::Scalar;
