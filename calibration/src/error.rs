//! Errors of a calibration.

use dashpot_core::BuildError;

use super::determination::Determined;
use super::finding::Finding;
use super::keys::RIG;
use super::remedy::{Advice, Remedy};
use dashpot_files::damper::DamperError;
use dashpot_testbench::TestbenchError;

/// Errors of a calibration.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// The damper or one of its parameters does not exist or is invalid.
    #[error(transparent)]
    Damper(#[from] DamperError),
    /// The damper cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A bench test of the model failed.
    #[error(transparent)]
    Study(#[from] TestbenchError),
    /// The caller cancelled the calibration.
    #[error("cancelled")]
    Cancelled,
    /// The parameter cannot be calibrated from forces.
    #[error("{key}: must be measured on the part, because it cannot be calibrated from forces")]
    NotVaried {
        /// Key of the parameter.
        key: String,
    },
    /// No force depends on the parameter.
    #[error(
        "{key}: no force of a damper depends on it, so the calibration removes it from every test and reports it; \
         it can neither be varied nor held, nor have a prior"
    )]
    NoForceDepends {
        /// Key of the parameter.
        key: String,
    },
    /// A damper parameter was given where a rig parameter is required.
    #[error(
        "{key}: only rig parameters can be held ({}); a damper parameter keeps its value unless it is varied",
        RIG.join(", ")
    )]
    NotOfRig {
        /// Key of the parameter.
        key: String,
    },
    /// A rig parameter is both held and varied.
    #[error("{key}: it is held, so it can have neither bounds nor a prior")]
    HeldAndVaried {
        /// Key of the parameter.
        key: String,
    },
    /// The value of a held rig parameter is out of range.
    #[error("{key}: held at {value}, allowed: {} to {max}", -max)]
    Held {
        /// Key of the parameter.
        key: String,
        /// Value at which it is held.
        value: f64,
        /// Maximum magnitude.
        max: f64,
    },
    /// A rig parameter was given without recorded loops.
    #[error("{key}: requires recorded loops, but there are none")]
    NoLoops {
        /// Key of the parameter.
        key: String,
    },
    /// A prior was given for a parameter that is not varied.
    #[error("prior {key}: not varied")]
    PriorOfHeld {
        /// Key of the parameter.
        key: String,
        /// True if the parameter can be varied.
        is_known: bool,
    },
    /// The bounds are not in order or out of range.
    #[error(
        "{key}: bounds {} to {}, allowed: the lower bound first, within {allowed}, and above 0 on a logarithmic scale; \
         default: {:e} to {:e}",
        bounds[0],
        bounds[1],
        plausible[0],
        plausible[1]
    )]
    Bounds {
        /// Key of the parameter.
        key: String,
        /// Lower and upper bound.
        bounds: [f64; 2],
        /// Values allowed in a damper file.
        allowed: &'static str,
        /// Default bounds.
        plausible: [f64; 2],
    },
    /// The start is outside the bounds.
    #[error("{key}: the damper has {start}, outside the bounds {} to {}", bounds[0], bounds[1])]
    Start {
        /// Key of the parameter.
        key: String,
        /// Value of the damper.
        start: f64,
        /// Lower and upper bound.
        bounds: [f64; 2],
    },
    /// The mean of a prior is outside the bounds.
    #[error("{key}: prior mean {mean} outside the bounds {} to {}", bounds[0], bounds[1])]
    Prior {
        /// Key of the parameter.
        key: String,
        /// Mean of the prior.
        mean: f64,
        /// Lower and upper bound.
        bounds: [f64; 2],
    },
    /// A parameter was given twice.
    #[error("{key}: varied twice")]
    Twice {
        /// Key of the parameter.
        key: String,
    },
    /// There is no parameter to vary, or no test.
    #[error("no {0}")]
    Nothing(&'static str),
    /// Invalid samples.
    #[error("{test}: {reason}")]
    Samples {
        /// Name of the test.
        test: String,
        /// The problem and the allowed values.
        reason: String,
    },
    /// The test is too short.
    #[error("{test}: too short, allowed: {min} samples or more without a gap")]
    TooShort {
        /// Name of the test.
        test: String,
        /// Minimum number of samples.
        min: usize,
    },
    /// The test is too long to fit into memory.
    #[error("{test}: {duration_s:.0} s long, allowed at this step: at most {max_s:.0} s")]
    TooLong {
        /// Name of the test.
        test: String,
        /// Duration of the test (s).
        duration_s: f64,
        /// Maximum duration (s).
        max_s: f64,
    },
    /// The force acts only in one direction.
    #[error(
        "{test}: the force acts only in one direction, so the motion never passes through the clearance; possible \
         causes: the sensor records the magnitude of the force, or its zero is off by as much as the force"
    )]
    OneSided {
        /// Name of the test.
        test: String,
    },
    /// Invalid test in a table of indices.
    #[error("table of indices, test {test}: {reason}")]
    Index {
        /// Number of the test, counted from 1.
        test: usize,
        /// The problem.
        reason: String,
    },
    /// No search converged.
    #[error("no search converged; error at the starting values: {0}")]
    NoFit(String),
    /// The search for the 95 % intervals kept finding better fits.
    #[error(
        "the search for the 95 % intervals kept finding better fits than those from {starts} starting points"
    )]
    FewStarts {
        /// Number of starting points.
        starts: usize,
    },
    /// The fit or the recordings are implausible for a damper.
    #[error("{finding}")]
    Implausible {
        /// The reason.
        finding: Finding,
        /// Remedies, the most likely first; each was tried and yields a result.
        advice: Vec<Advice>,
    },
    /// The tests do not determine some parameters.
    #[error("{}", undetermined(parameters))]
    Undetermined {
        /// Keys, and how well the tests determine each.
        parameters: Vec<(String, Determined)>,
    },
}

fn undetermined(parameters: &[(String, Determined)]) -> String {
    let mut text = String::from("the tests do not determine");
    for (key, parameter) in parameters {
        let partners = parameter.confounded_with.join("`, `");
        text += &match (parameter.has_effect, partners.is_empty()) {
            (false, _) => format!(
                "\n  {key}: no force of these tests changes with it by more than the scatter"
            ),
            (true, true) => {
                format!(
                    "\n  {key}: its effect is too small compared with the scatter of the forces"
                )
            }
            (true, false) => format!("\n  {key}: only in combination with `{partners}`"),
        };
    }
    text
}

impl CalibrationError {
    /// Returns the error for a finding whose cause has not been searched for yet.
    pub(super) fn implausible(finding: Finding) -> Self {
        Self::Implausible {
            finding,
            advice: Vec::new(),
        }
    }

    /// Returns alternative remedies; empty if the error text is sufficient.
    pub fn advice(&self) -> Vec<Advice> {
        let one = |remedy| vec![vec![remedy]];
        match self {
            Self::Bounds { key, plausible, .. } => one(Remedy::Bounds {
                key: key.clone(),
                bounds: *plausible,
            }),
            Self::Start { key, bounds, start } => vec![
                vec![Remedy::Set {
                    key: key.clone(),
                    value: 0.5 * (bounds[0] + bounds[1]),
                }],
                vec![Remedy::Bounds {
                    key: key.clone(),
                    bounds: [bounds[0].min(*start), bounds[1].max(*start)],
                }],
            ],
            Self::Prior { key, mean, bounds } => one(Remedy::Bounds {
                key: key.clone(),
                bounds: [bounds[0].min(*mean), bounds[1].max(*mean)],
            }),
            Self::NotVaried { key } | Self::NoForceDepends { key } | Self::NoLoops { key } => {
                one(Remedy::Leave(key.clone()))
            }
            Self::NotOfRig { key } | Self::HeldAndVaried { key } => {
                one(Remedy::Release(key.clone()))
            }
            Self::PriorOfHeld { key, is_known } => {
                let vary = is_known.then(|| vec![Remedy::VaryAlso(vec![key.clone()])]);
                vary.into_iter()
                    .chain(one(Remedy::Forget(key.clone())))
                    .collect()
            }
            Self::Undetermined { parameters } => {
                let for_each = |remedy: fn(String) -> Remedy| -> Advice {
                    parameters
                        .iter()
                        .map(|(key, _)| remedy(key.clone()))
                        .collect()
                };
                vec![for_each(Remedy::Leave), for_each(Remedy::Know)]
            }
            Self::FewStarts { starts } => {
                let more = (4 * starts).clamp(16, 1000) as u16;
                one(Remedy::Starts(more))
            }
            Self::Implausible { finding, advice } => {
                let mut advice = advice.clone();
                if advice.is_empty() {
                    advice.extend(finding.acceptance());
                }
                advice
            }
            _ => Vec::new(),
        }
    }
}
