//! Why a study has no result.

use dashpot_core::BuildError;
use dashpot_core::parameters::STEP_ALLOWED;
use dashpot_reference::ReferenceError;

use dashpot_files::harmonic::{Harmonic, HarmonicError};

use super::bench_test::STEPS_PER_CYCLE;
use super::swept_sine::MOST_STEPS as MOST_SWEPT_STEPS;
use dashpot_files::FileError;

/// Why a study has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TestbenchError {
    /// The recording cannot be used.
    #[error(transparent)]
    Recording(#[from] FileError),
    /// The damper cannot be built.
    #[error(transparent)]
    Damper(#[from] BuildError),
    /// The reference solver failed.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    /// Invalid harmonic motion.
    #[error(transparent)]
    Motion(#[from] HarmonicError),
    /// The step is out of its range.
    #[error("step: {step_s} s, allowed: {STEP_ALLOWED}")]
    Step {
        /// The step (s).
        step_s: f64,
    },
    /// A cycle has too few or too many steps.
    #[error(
        "{steps} steps of {step_s} s a cycle, allowed: {} to {:e}; choose another step or frequency",
        STEPS_PER_CYCLE.start(),
        STEPS_PER_CYCLE.end()
    )]
    StepsPerCycle {
        /// Steps of a cycle.
        steps: f64,
        /// The step (s).
        step_s: f64,
    },
    /// The motion is faster than the damper follows.
    #[error(
        "the motion reaches {velocity_m_per_s:.3} m/s, allowed: limits.rate_m_per_s = {limit_m_per_s} m/s"
    )]
    Velocity {
        /// Largest velocity of the motion (m/s).
        velocity_m_per_s: f64,
        /// The damper's limit (m/s).
        limit_m_per_s: f64,
    },
    /// The motion leaves the damper's range of displacement.
    #[error("the motion reaches {amplitude_m} m, allowed: limits.displacement_m = {limit_m} m")]
    Displacement {
        /// Amplitude of the motion (m).
        amplitude_m: f64,
        /// The damper's limit (m).
        limit_m: f64,
    },
    /// The force does not become periodic.
    #[error(
        "the force does not repeat within {cycles} cycles of {} m at {} Hz",
        motion.amplitude_m,
        motion.frequency_hz
    )]
    NotPeriodic {
        /// Cycles run.
        cycles: usize,
        /// The motion.
        motion: Harmonic,
    },
    /// Nobody wants the result any more.
    #[error("ended before its end, as was asked")]
    Unwanted,
    /// A swept sine rises too fast for its first frequency.
    #[error(
        "{octaves_per_minute} octaves a minute from {from_hz} Hz on, allowed: above 0 and at most {most:.4}"
    )]
    SweepRate {
        /// The rate (octaves a minute).
        octaves_per_minute: f64,
        /// The first frequency (Hz).
        from_hz: f64,
        /// The greatest rate there (octaves a minute).
        most: f64,
    },
    /// A swept sine is too long.
    #[error(
        "a sweep of {steps:.1e} steps, allowed: {MOST_SWEPT_STEPS:e}; sweep faster or to a lower frequency"
    )]
    SweepSteps {
        /// Its steps.
        steps: f64,
    },
    /// Two series of forces have different lengths.
    #[error("{forces} forces against {references} of the reference")]
    Lengths {
        /// Forces of the fixed step.
        forces: usize,
        /// Forces of the reference.
        references: usize,
    },
    /// The reference force is zero throughout.
    #[error(
        "the reference force is zero throughout: the motion stays within the clearance, there is nothing to compare"
    )]
    NoForce,
    /// A published table in the program is not as it was shipped.
    #[error("a published table: {0}")]
    PublishedTable(#[from] csv::Error),
    /// Table 5 in the program is not as it was shipped.
    #[error("Table 5: {0}")]
    Table5(String),
}
