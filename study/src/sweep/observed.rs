//! Indices that a study can observe.

use std::collections::BTreeMap;

use super::observation::Observation;
use dashpot_vehicle_run::{RideIndices, WheelIndices, WheelsetIndices};

/// Indices of a case by name; an index is `None` if the run did not complete or was too short.
pub type IndexValues = BTreeMap<String, Option<f64>>;

/// Index in a row of a study.
#[derive(Debug, Clone, Copy)]
pub struct Observed {
    /// Name, which ends in the unit if it has one.
    pub name: &'static str,
    /// Description for figures and documents.
    pub meaning: &'static str,
    /// Extracts the value from a run; `None` if the run does not have it.
    pub extract: fn(&Observation) -> Option<f64>,
}

impl PartialEq for Observed {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Observed {
    /// Returns the index with a name.
    pub fn by_name(name: &str) -> Option<&'static Self> {
        OBSERVED.iter().find(|index| index.name == name)
    }

    /// True if the run must add up the wear of its wheels for this index.
    pub fn needs_wear(&self) -> bool {
        self.name == "max_wear_depth_um_per_1000km"
    }

    /// True if this is a ride index, which needs at least one whole window.
    pub fn is_ride_index(&self) -> bool {
        matches!(
            self.name,
            "sperling_vertical"
                | "sperling_lateral"
                | "sperling_vertical_first"
                | "sperling_lateral_first"
                | "mean_comfort"
        )
    }
}

fn max(values: impl Iterator<Item = f64>) -> Option<f64> {
    values.reduce(f64::max)
}

fn points(observation: &Observation) -> impl Iterator<Item = &RideIndices> {
    observation.indices.ride.iter()
}

fn wheelsets(observation: &Observation) -> impl Iterator<Item = &WheelsetIndices> {
    observation.indices.wheelsets.iter()
}

fn leading(observation: &Observation) -> Option<&WheelsetIndices> {
    wheelsets(observation).next()
}

fn wheels(observation: &Observation) -> impl Iterator<Item = &WheelIndices> {
    wheelsets(observation).flat_map(|wheelset| &wheelset.wheels)
}

/// All indices that a study can observe.
pub const OBSERVED: [Observed; 26] = [
    Observed {
        name: "sperling_vertical",
        meaning: "vertical Sperling ride index, maximum of all ride points",
        extract: |run| max(points(run).filter_map(|point| point.sperling_vertical)),
    },
    Observed {
        name: "sperling_lateral",
        meaning: "lateral Sperling ride index, maximum of all ride points",
        extract: |run| max(points(run).filter_map(|point| point.sperling_lateral)),
    },
    Observed {
        name: "sperling_vertical_first",
        meaning: "vertical Sperling ride index at the first ride point",
        extract: |run| points(run).next()?.sperling_vertical,
    },
    Observed {
        name: "sperling_lateral_first",
        meaning: "lateral Sperling ride index at the first ride point",
        extract: |run| points(run).next()?.sperling_lateral,
    },
    Observed {
        name: "mean_comfort",
        meaning: "mean comfort (EN 12299), maximum of all ride points",
        extract: |run| max(points(run).filter_map(|point| point.mean_comfort)),
    },
    Observed {
        name: "body_vertical_rms_m_per_s2",
        meaning: "vertical acceleration of the first body, rms, m/s²",
        extract: |run| Some(run.indices.bodies.first()?.vertical_rms_m_per_s2),
    },
    Observed {
        name: "body_vertical_greatest_m_per_s2",
        meaning: "vertical acceleration of the first body, maximum, m/s²",
        extract: |run| Some(run.indices.bodies.first()?.vertical_greatest_m_per_s2),
    },
    Observed {
        name: "body_lateral_rms_m_per_s2",
        meaning: "lateral acceleration of the first body, rms, m/s²",
        extract: |run| Some(run.indices.bodies.first()?.lateral_rms_m_per_s2),
    },
    Observed {
        name: "body_lateral_greatest_m_per_s2",
        meaning: "lateral acceleration of the first body, maximum, m/s²",
        extract: |run| Some(run.indices.bodies.first()?.lateral_greatest_m_per_s2),
    },
    Observed {
        name: "unbalanced_rms_m_per_s2",
        meaning: "unbalanced lateral acceleration, rms, m/s²",
        extract: |run| Some(run.indices.unbalanced.rms_m_per_s2),
    },
    Observed {
        name: "derailment_rms",
        meaning: "Y/Q of the leading wheelset, rms, larger of its two wheels",
        extract: |run| {
            max(leading(run)?
                .wheels
                .iter()
                .map(|wheel| wheel.derailment_rms))
        },
    },
    Observed {
        name: "derailment_greatest",
        meaning: "Y/Q, mean over 2 m, maximum of all wheels",
        extract: |run| max(wheels(run).map(|wheel| wheel.derailment_greatest)),
    },
    Observed {
        name: "derailment_over_nadal",
        meaning: "Y/Q divided by Nadal's limit, mean over 2 m, maximum of all wheels",
        extract: |run| max(wheels(run).map(|wheel| wheel.derailment_over_nadal)),
    },
    Observed {
        name: "wear_number_n",
        meaning: "wear number of the leading wheelset, mean, N",
        extract: |run| Some(leading(run)?.wear_number_n),
    },
    Observed {
        name: "wear_number_rms_n",
        meaning: "wear number of the leading wheelset, rms, N",
        extract: |run| Some(leading(run)?.wear_number_rms_n),
    },
    Observed {
        name: "max_wear_depth_um_per_1000km",
        meaning: "wear depth by Archard's law, an estimate, maximum of all wheels, µm per 1000 km",
        extract: |run| run.max_wear_depth_um_per_1000km,
    },
    Observed {
        name: "lateral_force_rms_n",
        meaning: "lateral force of the leading wheelset, rms, N",
        extract: |run| Some(leading(run)?.lateral_force_rms_n),
    },
    Observed {
        name: "lateral_force_greatest_n",
        meaning: "lateral force, mean over 2 m, maximum of all wheelsets, N",
        extract: |run| max(wheelsets(run).map(|wheelset| wheelset.lateral_force_greatest_n)),
    },
    Observed {
        name: "lateral_force_over_limit",
        meaning: "lateral force divided by Prud'homme's limit, mean over 2 m, maximum of all wheelsets",
        extract: |run| max(wheelsets(run).filter_map(|wheelset| wheelset.lateral_force_over_limit)),
    },
    Observed {
        name: "unloading_greatest",
        meaning: "wheel unloading, mean over 2 m, maximum of all wheels",
        extract: |run| max(wheels(run).filter_map(|wheel| wheel.unloading_of_mean_greatest)),
    },
    Observed {
        name: "wheel_load_greatest_n",
        meaning: "wheel load, maximum of all wheels, N",
        extract: |run| max(wheels(run).map(|wheel| wheel.load_greatest_n)),
    },
    Observed {
        name: "wheel_load_over_limit",
        meaning: "wheel load, filtered at 20 Hz, divided by its limit, maximum of all wheels",
        extract: |run| max(wheels(run).filter_map(|wheel| wheel.load_over_limit)),
    },
    Observed {
        name: "wheel_load_over_static",
        meaning: "wheel load divided by that at standstill, maximum of all wheels; values over 10 are outside the \
                  validity of the model",
        extract: |run| run.wheel_load_over_static,
    },
    Observed {
        name: "wheel_lift_longest_s",
        meaning: "longest duration of wheel lift, s; over 0.05 the vehicle is near derailment",
        extract: |run| Some(run.wheel_lift_longest_s),
    },
    Observed {
        name: "damper_force_greatest_n",
        meaning: "damper force, maximum of all dampers, N",
        extract: |run| max(run.indices.greatest_damper_forces_n.iter().copied()),
    },
    Observed {
        name: "last_lateral_m",
        meaning: "maximum lateral displacement of a wheelset in the last 3 s, m",
        extract: |run| Some(run.last_lateral_m),
    },
];
