//! Calibration of dampers from synthetic bench tests with known parameters.

mod fits;
mod intervals_with_offsets;
