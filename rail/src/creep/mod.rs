//! Creep forces: one law a file, all behind [`creepage::CreepLaw`].

pub mod creepage;
pub mod fastsim;
pub mod friction;
pub mod kalker;
pub mod polach;
pub mod shen_hedrick_elkins;
