//! Errors and warnings of a calibration, with remedies expressed as command-line options.

use super::digits::digits;
use crate::commands::failure::Failure;
use dashpot_calibration::{Advice, CalibrationError, Finding, Remedy, SKEW, Warning};
use dashpot_recording::{Quantity, Unit};

/// Options already on the command line, so that advice does not repeat or contradict them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Given {
    /// Unit of the displacement, if an option gives one.
    pub displacement_unit: Option<Unit>,
    /// Unit of the force, if an option gives one.
    pub force_unit: Option<Unit>,
    /// True if the displacement is reversed.
    pub displacement_is_reversed: bool,
    /// True if the force is reversed.
    pub force_is_reversed: bool,
    /// True if the damper has overrides.
    pub has_overrides: bool,
    /// True if `--no-skew` fixes the skew.
    pub has_no_skew: bool,
}

/// Options to add and options to remove.
#[derive(Debug, Default)]
struct Change {
    add: Vec<String>,
    remove: Vec<String>,
}

impl From<CalibrationError> for Failure {
    fn from(error: CalibrationError) -> Self {
        failure(error, &Given::default())
    }
}

/// Converts `error` to a command failure with advice that fits the options in `given`.
pub fn failure(error: CalibrationError, given: &Given) -> Failure {
    match error {
        CalibrationError::Damper(error) => error.into(),
        CalibrationError::Study(error) => error.into(),
        CalibrationError::NotVaried { .. }
        | CalibrationError::NoForceDepends { .. }
        | CalibrationError::Bounds { .. }
        | CalibrationError::Start { .. }
        | CalibrationError::Prior { .. }
        | CalibrationError::Twice { .. }
        | CalibrationError::PriorOfHeld { .. }
        | CalibrationError::NotOfRig { .. }
        | CalibrationError::HeldAndVaried { .. }
        | CalibrationError::Held { .. }
        | CalibrationError::NoLoops { .. } => Failure::wrong_use(message(&error, given)),
        _ => Failure::new(message(&error, given)),
    }
}

/// Returns the error text with its remedies.
fn message(error: &CalibrationError, given: &Given) -> String {
    let what = match error {
        CalibrationError::Bounds { .. }
        | CalibrationError::Start { .. }
        | CalibrationError::NotVaried { .. } => format!("--vary {error}"),
        CalibrationError::Prior { .. } => format!("--prior {error}"),
        CalibrationError::PriorOfHeld { .. } => format!("--{error}"),
        CalibrationError::NotOfRig { .. }
        | CalibrationError::HeldAndVaried { .. }
        | CalibrationError::Held { .. } => format!("--hold {error}"),
        CalibrationError::Twice { key } => format!("{key}: given twice by the same option"),
        other => other.to_string(),
    };
    let advice = error.advice();
    let remedies: Vec<String> = advice
        .iter()
        .map(|advice| instruction(advice, given))
        .collect();
    match error {
        CalibrationError::Implausible {
            advice: found,
            finding,
        } => match found.first() {
            Some(first) => {
                let causes: Vec<String> = first.iter().filter_map(Remedy::cause).collect();
                format!(
                    "{}: {}\n  {what}",
                    causes.join(", and "),
                    remedies.join(", or ")
                )
            }
            None => without_cause(finding, &what, &remedies),
        },
        CalibrationError::Undetermined { .. } => {
            format!(
                "{what}\n{}, or add a test that separates them",
                remedies.join(", or ")
            )
        }
        _ if remedies.is_empty() => what,
        _ => format!("{what}; {}", remedies.join(", or ")),
    }
}

/// Returns the message about an implausible result whose cause was not identified.
fn without_cause(finding: &Finding, what: &str, remedies: &[String]) -> String {
    let tried = "no sign, unit, bound or preset that was tried explains the recordings";
    match finding {
        Finding::Missed { .. } => format!(
            "{what}\n  {tried}: this damper model lacks an effect that they contain; to accept the closest fit \
             anyway, {}",
            remedies.join(", or ")
        ),
        Finding::AtBound { .. } => format!(
            "{what}\n  {tried}; to accept the best value within these bounds anyway, {}",
            remedies.join(", or ")
        ),
        Finding::Driven { .. } => format!(
            "{what}\n  the force or the displacement has the opposite sign: use `--reverse-force`, or use \
             `--reverse-displacement`"
        ),
        _ => format!(
            "{what}\n  check the displacement unit (--displacement-unit) and the time column"
        ),
    }
}

/// Phrases `advice` as an instruction, without a full stop.
fn instruction(advice: &Advice, given: &Given) -> String {
    let mut change = Change::default();
    for remedy in advice {
        change.take(remedy, given);
    }
    let quoted = |options: &[String], between: &str| format!("`{}`", options.join(between));
    let add = (!change.add.is_empty()).then(|| format!("use {}", quoted(&change.add, " ")));
    let remove = (!change.remove.is_empty())
        .then(|| format!("remove {}", quoted(&change.remove, "` and `")));
    [add, remove]
        .into_iter()
        .flatten()
        .collect::<Vec<_>>()
        .join(" and ")
}

impl Change {
    fn take(&mut self, remedy: &Remedy, given: &Given) {
        match remedy {
            Remedy::ReverseForce => self.switch("--reverse-force", given.force_is_reversed),
            Remedy::ReverseDisplacement => {
                self.switch("--reverse-displacement", given.displacement_is_reversed);
            }
            Remedy::ScaleDisplacement(factor) => {
                let unit = unit_read(Quantity::Displacement, given.displacement_unit, *factor);
                self.add.push(format!("--displacement-unit {unit}"));
            }
            Remedy::ScaleForce(factor) => {
                let unit = unit_read(Quantity::Force, given.force_unit, *factor);
                self.add.push(format!("--force-unit {unit}"));
            }
            Remedy::Bounds { key, bounds } => {
                let [min, max] = bounds;
                self.add.push(format!("--vary {key}={min:e}:{max:e}"));
            }
            Remedy::VaryAlso(keys) => self.vary(keys),
            Remedy::OtherDamper { name, vary } => {
                self.add.push(format!("--damper {name}"));
                self.vary(vary);
                if !vary.is_empty() {
                    self.remove.push("every other --vary".into());
                }
                if given.has_overrides {
                    self.remove.push("every other --set".into());
                }
            }
            Remedy::Leave(key) => self.remove.push(format!("--vary {key}")),
            Remedy::Know(key) => self.add.push(format!("--prior {key}=MEAN:DEVIATION")),
            Remedy::Forget(key) => self.remove.push(format!("--prior {key}")),
            Remedy::Hold(key) => self.add.push(format!("--hold {key}=VALUE")),
            Remedy::Release(key) if key == SKEW && given.has_no_skew => {
                self.remove.push("--no-skew".into());
            }
            Remedy::Release(key) => self.remove.push(format!("--hold {key}")),
            Remedy::Set { key, value } => self.add.push(format!("--set {key}={value:e}")),
            Remedy::Starts(starts) => self.add.push(format!("--starts {starts}")),
            Remedy::AllowMisfit(part) => {
                self.add
                    .push(format!("--max-misfit-percent {:.0}", 100.0 * part));
            }
        }
    }

    fn switch(&mut self, option: &str, is_given: bool) {
        let list = if is_given {
            &mut self.remove
        } else {
            &mut self.add
        };
        list.push(option.into());
    }

    fn vary(&mut self, keys: &[String]) {
        self.add
            .extend(keys.iter().map(|key| format!("--vary {key}")));
    }
}

/// Returns the unit that corrects a wrong scale.
///
/// The values were read in the unit `given`, or else in SI or the file's own unit, and must be multiplied by `factor`.
fn unit_read(quantity: Quantity, given: Option<Unit>, factor: f64) -> &'static str {
    let units = quantity.units();
    let read = given.map_or(units, |given| {
        units
            .iter()
            .position(|unit| unit.name() == given.name())
            .map_or(units, |number| &units[number..=number])
    });
    let matches =
        |unit: &Unit, read: &Unit| (unit.to_si(1.0) / read.to_si(factor) - 1.0).abs() < 1e-6;
    let pairs = read
        .iter()
        .flat_map(|read| units.iter().map(move |unit| (unit, read)));
    let mut found = pairs.filter(|(unit, read)| matches(unit, read));
    found.next().map_or("UNIT", |(unit, _)| unit.name())
}

/// Formats a warning as one line of text.
pub(super) fn line(warning: &Warning) -> String {
    match warning {
        Warning::Missed {
            test,
            missed_n,
            noise_n,
        } => format!(
            "warning: {test}: the residual is {missed_n:.0} N but the noise only {noise_n:.0} N: the model lacks an \
             effect that this test contains, and the intervals do not account for it"
        ),
        Warning::ZeroDiffers { test, mean_n } => format!(
            "warning: {test}: the zero of the force differs by {:.0} N from that of the other tests: calibrate this \
             test separately",
            -mean_n
        ),
        Warning::AtBound {
            key,
            bound,
            is_physical: true,
        } => format!("note: {key} is at its physical limit, {}", digits(*bound)),
        Warning::AtBound { key, bound, .. } => format!(
            "warning: {key} is at the bound {} that you gave, so the best value lies beyond it; set other bounds with \
             --vary {key}=MIN:MAX",
            digits(*bound)
        ),
        Warning::Close { a, b, correlation } => {
            format!("note: the tests hardly separate {a} and {b}: correlation {correlation:.3}")
        }
        Warning::Assumed {
            key,
            assumed,
            value,
            uncertainty,
            shift_percent,
        } => format!(
            "warning: {key} shifts by {shift_percent:.2} % if {assumed} is {value} +- {uncertainty}; the noise of the \
             tests shifts it less. The tests cannot separate the two. The interval includes this shift; set the \
             uncertainty with {}",
            uncertainty_option(assumed)
        ),
        Warning::FitsBetter {
            assumed,
            value,
            better,
        } => format!(
            "warning: the recordings fit better with {assumed} {better} than with {value}: check the thermometer; to \
             use that value, add --set {assumed}={better:e}"
        ),
    }
}

/// Returns the option that sets the uncertainty of an assumed parameter.
pub(super) fn uncertainty_option(key: &str) -> &'static str {
    if key == dashpot_calibration::TEMPERATURE {
        "--temperature-uncertainty-k"
    } else {
        "--density-uncertainty-kg-per-m3"
    }
}
