//! Functions outside the step, the same bits on every machine (software, by `libm`).

pub(crate) use libm::{log, log10, pow, sqrt};
