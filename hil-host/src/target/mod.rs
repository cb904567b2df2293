//! Dampers on a target: exported as constants, and driven over a link.

mod child;
pub mod export;
pub mod pil;

pub(crate) use child::end_all as end_children;
