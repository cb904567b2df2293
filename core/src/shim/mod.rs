//! Shim packs: thin annular discs, clamped at the inner edge, that oil pressure bends open.

mod disc;
mod pack;

pub use disc::Disc;
pub(crate) use pack::edge_compliance;
pub use pack::{Pack, edge_compliance_m_per_pa};
