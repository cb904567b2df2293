//! Rolling radius difference of a wheelset on elastic patches, over its lateral shift.

use dashpot_rail::indices::{RollingRadiusDifference, RollingRadiusError};

use super::pressed::Press;
use super::{LoadedWheelset, MAX_LATERAL_M, certain};

/// Shifts to one side, 0.1 mm apart; elastic patches move smoothly over them.
const STEPS: i32 = 120;
/// Neighbouring shifts that one thread computes, each from the solution of the previous one.
const RUN: usize = 11;

/// Difference between the right and the left rolling radius at every shift; see
/// [`LoadedWheelset::rolling_radius_difference`].
pub(super) fn difference(
    wheelset: &LoadedWheelset,
) -> Result<RollingRadiusDifference, RollingRadiusError> {
    let is_symmetric = wheelset.is_symmetric();
    let first = if is_symmetric { 0 } else { -STEPS };
    let steps: Vec<i32> = (first..=STEPS).collect();
    let runs: Vec<&[i32]> = steps.chunks(RUN).collect();
    let differences: Vec<Option<f64>> = certain(dashpot_workers::map(&runs, |run| {
        let mut press = Press::new(wheelset);
        let difference_m = |step: &i32| {
            let pressed = press.at(shift_m(*step), 0.0)?;
            let [left, right] = &pressed.wheels;
            Some(right.radius_beyond_datum_m() - left.radius_beyond_datum_m())
        };
        Ok(run.iter().map(difference_m).collect::<Vec<_>>())
    }))
    .concat();
    let at = |step: i32| {
        let mirrored = if is_symmetric && step < 0 { -1.0 } else { 1.0 };
        let index = if is_symmetric {
            step.abs()
        } else {
            step - first
        };
        Some(mirrored * differences[usize::try_from(index).ok()?]?)
    };
    // Beyond the last shift at which both wheels stand on their rails, the wheelset climbs.
    let reach = (0..=STEPS)
        .take_while(|step| at(*step).is_some() && at(-step).is_some())
        .last()
        .unwrap_or(0);
    let shifts: Vec<i32> = (-reach..=reach).collect();
    RollingRadiusDifference::new(
        shifts.iter().map(|step| shift_m(*step)).collect(),
        shifts.iter().filter_map(|step| at(*step)).collect(),
    )
}

fn shift_m(step: i32) -> f64 {
    MAX_LATERAL_M * f64::from(step) / f64::from(STEPS)
}
