//! Tests of pacing and timing with simulated clocks.

mod histogram;
mod pacing;
mod timing;
