//! Dampers of a case whose force comes from elsewhere.

use dashpot_files::case::Case;
use dashpot_files::did_you_mean;

/// Why a damper cannot be outside.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutsideError {
    /// The vehicle has none of this name.
    #[error("no damper `{name}`{near}, allowed: {allowed}")]
    NoDamper {
        /// The name.
        name: String,
        /// The nearest one, in words.
        near: String,
        /// All there are.
        allowed: String,
    },
    /// It is outside already.
    #[error("the damper is given twice, allowed: once")]
    Twice,
    /// It changes on the way.
    #[error("the case changes this damper at {time_s} s, allowed: dampers without faults")]
    Changed {
        /// When, s.
        time_s: f64,
    },
}

/// The number of the damper called `name` among those of the vehicle, to be outside beside those of the numbers `others`.
///
/// # Errors
/// A damper that there is not, is one of the others, or has a fault on the way.
///
/// ```
/// use dashpot_files::case::Case;
/// use dashpot_vehicle_run::number_outside;
/// let case = Case::load("straight-180")?;
/// assert_eq!(number_outside(&case, "front lateral damper 1", &[])?, 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn number_outside(case: &Case, name: &str, others: &[usize]) -> Result<usize, OutsideError> {
    let names = || case.vehicle.dampers().map(|element| element.name.as_str());
    let number = names()
        .position(|other| other == name)
        .ok_or_else(|| OutsideError::NoDamper {
            name: name.to_owned(),
            near: did_you_mean(name, names()),
            allowed: names().collect::<Vec<_>>().join(", "),
        })?;
    if others.contains(&number) {
        return Err(OutsideError::Twice);
    }
    match case.faults.iter().find(|fault| fault.damper == name) {
        Some(fault) => Err(OutsideError::Changed {
            time_s: fault.time_s,
        }),
        None => Ok(number),
    }
}
