//! Why there is no real time.

use crate::limits::{RATE_RANGE_HZ, TICKS_PER_ALLOWED_MISS};
use crate::options::RealtimeOption;
use crate::stop::Stop;
use crate::timing::span;

/// Why ticks cannot be paced, or were not on time.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RealtimeError {
    /// A paced step is out of its range.
    #[error("a paced step of {step_us} us: allowed are {}", paced_steps())]
    Step {
        /// The step (us).
        step_us: f64,
    },
    /// The process may not use the core.
    #[error(
        "core {core}: no core this process may use, allowed: {}",
        listed(allowed)
    )]
    Core {
        /// The requested core.
        core: usize,
        /// The cores that the process may use.
        allowed: Vec<usize>,
    },
    /// The system refused a real-time option.
    #[error("{option}: {reason}")]
    Refused {
        /// The option.
        option: RealtimeOption,
        /// Why, and what is missing.
        reason: String,
    },
    /// A tick took longer than allowed.
    #[error("{}, allowed: {}", stopped(.0), span(.0.limit_ns as f64))]
    Stopped(Stop),
    /// More deadlines were missed than `--realtime` allows.
    #[error("{missed} of {ticks} deadlines missed, allowed: one in {TICKS_PER_ALLOWED_MISS}")]
    TooManyMissed {
        /// Ticks whose work ended after the next tick was due.
        missed: u64,
        /// All ticks.
        ticks: u64,
    },
    /// Deadlines were missed.
    #[error("{missed} of {ticks} deadlines missed, allowed: none")]
    MissedDeadlines {
        /// Ticks whose work ended after the next tick was due.
        missed: u64,
        /// All ticks.
        ticks: u64,
    },
}

/// The steps that can be paced, as text.
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

/// Cores separated by commas.
pub fn listed(cores: &[usize]) -> String {
    let cores: Vec<String> = cores.iter().map(usize::to_string).collect();
    cores.join(", ")
}

/// The tick that ended a run, and what it took.
pub fn stopped(stop: &Stop) -> String {
    format!(
        "stopped: tick {}, {:.6} s along the motion, took {}",
        stop.tick,
        stop.time_s,
        span(stop.work_ns)
    )
}
