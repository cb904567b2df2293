//! End of a run because of a slow tick.

use serde::Serialize;

/// The tick that ended a run because its work took longer than allowed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Stop {
    /// Number of the tick, from 0.
    pub tick: u64,
    /// Time in the motion (s): tick times step.
    pub time_s: f64,
    /// Duration of its work (ns).
    pub work_ns: f64,
    /// Limit for the duration (ns).
    pub limit_ns: u64,
}
