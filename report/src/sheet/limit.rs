//! A limit, the value that it allows or not, and how both are written.

use dashpot_files::sheet::{Index, Limit};
use dashpot_files::study::format_number;
use serde::Serialize;

use crate::verdict::Verdict;

/// Verdict on a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Judged {
    /// The value and its whole interval are within the limit.
    Within,
    /// The limit is within the interval of the value.
    Undecided,
    /// The value and its whole interval are outside.
    Outside,
}

/// A limit and its verdict.
#[derive(Clone, Debug, Serialize)]
pub struct Limited {
    /// The index.
    pub index: Index,
    /// Its value, in the unit of its key; `None` if undefined.
    pub value: Option<f64>,
    /// Half of the 95 % interval of a measured value.
    pub half_width: Option<f64>,
    /// Minimum.
    pub least: Option<f64>,
    /// Maximum.
    pub most: Option<f64>,
    /// Nominal value, if the limit is a tolerance.
    pub nominal: Option<f64>,
    /// Source of the limit.
    pub clause: Option<String>,
    /// The verdict.
    pub verdict: Judged,
    /// True if the verdict is `within`.
    pub kept: bool,
}

impl Limited {
    pub(super) fn new(limit: &Limit, value: Option<f64>, half_width: Option<f64>) -> Self {
        let width = half_width.unwrap_or(0.0);
        let ends = [-width, width].map(|side| limit.is_kept(value.map(|value| value + side)));
        let verdict = match (limit.is_kept(value), ends) {
            (true, [true, true]) => Judged::Within,
            (false, [false, false]) => Judged::Outside,
            _ => Judged::Undecided,
        };
        Self {
            index: limit.index,
            value,
            half_width,
            least: limit.min,
            most: limit.max,
            nominal: limit.nominal,
            clause: limit.clause.clone(),
            kept: verdict == Judged::Within,
            verdict,
        }
    }

    fn displayed(&self, value: f64) -> String {
        format_number(value / self.index.display_unit().size)
    }

    /// Formats the allowed range in the unit of the index.
    pub(super) fn allowed(&self) -> String {
        let end = |end: f64| self.displayed((end * 1e9).round() * 1e-9);
        match (self.least, self.most) {
            (Some(least), Some(most)) => format!("{} to {}", end(least), end(most)),
            (Some(least), None) => format!("at least {}", end(least)),
            (None, Some(most)) => format!("at most {}", end(most)),
            (None, None) => String::new(),
        }
    }

    /// Formats the difference from the nominal value; empty without one.
    pub(super) fn deviation(&self) -> String {
        match (self.value, self.nominal) {
            (Some(value), Some(nominal)) if nominal != 0.0 => {
                format!("{:+.1} %", 100.0 * (value - nominal) / nominal.abs())
            }
            _ => String::new(),
        }
    }

    /// Returns the verdict in a word.
    pub(super) fn word(&self) -> &'static str {
        match self.verdict {
            Judged::Within => "within",
            Judged::Undecided => "undecided",
            Judged::Outside => "outside",
        }
    }

    /// Returns the verdict for its colour.
    pub(super) fn colour(&self) -> Verdict {
        match self.verdict {
            Judged::Within => Verdict::Passed,
            Judged::Undecided => Verdict::Warning,
            Judged::Outside => Verdict::Failed,
        }
    }

    /// Formats the value, rounded to enough digits to differ from a violated limit.
    pub(super) fn formatted(&self) -> String {
        let text = value_of(self.index, self.value);
        let Some(value) = self.value else {
            return text;
        };
        let read: f64 = text.parse().unwrap_or(value);
        let rounded = Some(read * self.index.display_unit().size);
        let within = |value: Option<f64>| {
            self.least.is_none_or(|least| value >= Some(least))
                && self.most.is_none_or(|most| value <= Some(most))
        };
        if within(rounded) == within(self.value) {
            return text;
        }
        self.displayed(value)
    }
}

/// Formats a value with four digits in the display unit of its index.
pub(super) fn value_of(index: Index, value: Option<f64>) -> String {
    value.map_or("none".into(), |value| {
        let value = value / index.display_unit().size;
        let magnitude = value.abs().max(1e-9).log10().floor();
        let digits = (3.0 - magnitude).clamp(0.0, 4.0) as usize;
        format!("{value:.digits$}")
    })
}

/// Formats half of an interval with two digits in the display unit of its index.
pub(super) fn half_width_of(index: Index, half_width: f64) -> String {
    let half_width = half_width / index.display_unit().size;
    let magnitude = half_width.abs().max(1e-9).log10().floor();
    let digits = (1.0 - magnitude).clamp(0.0, 4.0) as usize;
    format!("{half_width:.digits$}")
}
