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

impl Stop {
    /// Returns a stop if the work of `tick` took longer than the limit; `None` without a limit.
    ///
    /// ```
    /// use dashpot_realtime::stop::Stop;
    /// let stop = Stop::if_above(7, 1e-3, 50_000.0, Some(40_000)).unwrap();
    /// assert_eq!((stop.tick, stop.time_s, stop.work_ns), (7, 7e-3, 50_000.0));
    /// assert_eq!(Stop::if_above(7, 1e-3, 40_000.0, Some(40_000)), None);
    /// ```
    pub fn if_above(tick: u64, step_s: f64, work_ns: f64, limit_ns: Option<u64>) -> Option<Self> {
        let limit_ns = limit_ns.filter(|limit| work_ns > *limit as f64)?;
        Some(Self {
            tick,
            time_s: tick as f64 * step_s,
            work_ns,
            limit_ns,
        })
    }
}
