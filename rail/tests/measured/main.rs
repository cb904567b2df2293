//! Measured profiles: files of every format, overhanging points, and texts of every wrong kind.

mod common;
mod damaged;
mod formats;
mod overhang;
mod smoothing;
