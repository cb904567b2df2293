//! Elementary functions for use outside the step, from `libm`, which gives the same bits on every machine.

pub(crate) use libm::{log, log10, pow, sqrt};
