//! Figures of a study's page.

use serde::Deserialize;

use super::axis::Value;

/// Greatest amplitude of a damper's displacement, m.
const MOST_AMPLITUDE_M: f64 = 1.0;

/// A figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Heading.
    pub title: String,
    /// What is told under it.
    pub caption: String,
    /// What is drawn.
    pub shown: Shown,
}

/// What a figure draws.
#[derive(Debug, Clone, PartialEq)]
pub enum Shown {
    /// Observed indices over the first axis of each sweep, a panel each: mean over seeds with its confidence.
    Indices {
        /// Sweeps.
        sweeps: Vec<String>,
        /// Observed indices.
        observed: Vec<String>,
        /// What each is multiplied by, to stand on one axis from zero on; none where each is shown as it is.
        factors: Vec<f64>,
    },
    /// Force of dampers over time, displacement and velocity, at the first seed of a sweep's first case.
    Dampers {
        /// The sweep.
        sweep: String,
        /// Dampers by name.
        dampers: Vec<String>,
    },
    /// A signal over time at the first seed, and its spectrum over all seeds.
    Signal {
        /// The sweep.
        sweep: String,
        /// Values of its first axis.
        values: Vec<Value>,
        /// The signal, called as in a history.
        signal: String,
    },
    /// Amplitude-frequency characteristic of a damper.
    Response {
        /// The sweep.
        sweep: String,
        /// Values of its first axis.
        values: Vec<Value>,
        /// The damper.
        damper: String,
        /// Amplitude of its displacement, m.
        amplitude_m: f64,
    },
}

impl Shown {
    /// Values that are drawn, each with its sweep.
    pub(super) fn values(&self) -> impl Iterator<Item = (&str, &Value)> {
        let (sweep, values) = match self {
            Self::Signal { sweep, values, .. } | Self::Response { sweep, values, .. } => {
                (sweep.as_str(), &values[..])
            }
            Self::Indices { .. } | Self::Dampers { .. } => ("", &[][..]),
        };
        values.iter().map(move |value| (sweep, value))
    }

    /// The sweeps that are drawn.
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
    /// The figure.
    ///
    /// # Errors
    /// Not one thing to draw; in words.
    pub fn figure(self) -> Result<Figure, String> {
        let read = |values: Vec<toml::Value>| -> Result<Vec<Value>, String> {
            if values.is_empty() {
                return Err("no values, allowed: one or more".into());
            }
            values.into_iter().map(Value::of).collect()
        };
        let shown = match (self.indices, self.dampers, self.signal, self.response) {
            (Some(table), None, None, None) => {
                let [factors, observed] = [table.factors.len(), table.observed.len()];
                if !table.factors.iter().all(|factor| factor.is_finite()) {
                    return Err("a factor that is no finite number".into());
                }
                if factors > 0 && factors != observed {
                    return Err(format!(
                        "{factors} factors of {observed} observed, allowed: none or one each"
                    ));
                }
                Shown::Indices {
                    sweeps: table.sweeps,
                    observed: table.observed,
                    factors: table.factors,
                }
            }
            (None, Some(table), None, None) if table.dampers.is_empty() => {
                return Err("no dampers, allowed: one or more".into());
            }
            (None, Some(table), None, None) => Shown::Dampers {
                sweep: table.sweep,
                dampers: table.dampers,
            },
            (None, None, Some(table), None) => Shown::Signal {
                sweep: table.sweep,
                values: read(table.values)?,
                signal: table.signal,
            },
            (None, None, None, Some(table))
                if !(table.amplitude_m > 0.0 && table.amplitude_m <= MOST_AMPLITUDE_M) =>
            {
                return Err(format!(
                    "amplitude_m {}, allowed: above 0 and at most {MOST_AMPLITUDE_M}",
                    table.amplitude_m
                ));
            }
            (None, None, None, Some(table)) => Shown::Response {
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
            shown,
        })
    }
}
