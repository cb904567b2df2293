//! Selection of dampers whose force comes from outside the model.

use dashpot_files::case::Case;
use dashpot_files::did_you_mean;

/// Error from selecting a damper whose force comes from outside.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutsideError {
    /// Unknown damper name.
    #[error("no damper `{name}`{near}; allowed: {allowed}")]
    NoDamper {
        /// Requested name.
        name: String,
        /// Suggestion with the nearest name, or empty.
        near: String,
        /// All damper names of the vehicle.
        allowed: String,
    },
    /// The damper was selected twice.
    #[error("the damper is given twice; allowed: once")]
    Twice,
    /// The case has a fault of this damper.
    #[error("the case changes this damper at {time_s} s; allowed: dampers without faults")]
    Changed {
        /// Time of the fault, s.
        time_s: f64,
    },
}

/// Returns the index of the damper `name` in the vehicle; `selected` lists the indices of the dampers that are already
/// selected.
///
/// # Errors
/// Unknown damper, damper in `selected`, or damper with a fault in the case.
///
/// ```
/// use dashpot_files::case::Case;
/// use dashpot_vehicle_run::outside_index;
/// let case = Case::load("straight-180")?;
/// assert_eq!(outside_index(&case, "front lateral damper 1", &[])?, 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn outside_index(case: &Case, name: &str, selected: &[usize]) -> Result<usize, OutsideError> {
    let names = || case.vehicle.dampers().map(|element| element.name.as_str());
    let index = names()
        .position(|other| other == name)
        .ok_or_else(|| OutsideError::NoDamper {
            name: name.to_owned(),
            near: did_you_mean(name, names()),
            allowed: names().collect::<Vec<_>>().join(", "),
        })?;
    if selected.contains(&index) {
        return Err(OutsideError::Twice);
    }
    match case.faults.iter().find(|fault| fault.damper == name) {
        Some(fault) => Err(OutsideError::Changed {
            time_s: fault.time_s,
        }),
        None => Ok(index),
    }
}
