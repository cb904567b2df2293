//! SVG plots in one style.

pub mod curves;
pub mod envelope;
pub mod loops;
pub mod map;
pub mod response;
pub mod sheet;
pub mod style;
