//! Calibration of dampers from synthetic bench tests with known parameters.

mod causes;
mod fits;
mod intervals_with_offsets;
mod several_tests;
