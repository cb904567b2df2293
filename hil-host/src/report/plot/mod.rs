//! Plots as SVG, all in one style.

pub(crate) mod curves;
pub(crate) mod envelope;
pub(crate) mod loops;
pub(crate) mod map;
pub(crate) mod response;
pub(crate) mod sheet;
pub(crate) mod style;
