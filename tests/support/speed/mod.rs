//! Table of speeds: each figure beside a yardstick from the same run and its goal.
//!
//! `cargo xtask bench` measures the figures and prints the table; docs/performance.md explains the lines.

mod lines;
mod measured;
mod table;

pub use lines::{Goal, LINES, Line, Source, Yardstick};
pub use measured::Measured;
pub use table::table;
