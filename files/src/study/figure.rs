//! Figures of a study's page.

use serde::Deserialize;

use super::axis::Value;

/// Maximum amplitude of a damper's displacement, m.
const MAX_AMPLITUDE_M: f64 = 1.0;

/// Figure of a study's page.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Heading.
    pub title: String,
    /// Caption below the figure.
    pub caption: String,
    /// Content.
    pub content: FigureContent,
}

/// Content of a figure.
#[derive(Debug, Clone, PartialEq)]
pub enum FigureContent {
    /// Observed indices against the first axis, one panel per sweep: the mean over the seeds and its confidence
    /// interval.
    Indices {
        /// Names of the sweeps.
        sweeps: Vec<String>,
        /// Observed indices.
        observed: Vec<String>,
        /// Factor by which each index is multiplied, so that all share one axis that starts at zero; empty for unscaled
        /// indices.
        factors: Vec<f64>,
        /// True if changes from the first value are drawn, in percent: those on the same irregularity, so that the
        /// confidence interval is that of the change.
        changes: bool,
    },
    /// Damper forces over time, displacement and velocity, for the first case of a sweep with its first seed.
    Dampers {
        /// Name of the sweep.
        sweep: String,
        /// Names of the dampers.
        dampers: Vec<String>,
    },
    /// Signal over time for the first seed, and its spectrum over all seeds.
    Signal {
        /// Name of the sweep.
        sweep: String,
        /// Values of the sweep's first axis that are drawn.
        values: Vec<Value>,
        /// Name of the signal, as in a history file.
        signal: String,
    },
    /// Frequency response of a damper.
    Response {
        /// Name of the sweep.
        sweep: String,
        /// Values of the sweep's first axis that are drawn.
        values: Vec<Value>,
        /// Name of the damper.
        damper: String,
        /// Amplitude of the damper's displacement, m.
        amplitude_m: f64,
    },
}

impl FigureContent {
    /// Returns the values that the figure shows, each with its sweep.
    pub(super) fn values(&self) -> impl Iterator<Item = (&str, &Value)> {
        let (sweep, values) = match self {
            Self::Signal { sweep, values, .. } | Self::Response { sweep, values, .. } => {
                (sweep.as_str(), &values[..])
            }
            Self::Indices { .. } | Self::Dampers { .. } => ("", &[][..]),
        };
        values.iter().map(move |value| (sweep, value))
    }

    /// Returns the names of the sweeps that the figure shows.
    pub fn sweeps(&self) -> &[String] {
        match self {
            Self::Indices { sweeps, .. } => sweeps,
            Self::Dampers { sweep, .. }
            | Self::Signal { sweep, .. }
            | Self::Response { sweep, .. } => std::slice::from_ref(sweep),
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FigureTable {
    title: String,
    #[serde(default)]
    caption: String,
    indices: Option<IndicesTable>,
    dampers: Option<DampersTable>,
    signal: Option<SignalTable>,
    response: Option<ResponseTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct IndicesTable {
    sweeps: Vec<String>,
    observed: Vec<String>,
    #[serde(default)]
    factors: Vec<f64>,
    #[serde(default)]
    changes: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DampersTable {
    sweep: String,
    dampers: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SignalTable {
    sweep: String,
    values: Vec<toml::Value>,
    signal: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ResponseTable {
    sweep: String,
    values: Vec<toml::Value>,
    damper: String,
    amplitude_m: f64,
}

impl FigureTable {
    /// Converts the table to a figure.
    ///
    /// # Errors
    /// Returns an error message that describes the problem.
    pub fn figure(self) -> Result<Figure, String> {
        let read = |values: Vec<toml::Value>| -> Result<Vec<Value>, String> {
            if values.is_empty() {
                return Err("no values, allowed: one or more".into());
            }
            values.into_iter().map(Value::from_toml).collect()
        };
        let content = match (self.indices, self.dampers, self.signal, self.response) {
            (Some(table), None, None, None) => {
                let [factors, observed] = [table.factors.len(), table.observed.len()];
                if !table.factors.iter().all(|factor| factor.is_finite()) {
                    return Err("a factor is not finite".into());
                }
                if factors > 0 && factors != observed {
                    return Err(format!(
                        "{factors} factors for {observed} observed indices, allowed: none or one each"
                    ));
                }
                if factors > 0 && table.changes {
                    return Err("factors and changes, allowed: one of the two".into());
                }
                FigureContent::Indices {
                    changes: table.changes,
                    sweeps: table.sweeps,
                    observed: table.observed,
                    factors: table.factors,
                }
            }
            (None, Some(table), None, None) if table.dampers.is_empty() => {
                return Err("no dampers, allowed: one or more".into());
            }
            (None, Some(table), None, None) => FigureContent::Dampers {
                sweep: table.sweep,
                dampers: table.dampers,
            },
            (None, None, Some(table), None) => FigureContent::Signal {
                sweep: table.sweep,
                values: read(table.values)?,
                signal: table.signal,
            },
            (None, None, None, Some(table))
                if !(table.amplitude_m > 0.0 && table.amplitude_m <= MAX_AMPLITUDE_M) =>
            {
                return Err(format!(
                    "amplitude_m {}, allowed: above 0 and at most {MAX_AMPLITUDE_M}",
                    table.amplitude_m
                ));
            }
            (None, None, None, Some(table)) => FigureContent::Response {
                sweep: table.sweep,
                values: read(table.values)?,
                damper: table.damper,
                amplitude_m: table.amplitude_m,
            },
            _ => {
                return Err("allowed: one of `indices`, `dampers`, `signal`, `response`".into());
            }
        };
        Ok(Figure {
            title: self.title,
            caption: self.caption,
            content,
        })
    }
}
