//! Bench tests of a sheet: each a periodic cycle at its temperature, and what became of its limits.

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::Element;

use super::bench_test::{Cycle, check_steps, run_until_periodic};
use super::response::Response;
use dashpot_files::damper::Keyed;
use dashpot_files::sheet::{Index, SheetFileError, SheetParameters, Test};

/// The key of the temperature of the oil.
const TEMPERATURE: &str = "oil.temperature_c";

/// A test and its periodic cycle.
#[derive(Clone, Debug)]
pub struct Tested<'a> {
    /// The test.
    pub test: &'a Test,
    /// Temperature of the oil (degC), where the damper has oil.
    pub temperature_c: Option<f64>,
    /// The cycle.
    pub cycle: Cycle,
}

impl Tested<'_> {
    /// The value of each index, in the order of [`Index::ALL`].
    pub fn values(&self) -> impl Iterator<Item = (Index, Option<f64>)> {
        Index::ALL
            .into_iter()
            .map(|index| (index, index_value(&self.cycle, index)))
    }
}

/// Value of an index for a cycle, in the unit of the index's key; `None` where the cycle does not define it.
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
        Index::DynamicStiffnessNPerM => Some(Response::of(cycle).stiffness_n_per_m()),
        Index::LossAngleDeg => Response::of(cycle).loss_angle_deg(),
    }
}

/// Runs every test of a sheet with steps of at most `step_s` (s), once all of them can be: `name` stands for the damper in errors.
///
/// # Errors
/// A temperature of a damper without oil or out of its range, a motion faster than the damper's limit or with too few steps in a cycle, a force that
/// does not become periodic; with the line of the test.
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
    let changed =
        Keyed::new(name, damper).and_then(|keyed| keyed.with(&[(TEMPERATURE, temperature_c)]));
    changed.map_err(|error| sheet.test_error(test, format!("temperature_c: {error}")))
}
