//! Deviations between two runs of a case.

use dashpot_reference::deviation::{errors, root_mean_square};
use serde::Serialize;

use super::compared::{ACCELERATION, Compared};
use super::trace::Trace;
use dashpot_vehicle_run::signals::SIDES;

/// Maximum deviations allowed for a step of 1 ms; see the fields of [`Deviations`].
pub const BOUNDS: Deviations<f64> = Deviations {
    acceleration: 0.01,
    lateral_m: 5e-6,
    load_n: 0.7e3,
    index: 0.005,
    extreme: 0.03,
};

/// Relative difference of an index between two reference solutions beyond which a case is chaotic.
pub const CHAOS: f64 = 0.01;

/// Largest deviations of one run from another, one field per quantity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Deviations<T> {
    /// Root mean square error of a body's acceleration, divided by the standard deviation of the acceleration (NRMSE).
    pub acceleration: T,
    /// Root mean square error of a wheelset's lateral displacement, m.
    pub lateral_m: T,
    /// Root mean square error of a wheel load, N.
    pub load_n: T,
    /// Relative error of a mean or a root mean square.
    pub index: T,
    /// Relative error of a maximum, a minimum or a duration.
    pub extreme: T,
}

/// Largest deviation, and the quantity with this deviation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Worst {
    /// Deviation.
    pub deviation: f64,
    /// Body, wheelset, wheel or index with this deviation.
    #[serde(rename = "of")]
    pub quantity: String,
}

impl Trace {
    /// Computes the largest deviations of this run from `reference` within the duration of the shorter run.
    pub fn deviations(&self, reference: &Self) -> Deviations<Worst> {
        let mut found = Deviations {
            acceleration: Vec::new(),
            lateral_m: Vec::new(),
            load_n: Vec::new(),
            index: Vec::new(),
            extreme: Vec::new(),
        };
        for (body, (series, expected)) in self
            .accelerations
            .iter()
            .zip(&reference.accelerations)
            .enumerate()
        {
            for (direction, series, expected) in [
                ("lateral", &series.lateral, &expected.lateral),
                ("vertical", &series.vertical, &expected.vertical),
            ] {
                found.acceleration.push(Worst {
                    deviation: normalized_error(series, expected),
                    quantity: format!("{}, {direction}", self.names[body]),
                });
            }
        }
        let names = &self.names[self.names.len() - self.wheelsets..];
        for (name, (series, expected)) in names
            .iter()
            .zip(self.lateral.iter().zip(&reference.lateral))
        {
            found.lateral_m.push(Worst {
                deviation: rms_error(series, expected),
                quantity: name.clone(),
            });
        }
        for (name, (series, expected)) in names.iter().zip(self.loads.iter().zip(&reference.loads))
        {
            for (side, (series, expected)) in SIDES.iter().zip(series.iter().zip(expected)) {
                found.load_n.push(Worst {
                    deviation: rms_error(series, expected),
                    quantity: format!("{name}, {side}"),
                });
            }
        }
        for (index, expected) in self.compared().iter().zip(reference.compared()) {
            let Compared {
                name, is_extreme, ..
            } = index;
            let of_kind = match is_extreme {
                true => &mut found.extreme,
                false => &mut found.index,
            };
            of_kind.push(Worst {
                deviation: index.deviation(&expected),
                quantity: name.clone(),
            });
        }
        Deviations {
            acceleration: worst(found.acceleration),
            lateral_m: worst(found.lateral_m),
            load_n: worst(found.load_n),
            index: worst(found.index),
            extreme: worst(found.extreme),
        }
    }
}

impl Deviations<Worst> {
    /// True if every deviation is within [`BOUNDS`].
    pub fn is_within_bounds(&self) -> bool {
        self.acceleration.deviation <= BOUNDS.acceleration
            && self.lateral_m.deviation <= BOUNDS.lateral_m
            && self.load_n.deviation <= BOUNDS.load_n
            && self.index.deviation <= BOUNDS.index
            && self.extreme.deviation <= BOUNDS.extreme
    }

    /// True if these deviations of one reference solution from another show that the case is chaotic.
    pub fn show_chaos(&self) -> bool {
        self.index.deviation.max(self.extreme.deviation) > CHAOS
    }
}

fn worst(all: Vec<Worst>) -> Worst {
    all.into_iter()
        .max_by(|a, b| a.deviation.total_cmp(&b.deviation))
        .unwrap_or(Worst {
            deviation: f64::NAN,
            quantity: "nothing".into(),
        })
}

fn rms_error(series: &[f64], expected: &[f64]) -> f64 {
    let ticks = series.len().min(expected.len());
    root_mean_square(errors(&series[..ticks], &expected[..ticks]))
}

fn normalized_error(series: &[f64], expected: &[f64]) -> f64 {
    let mean = expected.iter().sum::<f64>() / expected.len().max(1) as f64;
    let deviation = root_mean_square(expected.iter().map(|value| value - mean));
    rms_error(series, expected) / deviation.max(ACCELERATION)
}
