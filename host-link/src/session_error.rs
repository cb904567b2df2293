//! Errors of a run.

use super::LinkError;

/// Errors of a run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SessionError {
    /// A request failed outside the ticks, or an answer did not match its tick.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// A request failed during the run.
    #[error("after tick {tick}: {source}")]
    After {
        /// The last tick that both sides confirmed.
        tick: u32,
        /// The reason.
        source: LinkError,
    },
    /// The target was lost repeatedly.
    #[error("after tick {tick}: the target was lost {times} times {when}")]
    Lost {
        /// The last tick that both sides confirmed.
        tick: u32,
        /// Number of times.
        times: u32,
        /// When it was lost, as the end of the message.
        when: &'static str,
    },
    /// The target did not answer in time while the run went on with its last forces.
    #[error(
        "after tick {tick}: {missing} answers in a row are missing from the target; allowed: {allowed}"
    )]
    Unanswered {
        /// The last tick that the target answered.
        tick: u64,
        /// Number of missing answers in a row.
        missing: u64,
        /// Allowed number.
        allowed: u64,
    },
    /// The target runs another version of the core.
    #[error(
        "the target runs dashpot-core {target}, this host {}; results are bit-identical only between equal versions",
        env!("CARGO_PKG_VERSION")
    )]
    Version {
        /// The target's version.
        target: String,
    },
    /// The number of dampers is neither 1 nor the number of slots.
    #[error(
        "{dampers} dampers, but the target has {slots} slots; allowed: 1 for all slots, or {slots}, one per slot"
    )]
    DamperCount {
        /// Number of dampers given.
        dampers: usize,
        /// Number of slots of the target.
        slots: usize,
    },
    /// The damper is built for a different step than the target.
    #[error(
        "the damper is built for a step of {damper_s} s, but the step of the target is {target_s} s"
    )]
    Step {
        /// Step of the damper (s).
        damper_s: f32,
        /// Step of the target (s).
        target_s: f32,
    },
    /// There are no dampers, or there are more dampers than slots.
    #[error("{dampers} dampers, but the target has {slots} slots; allowed: 1 to {slots}")]
    TooManyDampers {
        /// Number of dampers given.
        dampers: usize,
        /// Number of slots of the target.
        slots: usize,
    },
    /// A force is not finite.
    #[error("at tick {tick}: the target returned the force {force_n} N; allowed: a finite number")]
    Force {
        /// Tick of the target.
        tick: u32,
        /// The force (N).
        force_n: f32,
    },
    /// The motion is empty.
    #[error("the motion has no ticks")]
    NoTick,
}
