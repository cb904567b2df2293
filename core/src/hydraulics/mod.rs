//! Hydraulics: flow through each path as a function of pressure, piston velocity of each side as a function of force.

mod compressed;
mod corner;
mod flow;
mod largest_pressure;
mod side;
mod two_chamber;

pub use corner::Corner;
pub(crate) use flow::{Laws, jet_velocity};
pub(crate) use side::{Chamber, Corners, HydraulicSide};
