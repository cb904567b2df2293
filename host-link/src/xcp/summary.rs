//! What a server has done.

use serde::Serialize;

/// What a server has done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct Summary {
    /// Sessions with a master.
    pub sessions: u64,
    /// Commands that were executed.
    pub commands: u64,
    /// Commands that were refused.
    pub refused_commands: u64,
    /// Ticks that were measured.
    pub measured_ticks: u64,
    /// Ticks that were not measured although a list was running, because the server was too slow.
    pub lost_ticks: u64,
}
