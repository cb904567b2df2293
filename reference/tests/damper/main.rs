//! Compares the reference with closed forms, printed values and a second solver.

mod agreement;
mod common;
mod laws;
mod robustness;
