//! A vehicle at standstill against closed forms and independent computations.

mod closed_forms;
mod errors;
mod random;
mod running;
