//! Wheel on rail: profiles, geometry, normal and creep forces, conicity.

mod book;
mod common;
mod conicity;
mod creep;
mod fastsim;
mod geometry;
mod laws;
mod normal;
mod profiles;
mod published;
mod safety;
mod tables;
mod wheelset;
