//! Measured profiles: files of every format, overhanging points, and damaged files.

mod common;
mod damaged;
mod formats;
mod mistakes;
mod overhang;
mod smoothing;
