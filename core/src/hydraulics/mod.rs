//! Hydraulics: pressure to flow through each path, force to piston velocity of each side.

mod compressed;
mod flow;
mod side;
mod two_chamber;

pub(crate) use flow::{Laws, jet_velocity};
pub(crate) use side::HydraulicSide;
