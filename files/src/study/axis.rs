//! What varies in a sweep.

use std::fmt;
use std::path::Path;

use crate::case::CaseOptions;
use crate::overrides::nearest;
use crate::shipped::named_in;
use crate::vehicle::Replacement;

/// A value of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A name.
    Word(String),
}

impl Value {
    /// Of a value in TOML.
    ///
    /// # Errors
    /// Neither number nor name; in words.
    pub(super) fn of(value: toml::Value) -> Result<Self, String> {
        match value {
            toml::Value::Integer(number) => Ok(Self::Number(number as f64)),
            toml::Value::Float(number) => Ok(Self::Number(number)),
            toml::Value::String(word) => Ok(Self::Word(word)),
            other => Err(format!("value {other}, allowed: numbers and names")),
        }
    }

    /// A name as it stands in a file of `folder`.
    pub(super) fn named_in(self, folder: &Path) -> Self {
        match self {
            Self::Word(word) => Self::Word(named_in(folder, &word)),
            number => number,
        }
    }
}

/// Whether the values of a parameter may be names of files.
pub(super) fn names_files(parameter: &str) -> bool {
    let is_number = CaseOptions::NUMBERS.contains(&parameter);
    !is_number && parameter != WORN_DAMPER && !parameter.contains('.')
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Word(word) => f.write_str(word),
        }
    }
}

/// A number as it is shown: without the last digits that a factor leaves.
pub fn shown(number: f64) -> String {
    let text = format!("{number:.6}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "0" | "-0" if number != 0.0 => format!("{number:e}"),
        text => text.to_owned(),
    }
}

/// A parameter and its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// A number of the case (`speed_km_h`), `vehicle` or `track`; `dampers.table.key` or `part.key` as an override of the vehicle has
    /// them; dampers that another takes the place of (`vertical`); or `worn_damper`.
    pub parameter: String,
    /// Its values, in the order of the cases.
    pub values: Vec<Value>,
    /// Overrides `table.key=value` of the worn damper.
    pub set: Vec<String>,
    /// What it is called on a figure.
    pub label: String,
    /// The number on a figure over that in the file.
    pub factor: f64,
}

/// The parameter whose values are dampers, of which one after the other is changed; [`NONE`] stands for none.
pub const WORN_DAMPER: &str = "worn_damper";
/// No damper.
pub const NONE: &str = "none";

/// Most values of an axis.
pub(super) const MOST_VALUES: usize = 10_000;

impl Axis {
    /// Changes a case to a value.
    ///
    /// # Errors
    /// A number where a name must be or the other way round, or a parameter that there is not; in words.
    pub fn apply(&self, case: &mut CaseOptions, value: &Value) -> Result<(), String> {
        let parameter = self.parameter.as_str();
        let is_number = CaseOptions::NUMBERS.contains(&parameter);
        match (parameter, value) {
            (_, Value::Number(number)) if is_number => case.set_number(parameter, *number),
            ("vehicle", Value::Word(name)) => case.set_vehicle(name),
            ("track", Value::Word(name)) => case.set_track(name),
            (WORN_DAMPER, Value::Word(damper)) => {
                let of_damper = |change: &String| format!("{damper}.{change}");
                if damper != NONE {
                    case.overrides.extend(self.set.iter().map(of_damper));
                }
            }
            (path, value) if path.contains('.') => {
                let value = match value {
                    Value::Number(number) => toml::Value::Float(*number),
                    Value::Word(word) => toml::Value::String(word.clone()),
                };
                case.overrides.push(format!("{path}={value}"));
            }
            (dampers, Value::Word(by)) if !is_number => case
                .dampers
                .push(Replacement::named(dampers.to_owned(), by.clone())),
            (_, Value::Word(word)) => return Err(format!("\"{word}\", allowed: a number")),
            ("vehicle" | "track" | WORN_DAMPER, Value::Number(number)) => {
                return Err(format!("{number}, allowed: a name in quotes"));
            }
            (unknown, _) => {
                let words = ["vehicle", "track", WORN_DAMPER];
                let known = CaseOptions::NUMBERS.into_iter().chain(words);
                return Err(format!(
                    "no such parameter with numbers, allowed: {}, or a path such as vertical.mount.clearance_m{}",
                    CaseOptions::NUMBERS.join(", "),
                    nearest(unknown, known)
                ));
            }
        }
        Ok(())
    }
}

/// `count` numbers from one to another, with equal differences, or equal ratios where `geometric`.
pub(super) fn range(from: f64, to: f64, count: usize, geometric: bool) -> Vec<Value> {
    let share = |i: usize| i as f64 / (count.max(2) - 1) as f64;
    let at = |i: usize| match i {
        0 => from,
        _ if i + 1 == count => to,
        _ if geometric => from * (share(i) * (to / from).ln()).exp(),
        _ => from + share(i) * (to - from),
    };
    (0..count).map(|i| Value::Number(rounded(at(i)))).collect()
}

/// To twelve digits, so that 0.1 + 0.2 is 0.3.
fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}
