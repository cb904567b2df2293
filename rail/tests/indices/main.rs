//! Indices of ride, safety and contact geometry.

mod band;
mod conicity;
mod low_pass;
mod ride;
mod windows;
