//! Wheel on rail: profiles, geometry, normal and creep forces, conicity.

mod book;
mod cache;
mod common;
mod creep;
mod derivatives;
mod elastic;
mod exact;
mod fastsim;
mod force_jumped;
mod geometry;
mod laws;
mod load_tables;
mod normal;
mod patches;
mod profiles;
mod published;
mod pure_spin;
mod safety;
mod sides;
mod tables;
mod wheelset;
