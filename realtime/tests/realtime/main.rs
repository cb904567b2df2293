//! Pacing and timing with clocks of the tests.

mod pacing;
mod timing;
