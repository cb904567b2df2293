//! Indices of ride, safety and contact geometry.

mod conicity;
mod ride;
mod windows;
