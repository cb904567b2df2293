//! Why a calibration has no result.

use dashpot_core::BuildError;

use super::determined::Determined;
use crate::files::damper::DamperError;
use crate::study::StudyError;

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
    Study(#[from] StudyError),
    /// Nobody wants the result any more.
    #[error("ended before its end, as was asked")]
    Unwanted,
    /// A number that forces do not tell.
    #[error("{key}: it is measured on the part, not found from forces; set it in the damper")]
    NotVaried {
        /// The number.
        key: String,
    },
    /// Bounds that are none, or beyond what a damper may have.
    #[error(
        "{key}: bounds {} to {}, allowed: the lesser first, within {allowed}, and above 0 where ratios count; when none are given: \
         {plausible}",
        bounds[0],
        bounds[1]
    )]
    Bounds {
        /// The number.
        key: String,
        /// The bounds.
        bounds: [f64; 2],
        /// What a damper file may have.
        allowed: &'static str,
        /// The bounds used where none are given.
        plausible: String,
    },
    /// A start outside the bounds.
    #[error("{key}: the damper has {start}, outside the bounds {} to {}; set it in the damper, or give other bounds", bounds[0], bounds[1])]
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
        "{test}: the force never acts in both directions, so the clearance is never passed through; look at the sign and the zero of \
         the force"
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
    text + "\nleave it as it is (do not vary it), give what is known of it before, or add a test that it decides"
}
