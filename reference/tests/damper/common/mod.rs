//! Dampers, motions and the second solver shared by the reference tests.
#![allow(dead_code)] // each test uses only a part

pub mod dampers;
pub mod motions;
pub mod radau;
