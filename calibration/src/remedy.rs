//! Remedies for errors, as data: each front end puts them into its own words.

use serde::Serialize;

/// One change that the user can make.
#[derive(Clone, Debug, PartialEq, Serialize)]
// Exhaustive, because each front end has its own words for every variant.
pub enum Remedy {
    /// Reverse the sign of the force.
    ReverseForce,
    /// Reverse the sign of the displacement.
    ReverseDisplacement,
    /// Multiply the displacement by this factor, because it was read in the wrong unit.
    ScaleDisplacement(f64),
    /// Multiply the force by this factor, because it was read in the wrong unit.
    ScaleForce(f64),
    /// Vary a parameter between these bounds.
    Bounds {
        /// Key of the parameter.
        key: String,
        /// Lower and upper bound.
        bounds: [f64; 2],
    },
    /// Vary these parameters too.
    VaryAlso(Vec<String>),
    /// Start from another damper.
    OtherDamper {
        /// Name of the preset.
        name: String,
        /// Parameters to vary instead if the preset lacks one of the current ones; otherwise empty.
        vary: Vec<String>,
    },
    /// Do not vary a parameter.
    Leave(String),
    /// Give a prior for a parameter.
    Know(String),
    /// Remove the prior of a parameter.
    Forget(String),
    /// Hold a rig parameter.
    Hold(String),
    /// Do not hold a rig parameter.
    Release(String),
    /// Set a parameter of the damper.
    Set {
        /// Key of the parameter.
        key: String,
        /// An allowed value.
        value: f64,
    },
    /// Search from this number of starting points.
    Starts(u16),
    /// Allow this misfit: the residual divided by the rms force (1).
    AllowMisfit(f64),
}

/// Remedies that must be applied together.
pub type Advice = Vec<Remedy>;

impl Remedy {
    /// Describes the cause that the remedy removes, as the start of a message; `None` if the remedy implies no cause.
    pub fn cause(&self) -> Option<String> {
        Some(match self {
            Self::ReverseForce => "the force has the opposite sign".into(),
            Self::ReverseDisplacement => "the displacement has the opposite sign".into(),
            Self::ScaleDisplacement(factor) => {
                format!(
                    "the displacement seems to be in another unit: {} too {}",
                    times(*factor),
                    size(*factor)
                )
            }
            Self::ScaleForce(factor) => {
                format!(
                    "the force seems to be in another unit: {} too {}",
                    times(*factor),
                    size(*factor)
                )
            }
            Self::Bounds { key, .. } => format!("{key} lies outside its bounds"),
            Self::VaryAlso(_) => {
                "the damper differs from the start in more parameters than those varied".into()
            }
            Self::OtherDamper { name, .. } => {
                format!(
                    "the starting damper is of the wrong kind; `{name}` explains the recordings"
                )
            }
            _ => return None,
        })
    }
}

fn times(factor: f64) -> String {
    let ratio = factor.max(1.0 / factor);
    format!("{ratio:.4} times").replace(".0000", "")
}

fn size(factor: f64) -> &'static str {
    if factor < 1.0 { "large" } else { "small" }
}
