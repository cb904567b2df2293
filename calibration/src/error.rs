//! Why a calibration has no result.

use dashpot_core::BuildError;

use super::determined::Determined;
use super::misfit::Finding;
use super::remedy::{Advice, Remedy};
use super::rig;
use dashpot_files::damper::DamperError;
use dashpot_testbench::TestbenchError;

/// Why a calibration has no result.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// The damper, or a number of it, is not there or not allowed.
    #[error(transparent)]
    Damper(#[from] DamperError),
    /// The damper cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A bench test of the model fails.
    #[error(transparent)]
    Study(#[from] TestbenchError),
    /// Nobody wants the result any more.
    #[error("ended before its end, as was asked")]
    Cancelled,
    /// A number that forces do not determine.
    #[error("{key}: it is measured on the part, not found from forces")]
    NotVaried {
        /// The number.
        key: String,
    },
    /// A number on which no force depends.
    #[error(
        "{key}: no force of a damper depends on it, so the calibration takes it out of every test and reports it; there is nothing to vary, \
         hold or know"
    )]
    NoForceDepends {
        /// The number.
        key: String,
    },
    /// A number of the damper where one of the rig is needed.
    #[error("{key}: only numbers of the rig are held so ({}); one of the damper is held unless it is varied", rig::RIG.join(", "))]
    NotOfRig {
        /// The number.
        key: String,
    },
    /// A number of the rig that is held and varied.
    #[error("{key}: it is held, so it has neither bounds nor a prior")]
    HeldAndVaried {
        /// The number.
        key: String,
    },
    /// A number of the rig that is held at a value that no rig has.
    #[error("{key}: held at {value}, allowed: {} to {most}", -most)]
    Held {
        /// The number.
        key: String,
        /// The value.
        value: f64,
        /// The largest that is allowed.
        most: f64,
    },
    /// A number of the rig without a recorded loop.
    #[error("{key}: it belongs to recorded loops, and there are none")]
    NoLoops {
        /// The number.
        key: String,
    },
    /// A prior of a number that is not varied.
    #[error("prior {key}: not varied")]
    PriorOfHeld {
        /// The number.
        key: String,
        /// Whether it can be varied.
        is_known: bool,
    },
    /// Bounds that are none, or beyond what a damper may have.
    #[error(
        "{key}: bounds {} to {}, allowed: the lesser first, within {allowed}, and above 0 where ratios count; when none are given: \
         {:e} to {:e}",
        bounds[0],
        bounds[1],
        plausible[0],
        plausible[1]
    )]
    Bounds {
        /// The number.
        key: String,
        /// The bounds.
        bounds: [f64; 2],
        /// What a damper file may have.
        allowed: &'static str,
        /// The bounds used where none are given.
        plausible: [f64; 2],
    },
    /// A start outside the bounds.
    #[error("{key}: the damper has {start}, outside the bounds {} to {}", bounds[0], bounds[1])]
    Start {
        /// The number.
        key: String,
        /// Its value in the damper.
        start: f64,
        /// The bounds.
        bounds: [f64; 2],
    },
    /// A number that is known to be where it may not be.
    #[error("{key}: known to be {mean}, outside the bounds {} to {}", bounds[0], bounds[1])]
    Prior {
        /// The number.
        key: String,
        /// Mean of what is known.
        mean: f64,
        /// The bounds.
        bounds: [f64; 2],
    },
    /// A number twice.
    #[error("{key}: varied twice")]
    Twice {
        /// The number.
        key: String,
    },
    /// No number or no test.
    #[error("no {0}")]
    Nothing(&'static str),
    /// Samples that are none.
    #[error("{test}: {reason}")]
    Samples {
        /// The test.
        test: String,
        /// What is wrong with them, and what is allowed.
        reason: String,
    },
    /// A test too short to tell anything.
    #[error("{test}: too short, allowed: {fewest} samples or more without a gap")]
    TooShort {
        /// The test.
        test: String,
        /// Samples needed.
        fewest: usize,
    },
    /// A test too long to be held.
    #[error("{test}: {seconds:.0} s long, allowed at this step: {most:.0} s")]
    TooLong {
        /// The test.
        test: String,
        /// Its length (s).
        seconds: f64,
        /// The greatest length (s).
        most: f64,
    },
    /// The force acts in one direction only.
    #[error(
        "{test}: the force never acts in both directions, so the clearance is never passed through; a sensor that records the magnitude of \
         the force, or one whose zero is off by as much as the force, does that"
    )]
    OneSided {
        /// The test.
        test: String,
    },
    /// A test of indices that is none.
    #[error("table of indices, test {test}: {reason}")]
    Index {
        /// Its number, from 1.
        test: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// No start led anywhere.
    #[error("no start led to a damper; the nearest reason: {0}")]
    NoFit(String),
    /// Each search for the intervals met a better fit.
    #[error("each search for the intervals met a better fit than the {starts} starts led to")]
    FewStarts {
        /// The starts.
        starts: usize,
    },
    /// A fit that is no damper's, or recordings that no damper can have made.
    #[error("{finding}")]
    Implausible {
        /// What shows it.
        finding: Finding,
        /// What a user can do, the most likely first; each was tried and gives a result.
        advice: Vec<Advice>,
    },
    /// Numbers that the tests do not determine.
    #[error("{}", undetermined(numbers))]
    Undetermined {
        /// Keys and what the tests tell of them.
        numbers: Vec<(String, Determined)>,
    },
}

fn undetermined(numbers: &[(String, Determined)]) -> String {
    let mut text = String::from("the tests do not determine");
    for (key, number) in numbers {
        let partners = number.together_with.join("`, `");
        text += &match (number.is_felt, partners.is_empty()) {
            (false, _) => format!(
                "\n  {key}: no force of these tests changes with it by more than they scatter"
            ),
            (true, true) => {
                format!("\n  {key}: its effect is too small beside what the forces scatter by")
            }
            (true, false) => format!("\n  {key}: only together with `{partners}`"),
        };
    }
    text
}

impl CalibrationError {
    /// A finding before its causes were searched for.
    pub(super) fn implausible(finding: Finding) -> Self {
        Self::Implausible {
            finding,
            advice: Vec::new(),
        }
    }

    /// What a user can do about it, each entry by itself; none where the error's own words say all.
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
            Self::Undetermined { numbers } => {
                let of = |remedy: fn(String) -> Remedy| -> Advice {
                    numbers.iter().map(|(key, _)| remedy(key.clone())).collect()
                };
                vec![of(Remedy::Leave), of(Remedy::Know)]
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
