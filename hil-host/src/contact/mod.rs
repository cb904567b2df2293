//! Wheel on rail: profiles, contact geometry, normal and creep forces of a wheelset.
//!
//! Axes: x forward, y right, z down; roll and yaw turn about x and z by the right-hand rule. SI units.
//! The part stands alone: `profile`s make a [`pair::Pair`], a pair makes [`table::Tables`] once, and
//! [`wheelset::WheelsetContact`] reads them in the step without allocating.

pub mod conicity;
pub mod creepage;
pub mod elliptic;
pub mod fastsim;
pub mod forces;
pub mod friction;
pub mod geometry;
pub mod hertz;
pub mod kalker;
pub mod measured;
pub mod motion;
pub mod pair;
pub mod plot;
pub mod polach;
pub mod profile;
pub mod s1002;
pub mod shen_hedrick_elkins;
pub mod spline;
pub mod table;
pub mod uic60;
pub mod wheelset;
