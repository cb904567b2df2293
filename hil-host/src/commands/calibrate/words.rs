//! A calibration's errors and warnings in the words of the command: what to do, as options.

use crate::commands::failure::Failure;
use dashpot_calibration::{Advice, CalibrationError, Finding, Remedy, SKEW, Warning};
use dashpot_recording::{Quantity, Unit};

/// What the command line says already, so that advice goes with it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Given {
    /// Unit of the displacement, where an option gives one.
    pub displacement_unit: Option<Unit>,
    /// Unit of the force, where an option gives one.
    pub force_unit: Option<Unit>,
    /// Whether the displacement is reversed.
    pub displacement_is_reversed: bool,
    /// Whether the force is reversed.
    pub force_is_reversed: bool,
    /// Whether the damper has overrides.
    pub has_overrides: bool,
    /// Whether `--no-skew` holds the skew.
    pub has_no_skew: bool,
}

/// Options to add and options to leave out.
#[derive(Debug, Default)]
struct Change {
    add: Vec<String>,
    leave_out: Vec<String>,
}

/// The failure that `error` is, beside the options `given`.
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

/// The error and what to do about it.
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
        CalibrationError::Twice { key } => format!("{key}: an option names it twice"),
        other => other.to_string(),
    };
    let advice = error.advice();
    let said: Vec<String> = advice.iter().map(|advice| said(advice, given)).collect();
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
                    said.join(", or ")
                )
            }
            None => nothing_found(finding, &what, &said),
        },
        CalibrationError::Undetermined { .. } => {
            format!("{what}\n{}, or add a test that decides", said.join(", or "))
        }
        _ if said.is_empty() => what,
        _ => format!("{what}; {}", said.join(", or ")),
    }
}

/// Where no cause was found.
fn nothing_found(finding: &Finding, what: &str, said: &[String]) -> String {
    let tried = "no sign, unit, bound or preset that was tried explains the recordings";
    match finding {
        Finding::Missed { .. } => format!(
            "{what}\n  {tried}: the law of this damper lacks something that they have; to have the nearest fit all the same, {}",
            said.join(", or ")
        ),
        Finding::AtBound { .. } => format!(
            "{what}\n  {tried}; to have the best value within these bounds all the same, {}",
            said.join(", or ")
        ),
        Finding::Driven { .. } => format!(
            "{what}\n  the force or the displacement has the opposite sign: use `--reverse-force`, or use `--reverse-displacement`"
        ),
        _ => format!("{what}\n  look at the unit (--displacement-unit) and at the time"),
    }
}

/// What to do, in a sentence without an end.
fn said(advice: &Advice, given: &Given) -> String {
    let mut change = Change::default();
    for remedy in advice {
        change.take(remedy, given);
    }
    let quoted = |options: &[String], between: &str| format!("`{}`", options.join(between));
    let add = (!change.add.is_empty()).then(|| format!("use {}", quoted(&change.add, " ")));
    let leave = (!change.leave_out.is_empty())
        .then(|| format!("leave out {}", quoted(&change.leave_out, "` and `")));
    [add, leave]
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
                let [least, greatest] = bounds;
                self.add
                    .push(format!("--vary {key}={least:e}:{greatest:e}"));
            }
            Remedy::VaryAlso(keys) => self.vary(keys),
            Remedy::OtherDamper { name, vary } => {
                self.add.push(format!("--damper {name}"));
                self.vary(vary);
                if !vary.is_empty() {
                    self.leave_out.push("every other --vary".into());
                }
                if given.has_overrides {
                    self.leave_out.push("every other --set".into());
                }
            }
            Remedy::Leave(key) => self.leave_out.push(format!("--vary {key}")),
            Remedy::Know(key) => self.add.push(format!("--prior {key}=MEAN:DEVIATION")),
            Remedy::Forget(key) => self.leave_out.push(format!("--prior {key}")),
            Remedy::Hold(key) => self.add.push(format!("--hold {key}=VALUE")),
            Remedy::Release(key) if key == SKEW && given.has_no_skew => {
                self.leave_out.push("--no-skew".into());
            }
            Remedy::Release(key) => self.leave_out.push(format!("--hold {key}")),
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
            &mut self.leave_out
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

/// The unit in which numbers are that were read in the unit `given`, or in that of SI or the file's, and must be multiplied by `factor`.
fn unit_read(quantity: Quantity, given: Option<Unit>, factor: f64) -> &'static str {
    let units = quantity.units();
    let read = given.map_or(units, |given| {
        units
            .iter()
            .position(|unit| unit.name() == given.name())
            .map_or(units, |number| &units[number..=number])
    });
    let is_of =
        |unit: &Unit, read: &Unit| (unit.to_si(1.0) / read.to_si(factor) - 1.0).abs() < 1e-6;
    let pairs = read
        .iter()
        .flat_map(|read| units.iter().map(move |unit| (unit, read)));
    let mut found = pairs.filter(|(unit, read)| is_of(unit, read));
    found.next().map_or("UNIT", |(unit, _)| unit.name())
}

/// A warning, as a line for people.
pub(super) fn line(warning: &Warning) -> String {
    match warning {
        Warning::Missed {
            test,
            missed_n,
            noise_n,
        } => format!(
            "warning: {test}: the model misses {missed_n:.0} N where the force scatters by {noise_n:.0} N: it lacks something that this test \
             has, and no interval includes that"
        ),
        Warning::ZeroDiffers { test, mean_n } => format!(
            "warning: {test}: the zero of the force differs by {:.0} N from that of the other tests: calibrate it apart",
            -mean_n
        ),
        Warning::AtBound {
            key,
            bound,
            is_physical: true,
        } => format!(
            "note: {key} is {}, as far as a damper goes",
            super::report::digits(*bound)
        ),
        Warning::AtBound { key, bound, .. } => format!(
            "warning: {key} is at the bound {} that you gave, so the best value lies beyond it; --vary {key}=LEAST:GREATEST gives others",
            super::report::digits(*bound)
        ),
        Warning::Close { a, b, correlation } => {
            format!("note: {a} and {b} are hardly told apart: correlation {correlation:.3}")
        }
        Warning::Assumed {
            key,
            assumed,
            value,
            uncertainty,
            shift_percent,
        } => format!(
            "warning: {key} moves by {shift_percent:.2} % when {assumed} is {value} +- {uncertainty}, more than by the noise of the tests; they \
             do not tell the two apart. The interval includes it: {} sets how well you know it",
            uncertainty_option(assumed)
        ),
        Warning::FitsBetter {
            assumed,
            value,
            better,
        } => format!(
            "warning: these recordings fit better at {assumed} {better} than at {value}: look at the thermometer; --set {assumed}={better:e} takes \
             that value"
        ),
    }
}

/// The option with the uncertainty of an assumed number.
pub(super) fn uncertainty_option(key: &str) -> &'static str {
    if key == dashpot_calibration::TEMPERATURE {
        "--temperature-uncertainty-k"
    } else {
        "--density-uncertainty-kg-per-m3"
    }
}
