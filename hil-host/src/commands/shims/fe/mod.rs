//! `dashpot shims --fe`: analyses the stacks as thin plates.

mod chart;
mod options;
mod panel;
mod plots;
mod report;

use std::f64::consts::FRAC_PI_4;

use dashpot_core::characteristic::ShimPackValve;
use dashpot_core::parameters::{DamperParameters, Hydraulics};

pub use options::{PlateArguments, ValveName};
pub(super) use plots::draw;
pub(super) use report::{PlateReport, print};

use crate::commands::failure::{Failure, Outcome};
use dashpot_testbench::plate::{
    Bending, Fit, PlateError, PressureArea, Resolution, Stack, assumed_area, fits,
};
use dashpot_testbench::shim_valves::{VALVE_LOCATIONS, ValveLocation};

/// Solved plate model of a valve's stack.
pub(super) struct Solved {
    location: &'static ValveLocation,
    stack: Stack,
    /// Bending under pressure on the whole disc.
    whole: Bending,
    /// Pressure area and the resulting bending; `None` if no area of the assumed kind has the valve's Ce.
    real: Option<(PressureArea, Bending)>,
    /// True if the area was given, false if it was assumed and fitted.
    given: bool,
    /// Ce of the damper file.
    factor: f64,
    preload_pa: f64,
    /// Pressure at the force limit of the damper (Pa).
    at_force_limit_pa: f64,
    fits: Vec<Fit>,
}

/// Solves the stacks of all valves that have shims.
///
/// # Errors
/// The pressure area is invalid, or no valve has shims.
pub(super) fn solve(
    arguments: &PlateArguments,
    parameters: &DamperParameters,
    hydraulics: &Hydraulics,
) -> Outcome<Vec<Solved>> {
    let named = arguments.valve.map(ValveName::location);
    if let Some(location) = named
        && location.valve_of(hydraulics).shims_m.is_empty()
    {
        return Err(Failure::wrong_use(format!(
            "--valve: {} has no shims_m; allowed: a valve whose shims the damper file describes",
            location.section
        )));
    }
    let with_shims = VALVE_LOCATIONS
        .iter()
        .filter(|location| !location.valve_of(hydraulics).shims_m.is_empty());
    let solved: Vec<Solved> = with_shims
        .map(|location| {
            let named = named.is_some_and(|named| named.section == location.section);
            let limit = force_limit_pressure_pa(parameters, hydraulics, location);
            solve_valve(arguments, location, named, limit, hydraulics)
        })
        .collect::<Outcome<_>>()?;
    if solved.is_empty() {
        return Err(Failure::new(
            "--fe: no valve of the damper has shims_m; allowed: a damper file that describes its shims",
        ));
    }
    Ok(solved)
}

fn solve_valve(
    arguments: &PlateArguments,
    location: &'static ValveLocation,
    named: bool,
    at_force_limit_pa: f64,
    hydraulics: &Hydraulics,
) -> Outcome<Solved> {
    let valve = location.valve_of(hydraulics);
    let stack = Stack::new(location.section, valve, arguments.stacking())?;
    let resolution = Resolution::default();
    let factor = valve.equivalent_pressure_factor;
    let given = if named { arguments.area(&stack)? } else { None };
    let area = match given {
        Some(area) => Some(area),
        None => match assumed_area(location.valve, &stack, factor, resolution) {
            Ok(area) => Some(area),
            Err(PlateError::OutOfReach { .. }) => None,
            Err(error) => return Err(error.into()),
        },
    };
    let real = match area {
        Some(area) => Some((area, stack.bend(&area, resolution)?)),
        None => None,
    };
    let whole = PressureArea::whole(stack.clamp_radius_m(), stack.free_radius_m());
    Ok(Solved {
        whole: stack.bend(&whole, resolution)?,
        fits: fits(location.valve, &stack, factor, resolution)?,
        location,
        stack,
        real,
        given: given.is_some(),
        factor,
        preload_pa: valve.preload_pa,
        at_force_limit_pa,
    })
}

/// Returns the pressure at which the damper yields, `(F_limit - F_c)/A` (Pa).
///
/// A is the area of the rod-side annulus in extension and of the piston in compression.
fn force_limit_pressure_pa(
    parameters: &DamperParameters,
    hydraulics: &Hydraulics,
    location: &ValveLocation,
) -> f64 {
    let geometry = &hydraulics.geometry;
    let rod = match location.valve {
        ShimPackValve::PistonExtension => geometry.rod_diameter_m,
        _ => 0.0,
    };
    let area = FRAC_PI_4 * (geometry.piston_diameter_m.powi(2) - rod * rod);
    let friction = hydraulics.seal.as_ref().map_or(0.0, |seal| seal.friction_n);
    (parameters.limits.force_n - friction) / area
}

impl Solved {
    /// Returns the bending under the pressure area if it is known, otherwise under pressure on the whole disc.
    fn bending(&self) -> &Bending {
        self.real
            .as_ref()
            .map_or(&self.whole, |(_, bending)| bending)
    }
}
