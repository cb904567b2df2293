//! Plots as SVG, all in one style.

pub(crate) mod curves;
pub(crate) mod style;
