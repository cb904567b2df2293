//! Errors of a virtual rig.

use dashpot_core::BuildError;

/// A virtual rig that cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RigError {
    /// The damper cannot be built for the steps of the rig.
    #[error(transparent)]
    Damper(#[from] BuildError),
    /// The steps do not resolve the resonance of the moving mass.
    #[error(
        "the moving mass resonates on oil and mounts at {resonance_hz:.0} Hz, allowed: at most {highest_hz:.0} Hz; a \
         larger mass or softer mounts resonate lower"
    )]
    Resonance {
        /// The resonance (Hz).
        resonance_hz: f64,
        /// The highest that the steps resolve (Hz).
        highest_hz: f64,
    },
}
