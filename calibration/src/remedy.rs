//! What a user can do about an error, as data: the command and the Python package word it in their own terms.

use serde::Serialize;

/// One thing that a user can do.
#[derive(Clone, Debug, PartialEq, Serialize)]
// Exhaustive: each front end has its own words for every one.
pub enum Remedy {
    /// Reverse the sign of the force.
    ReverseForce,
    /// Reverse the sign of the displacement.
    ReverseDisplacement,
    /// Multiply the displacement as it was read by this factor: it was read in a wrong unit.
    ScaleDisplacement(f64),
    /// Multiply the force as it was read by this factor.
    ScaleForce(f64),
    /// Vary a number between these bounds.
    Bounds {
        /// The number.
        key: String,
        /// The bounds.
        bounds: [f64; 2],
    },
    /// Vary these numbers too.
    VaryAlso(Vec<String>),
    /// Start from another damper.
    OtherDamper {
        /// The preset.
        name: String,
        /// The numbers to vary in place of those that do not exist there; empty where all of them do.
        vary: Vec<String>,
    },
    /// Do not vary a number.
    Leave(String),
    /// Say what is known of a number before.
    Know(String),
    /// Say nothing of what is known of a number before.
    Forget(String),
    /// Hold a number of the rig.
    Hold(String),
    /// Do not hold a number of the rig.
    Release(String),
    /// Set a number in the damper.
    Set {
        /// The number.
        key: String,
        /// A value that is allowed.
        value: f64,
    },
    /// Search from so many starts.
    Starts(u16),
    /// Allow the model to miss this part of the force.
    AllowMisfit(f64),
}

/// What must be done together.
pub type Advice = Vec<Remedy>;

impl Remedy {
    /// What the remedy says of the recordings, as the beginning of a message; `None` where it says nothing.
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
                "the damper differs from the start in more numbers than vary".into()
            }
            Self::OtherDamper { name, .. } => {
                format!("the start is another kind of damper: `{name}` explains the recordings")
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
