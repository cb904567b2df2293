//! Errors of real-time runs.

use crate::limits::{RATE_RANGE_HZ, TICKS_PER_ALLOWED_MISS};
use crate::options::RealtimeOption;
use crate::stop::Stop;
use crate::timing::span;

/// Errors of real-time runs: ticks could not be paced or were late.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RealtimeError {
    /// The step is outside the range for paced runs.
    #[error("a paced step of {step_us} us; allowed: {}", paced_steps())]
    Step {
        /// The step (us).
        step_us: f64,
    },
    /// The process may not use the core.
    #[error(
        "core {core}: this process may not use this core; allowed: {}",
        listed(allowed)
    )]
    Core {
        /// Requested core.
        core: usize,
        /// Cores that the process may use.
        allowed: Vec<usize>,
    },
    /// The system refused a real-time option.
    #[error("{option}: {reason}")]
    Refused {
        /// Refused option.
        option: RealtimeOption,
        /// Reason, with any missing permission.
        reason: String,
    },
    /// A tick took longer than allowed.
    #[error("{}; allowed: {}", stopped(.0), span(.0.limit_ns as f64))]
    Stopped(Stop),
    /// More than one deadline in [`TICKS_PER_ALLOWED_MISS`] was missed.
    #[error("{missed} of {ticks} deadlines missed; allowed: one in {TICKS_PER_ALLOWED_MISS}")]
    TooManyMissed {
        /// Number of ticks whose work ended after the next tick was due.
        missed: u64,
        /// Number of ticks.
        ticks: u64,
    },
    /// A deadline was missed although none may be missed.
    #[error("{missed} of {ticks} deadlines missed; allowed: none")]
    MissedDeadlines {
        /// Number of ticks whose work ended after the next tick was due.
        missed: u64,
        /// Number of ticks.
        ticks: u64,
    },
}

/// Describes the range of steps for paced runs.
fn paced_steps() -> String {
    let (slowest_hz, fastest_hz) = (*RATE_RANGE_HZ.start(), *RATE_RANGE_HZ.end());
    format!(
        "{} to {} us ({} to {} kHz)",
        1_000_000 / fastest_hz,
        1_000_000 / slowest_hz,
        fastest_hz / 1000,
        slowest_hz / 1000
    )
}

/// Lists cores, separated by commas.
pub fn listed(cores: &[usize]) -> String {
    let cores: Vec<String> = cores.iter().map(usize::to_string).collect();
    cores.join(", ")
}

/// Describes the tick that ended a run, and its duration.
pub fn stopped(stop: &Stop) -> String {
    format!(
        "stopped: tick {}, {:.6} s along the motion, took {}",
        stop.tick,
        stop.time_s,
        span(stop.work_ns)
    )
}
