//! Tests of pacing and timing with simulated clocks.

mod pacing;
mod timing;
