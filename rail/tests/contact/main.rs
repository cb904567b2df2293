//! Wheel on rail: profiles, geometry, normal and creep forces, conicity.

mod book;
mod cache;
mod common;
mod conservation;
mod creep;
mod derivatives;
mod elastic;
mod exact;
mod exact_forces;
mod fastsim;
mod force_jumped;
mod friction;
mod geometry;
mod laws;
mod normal;
mod patches;
mod profiles;
mod published;
mod pure_spin;
mod refusals;
mod safety;
mod sides;
mod tables;
mod wheelset;
