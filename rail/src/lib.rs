//! Wheel on rail: profiles, contact geometry, normal and creep forces of a wheelset.
//!
//! Axes: x forward, y right, z down; roll and yaw turn about x and z by the right-hand rule. SI units.
//! Profiles make a [`contact::pair::Pair`], a pair makes [`contact::table::Tables`] once, and
//! [`contact::wheelset::WheelsetContact`] reads them in the step without allocating.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod contact;
pub mod creep;
pub mod indices;
pub mod math;
pub mod profile;
