//! Elementary functions outside the step, from `libm`: software that gives the same bits on every machine.

pub(crate) use libm::{log, log10, pow, sqrt};
