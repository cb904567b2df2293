//! Axes of a sweep: parameters and their values.

use std::fmt;
use std::path::Path;

use crate::case::CaseOptions;
use crate::contact::{ContactOptions, TABLE};
use crate::overrides::did_you_mean;
use crate::shipped::resolve_name;
use crate::vehicle::Replacement;

/// Value of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A name.
    Word(String),
}

impl Value {
    /// Converts a TOML value.
    ///
    /// # Errors
    /// Returns an error message if the value is neither a number nor a name.
    pub(super) fn from_toml(value: toml::Value) -> Result<Self, String> {
        match value {
            toml::Value::Integer(number) => Ok(Self::Number(number as f64)),
            toml::Value::Float(number) => Ok(Self::Number(number)),
            toml::Value::String(word) => Ok(Self::Word(word)),
            other => Err(format!("value {other}, allowed: numbers and names")),
        }
    }

    /// Resolves a name that a file in `folder` contains.
    pub(super) fn resolve_name(self, folder: &Path) -> Self {
        match self {
            Self::Word(word) => Self::Word(resolve_name(folder, &word)),
            number => number,
        }
    }
}

/// True if the values of a parameter may be file names.
pub(super) fn may_name_files(parameter: &str) -> bool {
    match parameter.split_once('.') {
        Some((table, key)) => table == TABLE && ContactOptions::FILES.contains(&key),
        None => !CaseOptions::NUMBERS.contains(&parameter) && parameter != WORN_DAMPER,
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Word(word) => f.write_str(word),
        }
    }
}

/// Formats a number with at most six decimals, which hides the rounding errors of a factor. A number too small for six
/// decimals has an exponent.
///
/// ```
/// assert_eq!(dashpot_files::study::format_number(0.1 + 0.2), "0.3");
/// ```
pub fn format_number(number: f64) -> String {
    let text = format!("{number:.6}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "0" | "-0" if number != 0.0 => format!("{number:e}"),
        text => text.to_owned(),
    }
}

/// Parameter and its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// One of: a number of the case (`speed_km_h`); `vehicle` or `track`; `dampers.table.key` or `part.key` as in an
    /// override of the vehicle; `contact.key`; dampers to replace (`vertical`); or `worn_damper`.
    pub parameter: String,
    /// Values, in the order of the cases.
    pub values: Vec<Value>,
    /// Overrides of a worn damper, each `table.key=value`.
    pub set: Vec<String>,
    /// Label of the axis in figures.
    pub label: String,
    /// Factor by which figures multiply the values.
    pub factor: f64,
}

/// Parameter whose values name the damper that is worn; [`NO_DAMPER`] leaves all dampers as new.
pub const WORN_DAMPER: &str = "worn_damper";
/// Value of [`WORN_DAMPER`] for no worn damper.
pub const NO_DAMPER: &str = "none";

/// Maximum number of values of an axis.
pub(super) const MAX_VALUES: usize = 10_000;

impl Axis {
    /// Sets the parameter of a case to a value.
    ///
    /// # Errors
    /// Returns an error message for an unknown parameter, for a number where a name is needed, or for a name where a
    /// number is needed.
    pub fn apply(&self, case: &mut CaseOptions, value: &Value) -> Result<(), String> {
        let parameter = self.parameter.as_str();
        let is_number = CaseOptions::NUMBERS.contains(&parameter);
        match (parameter, value) {
            (_, Value::Number(number)) if is_number => case.set_number(parameter, *number),
            ("vehicle", Value::Word(name)) => case.set_vehicle(name),
            ("track", Value::Word(name)) => case.set_track(name),
            (WORN_DAMPER, Value::Word(damper)) => {
                let full_path = |change: &String| format!("{damper}.{change}");
                if damper != NO_DAMPER {
                    case.overrides.extend(self.set.iter().map(full_path));
                }
            }
            (path, value) if path.contains('.') => {
                let value = match value {
                    Value::Number(number) => toml::Value::Float(*number),
                    Value::Word(word) => toml::Value::String(word.clone()),
                };
                case.overrides.push(format!("{path}={value}"));
            }
            (dampers, Value::Word(damper)) if !is_number => case
                .dampers
                .push(Replacement::named(dampers.to_owned(), damper.clone())),
            (_, Value::Word(word)) => return Err(format!("\"{word}\", allowed: a number")),
            ("vehicle" | "track" | WORN_DAMPER, Value::Number(number)) => {
                return Err(format!("{number}, allowed: a name in quotes"));
            }
            (unknown, _) => {
                let words = ["vehicle", "track", WORN_DAMPER];
                let known = CaseOptions::NUMBERS.into_iter().chain(words);
                return Err(format!(
                    "no such numeric parameter, allowed: {}, or a path such as vertical.mount.clearance_m{}",
                    CaseOptions::NUMBERS.join(", "),
                    did_you_mean(unknown, known)
                ));
            }
        }
        Ok(())
    }
}

/// Returns `count` numbers with equal differences, or with equal ratios if `geometric`; both ends are included.
pub(super) fn range(from: f64, to: f64, count: usize, geometric: bool) -> Vec<Value> {
    let share = |i: usize| i as f64 / (count.max(2) - 1) as f64;
    let at = |i: usize| match i {
        0 => from,
        _ if i + 1 == count => to,
        _ if geometric => from * libm::exp(share(i) * libm::log(to / from)),
        _ => from + share(i) * (to - from),
    };
    (0..count).map(|i| Value::Number(rounded(at(i)))).collect()
}

/// Rounds to twelve digits, so that 0.1 + 0.2 is 0.3.
fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}
