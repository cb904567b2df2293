//! Reasons to reject a fit or a recording.

use std::fmt;

use super::remedy::{Advice, Remedy};

/// Maximum amplitude of a test (m); no vehicle damper has a longer stroke.
pub(super) const MAX_AMPLITUDE_M: f64 = 0.5;

/// Reason to reject a fit or a recording.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// The recorded force drives the damper instead of resisting the motion.
    Driven {
        /// Work that the force takes from the motion (J); negative in this error.
        work_j: f64,
    },
    /// The recorded motion is too fast or too large for the damper.
    TooFast {
        /// Name of the test.
        test: String,
        /// Amplitude of the motion (m).
        amplitude_m: f64,
        /// Peak velocity of a harmonic motion with the same rms velocity (m/s).
        velocity_m_per_s: f64,
        /// Velocity limit of the damper (m/s).
        max_velocity_m_per_s: f64,
    },
    /// The residual of a test is larger than the noise explains.
    Missed {
        /// Name of the test.
        test: String,
        /// Root mean square residual (N).
        missed_n: f64,
        /// Standard deviation of the force noise (N).
        noise_n: f64,
        /// Root mean square of the force about its mean (N).
        force_rms_n: f64,
        /// Allowed residual beyond the noise, divided by `force_rms_n` (1).
        max: f64,
        /// Parameters that ended at a default bound, and their bounds.
        at_bounds: Vec<(String, [f64; 2])>,
    },
    /// A parameter ended at a default bound.
    AtBound {
        /// Key of the parameter.
        key: String,
        /// Value of the bound.
        bound: f64,
        /// Lower and upper bound.
        bounds: [f64; 2],
    },
}

impl Finding {
    /// Returns the changes with which the calibration accepts the best fit despite this finding; `None` if there are
    /// none.
    pub(super) fn acceptance(&self) -> Option<Advice> {
        match self {
            Self::Missed {
                missed_n,
                force_rms_n,
                at_bounds,
                ..
            } => {
                // Rounds up to the next ten percent.
                let part = (10.0 * missed_n / force_rms_n).floor() / 10.0 + 0.1;
                let bounds = at_bounds.iter().map(|(key, bounds)| Remedy::Bounds {
                    key: key.clone(),
                    bounds: *bounds,
                });
                Some(
                    [Remedy::AllowMisfit(part)]
                        .into_iter()
                        .chain(bounds)
                        .collect(),
                )
            }
            Self::AtBound { key, bounds, .. } => Some(vec![Remedy::Bounds {
                key: key.clone(),
                bounds: *bounds,
            }]),
            _ => None,
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Driven { work_j } => write!(
                f,
                "the recorded force drives the damper: it adds {:.3} J to the motion, but a damper dissipates energy",
                -work_j
            ),
            Self::TooFast {
                test,
                amplitude_m,
                velocity_m_per_s,
                max_velocity_m_per_s,
            } => write!(
                f,
                "{test}: a motion of +-{amplitude_m:.3} m at {velocity_m_per_s:.3} m/s; a damper moves by at most \
                 {MAX_AMPLITUDE_M} m, and this one follows at most {max_velocity_m_per_s} m/s (limits.rate_m_per_s)"
            ),
            Self::Missed {
                test,
                missed_n,
                noise_n,
                force_rms_n,
                max,
                at_bounds,
            } => {
                write!(
                    f,
                    "{test}: the residual is {missed_n:.3} N rms, the force {force_rms_n:.3} N rms and its noise \
                     {noise_n:.3} N rms; allowed beyond the noise: {:.0} % of the force",
                    100.0 * max
                )?;
                at_bounds
                    .iter()
                    .try_for_each(|(key, _)| write!(f, "; {key} ended at a bound"))
            }
            Self::AtBound { key, bound, .. } => {
                write!(
                    f,
                    "{key} ended at its bound {bound:e}: the best value lies beyond it"
                )
            }
        }
    }
}
