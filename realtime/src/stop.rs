//! A run ended by a slow tick.

use serde::Serialize;

/// A tick whose work took longer than allowed and which ended the run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Stop {
    /// The tick, from 0.
    pub tick: u64,
    /// Its time along the motion (s): tick times step.
    pub time_s: f64,
    /// Its work (ns).
    pub work_ns: f64,
    /// The limit it broke (ns).
    pub limit_ns: u64,
}
