//! Errors of the test bench.

use dashpot_core::BuildError;
use dashpot_core::parameters::STEP_ALLOWED;
use dashpot_reference::ReferenceError;

use dashpot_files::harmonic::{Harmonic, HarmonicError};

use super::limits::{MAX_SWEEP_STEPS, STEPS_PER_CYCLE};
use dashpot_files::FileError;

/// Errors of the test bench.
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
    /// The step is out of range.
    #[error("step: {step_s} s, allowed: {STEP_ALLOWED}")]
    Step {
        /// The step (s).
        step_s: f64,
    },
    /// A cycle has too few or too many steps.
    #[error(
        "{steps} steps of {step_s} s per cycle, allowed: {} to {:e}; choose another step or frequency",
        STEPS_PER_CYCLE.start(),
        STEPS_PER_CYCLE.end()
    )]
    StepsPerCycle {
        /// Steps per cycle.
        steps: f64,
        /// The step (s).
        step_s: f64,
    },
    /// The motion is faster than the damper can follow.
    #[error(
        "the motion reaches {velocity_m_per_s:.3} m/s, allowed: limits.rate_m_per_s = {limit_m_per_s} m/s"
    )]
    Velocity {
        /// Peak velocity of the motion (m/s).
        velocity_m_per_s: f64,
        /// Velocity limit of the damper (m/s).
        limit_m_per_s: f64,
    },
    /// The motion leaves the displacement range of the damper.
    #[error("the motion reaches {amplitude_m} m, allowed: limits.displacement_m = {limit_m} m")]
    Displacement {
        /// Amplitude of the motion (m).
        amplitude_m: f64,
        /// Displacement limit of the damper (m).
        limit_m: f64,
    },
    /// The force does not become periodic.
    #[error(
        "the force does not repeat within {cycles} cycles of {} m at {} Hz",
        motion.amplitude_m,
        motion.frequency_hz
    )]
    NotPeriodic {
        /// Number of cycles run.
        cycles: usize,
        /// The motion.
        motion: Harmonic,
    },
    /// The caller cancelled the computation.
    #[error("cancelled")]
    Cancelled,
    /// The sweep rate is zero, negative or too high for the first frequency.
    #[error(
        "{octaves_per_minute} octaves per minute from {from_hz} Hz, allowed: above 0 and at most {max:.4}"
    )]
    SweepRate {
        /// Sweep rate (octaves per minute).
        octaves_per_minute: f64,
        /// First frequency (Hz).
        from_hz: f64,
        /// Maximum sweep rate at this frequency (octaves per minute).
        max: f64,
    },
    /// The sweep takes too many steps.
    #[error(
        "the sweep takes {steps:.1e} steps, allowed: at most {MAX_SWEEP_STEPS:e}; sweep faster or to a lower frequency"
    )]
    SweepSteps {
        /// Number of steps.
        steps: f64,
    },
    /// The number of forces differs from the number of reference forces.
    #[error("{forces} forces, but {references} reference forces")]
    Lengths {
        /// Number of forces that the fixed step computed.
        forces: usize,
        /// Number of reference forces.
        references: usize,
    },
    /// The reference force is zero throughout.
    #[error(
        "the reference force is zero throughout: the motion stays within the clearance, so there is nothing to compare"
    )]
    NoForce,
    /// A reduced damper has no shim packs.
    #[error("a reduced damper has no shim packs; use a damper with [valves], such as `paper`")]
    NoShims,
    /// A built-in published table is corrupt.
    #[error("published table: {0}")]
    PublishedTable(#[from] csv::Error),
    /// The built-in Table 5 is corrupt.
    #[error("Table 5: {0}")]
    Table5(String),
}
