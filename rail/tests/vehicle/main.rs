//! A vehicle at standstill against closed forms and independent computations.

mod closed_forms;
mod errors;
mod modes_turned_in_a_circle;
mod random;
mod running;
