//! Why a run has no result.

use super::LinkError;

/// Why a run has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SessionError {
    /// The target cannot be asked.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// The target cannot be asked any more.
    #[error("after tick {tick}: {source}")]
    After {
        /// The last tick that both sides confirmed.
        tick: u32,
        /// The reason.
        source: LinkError,
    },
    /// The target was lost again and again.
    #[error("after tick {tick}: the target was lost {times} times {when}")]
    Lost {
        /// The last tick that both sides confirmed.
        tick: u32,
        /// How often.
        times: u32,
        /// Under which circumstances.
        when: &'static str,
    },
    /// The target runs another version of the core.
    #[error(
        "the target runs dashpot-core {target}, this host {}; bits are the same only between the same versions",
        env!("CARGO_PKG_VERSION")
    )]
    Version {
        /// The target's version.
        target: String,
    },
    /// Neither one damper nor one for each place.
    #[error(
        "{dampers} dampers, the target has {places} places; allowed: 1, for all places, or {places}, one for each"
    )]
    Dampers {
        /// Dampers given.
        dampers: usize,
        /// Places of the target.
        places: usize,
    },
    /// A damper built for another step than the target's.
    #[error("the damper is built for {damper_s} s, the target steps {target_s} s")]
    Step {
        /// Step of the damper (s).
        damper_s: f32,
        /// Step of the target (s).
        target_s: f32,
    },
    /// More dampers than the target has places.
    #[error("{dampers} dampers, the target has {places} places; allowed: 1 to {places}")]
    Places {
        /// Dampers given.
        dampers: usize,
        /// Places of the target.
        places: usize,
    },
    /// A force that is no finite number.
    #[error("at tick {tick}: the target gave the force {force_n} N, allowed: a finite number")]
    Force {
        /// Tick of the target.
        tick: u32,
        /// The force (N).
        force_n: f32,
    },
    /// The motion has no displacement.
    #[error("the motion has no tick")]
    NoTick,
}
