//! Contact of a wheelset: geometry, Hertz, tables, and the forces of its patches.

pub mod forces;
pub mod geometry;
pub mod hertz;
pub mod motion;
pub mod pair;
pub mod table;
pub mod wheelset;
