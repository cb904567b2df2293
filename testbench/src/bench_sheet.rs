//! Runs the tests of a bench sheet: one periodic cycle per test, at the temperature of the test.

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::Element;

use super::bench_test::{Cycle, check_steps, run_until_periodic};
use super::response::Response;
use dashpot_files::damper::KeyedParameters;
use dashpot_files::sheet::{Index, SheetFileError, SheetParameters, Test};

/// Key of the oil temperature in a damper file.
const TEMPERATURE: &str = "oil.temperature_c";

/// A bench-sheet test and its result.
#[derive(Clone, Debug)]
pub struct Tested<'a> {
    /// The test.
    pub test: &'a Test,
    /// Oil temperature (degC); `None` for a damper without oil.
    pub temperature_c: Option<f64>,
    /// The periodic cycle.
    pub cycle: Cycle,
}

impl Tested<'_> {
    /// Returns the value of each index, in the order of [`Index::ALL`].
    pub fn values(&self) -> impl Iterator<Item = (Index, Option<f64>)> {
        Index::ALL
            .into_iter()
            .map(|index| (index, index_value(&self.cycle, index)))
    }
}

/// Returns the value of an index in the unit of its key; `None` if undefined, such as the asymmetry of zero force.
pub fn index_value(cycle: &Cycle, index: Index) -> Option<f64> {
    let indices = cycle.indices();
    match index {
        Index::MaxExtensionForceN => Some(indices.max_extension_force_n),
        Index::MaxCompressionForceN => Some(indices.max_compression_force_n),
        Index::ExtensionForceAtPeakVelocityN => Some(cycle.force_at_peak_velocity_n(1.0)),
        Index::CompressionForceAtPeakVelocityN => Some(-cycle.force_at_peak_velocity_n(-1.0)),
        Index::AsymmetryRate => indices.asymmetry_rate,
        Index::EnergyPerCycleJ => Some(indices.energy_per_cycle_j),
        Index::DampingCoefficientNSPerM => Some(indices.damping_coefficient_n_s_per_m),
        Index::DynamicStiffnessNPerM => Some(Response::from_cycle(cycle).stiffness_n_per_m()),
        Index::LossAngleDeg => Response::from_cycle(cycle).loss_angle_deg(),
    }
}

/// Checks all tests of a sheet, then runs each of them with steps of at most `step_s` (s).
///
/// `name` is the name of the damper in error messages.
///
/// # Errors
/// Returns an error, with the line of the test, for a temperature that is out of range or is given for a damper without
/// oil, a motion beyond the damper's limits, too few steps per cycle, or a force that does not become periodic.
pub fn run<'a>(
    sheet: &'a SheetParameters,
    name: &str,
    damper: &CheckedParameters,
    step_s: f64,
) -> Result<Vec<Tested<'a>>, SheetFileError> {
    let prepared = sheet.tests.iter().map(|test| {
        let damper = at_temperature(sheet, test, name, damper)?;
        check_steps(&damper, test.motion, step_s).map_err(|error| sheet.test_error(test, error))?;
        Ok((test, damper))
    });
    let prepared = prepared.collect::<Result<Vec<_>, SheetFileError>>()?;
    dashpot_workers::map(&prepared, |(test, damper)| {
        let cycle = run_until_periodic(damper, test.motion, step_s);
        Ok(Tested {
            test,
            temperature_c: match &damper.element {
                Element::Physical(hydraulics) => Some(hydraulics.oil.temperature_c),
                _ => None,
            },
            cycle: cycle.map_err(|error| sheet.test_error(test, error))?,
        })
    })
}

fn at_temperature(
    sheet: &SheetParameters,
    test: &Test,
    name: &str,
    damper: &CheckedParameters,
) -> Result<CheckedParameters, SheetFileError> {
    let Some(temperature_c) = test.temperature_c else {
        return Ok(damper.clone());
    };
    if matches!(damper.element, Element::Reduced(_)) {
        let message = format!(
            "temperature_c: the reduced damper {name} has no oil; allowed: a damper with [oil], or no temperature"
        );
        return Err(sheet.test_error(test, message));
    }
    let changed = KeyedParameters::new(name, damper)
        .and_then(|keyed| keyed.with(&[(TEMPERATURE, temperature_c)]));
    changed.map_err(|error| sheet.test_error(test, format!("temperature_c: {error}")))
}
