//! What is asked of a damper: replay of a recording, bench test, verification against the reference.

pub mod bench_test;
pub mod excitation;
pub mod published;
pub mod replay;
pub mod shim_valves;
pub mod verification;
