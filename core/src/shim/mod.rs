//! Shim packs: thin annular discs clamped at the inner edge, bent open by oil pressure.

mod disc;
mod pack;

pub use disc::Disc;
pub(crate) use pack::edge_compliance;
pub use pack::{Pack, edge_compliance_m_per_pa};
