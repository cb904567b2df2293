//! Indices that a study can observe, by name.

use super::observation::Observation;
use dashpot_vehicle_run::{RideIndices, WheelIndices, WheelsetIndices};

/// An index of a row.
#[derive(Debug, Clone, Copy)]
pub struct Observed {
    /// Name, with the unit where it has one.
    pub name: &'static str,
    /// What it is, for a figure.
    pub meaning: &'static str,
    /// What it is of a run.
    pub of: fn(&Observation) -> Option<f64>,
}

impl PartialEq for Observed {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Observed {
    /// The index of a name.
    pub fn called(name: &str) -> Option<&'static Self> {
        OBSERVED.iter().find(|index| index.name == name)
    }

    /// Whether it is an index of ride, which only whole windows of a run have.
    pub fn is_of_ride(&self) -> bool {
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

fn greatest(values: impl Iterator<Item = f64>) -> Option<f64> {
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

/// All of them.
pub const OBSERVED: [Observed; 24] = [
    Observed {
        name: "sperling_vertical",
        meaning: "Sperling's ride index up and down, greatest of the ride points",
        of: |run| greatest(points(run).filter_map(|point| point.sperling_vertical)),
    },
    Observed {
        name: "sperling_lateral",
        meaning: "Sperling's ride index to the side, greatest of the ride points",
        of: |run| greatest(points(run).filter_map(|point| point.sperling_lateral)),
    },
    Observed {
        name: "sperling_vertical_first",
        meaning: "Sperling's ride index up and down, first ride point",
        of: |run| points(run).next()?.sperling_vertical,
    },
    Observed {
        name: "sperling_lateral_first",
        meaning: "Sperling's ride index to the side, first ride point",
        of: |run| points(run).next()?.sperling_lateral,
    },
    Observed {
        name: "mean_comfort",
        meaning: "mean comfort (EN 12299), greatest of the ride points",
        of: |run| greatest(points(run).filter_map(|point| point.mean_comfort)),
    },
    Observed {
        name: "body_vertical_rms_m_per_s2",
        meaning: "vertical acceleration of the first body, rms, m/s²",
        of: |run| Some(run.indices.bodies.first()?.vertical_rms_m_per_s2),
    },
    Observed {
        name: "body_vertical_greatest_m_per_s2",
        meaning: "vertical acceleration of the first body, greatest, m/s²",
        of: |run| Some(run.indices.bodies.first()?.vertical_greatest_m_per_s2),
    },
    Observed {
        name: "body_lateral_rms_m_per_s2",
        meaning: "lateral acceleration of the first body, rms, m/s²",
        of: |run| Some(run.indices.bodies.first()?.lateral_rms_m_per_s2),
    },
    Observed {
        name: "body_lateral_greatest_m_per_s2",
        meaning: "lateral acceleration of the first body, greatest, m/s²",
        of: |run| Some(run.indices.bodies.first()?.lateral_greatest_m_per_s2),
    },
    Observed {
        name: "unbalanced_rms_m_per_s2",
        meaning: "unbalanced lateral acceleration, rms, m/s²",
        of: |run| Some(run.indices.unbalanced.rms_m_per_s2),
    },
    Observed {
        name: "derailment_rms",
        meaning: "Y/Q of the leading wheelset, rms, greater of its wheels",
        of: |run| {
            greatest(
                leading(run)?
                    .wheels
                    .iter()
                    .map(|wheel| wheel.derailment_rms),
            )
        },
    },
    Observed {
        name: "derailment_greatest",
        meaning: "Y/Q, greatest mean over 2 m of all wheels",
        of: |run| greatest(wheels(run).map(|wheel| wheel.derailment_greatest)),
    },
    Observed {
        name: "derailment_over_nadal",
        meaning: "Y/Q over Nadal's limit, greatest mean over 2 m of all wheels",
        of: |run| greatest(wheels(run).map(|wheel| wheel.derailment_over_nadal)),
    },
    Observed {
        name: "wear_number_n",
        meaning: "wear number of the leading wheelset, mean, N",
        of: |run| Some(leading(run)?.wear_number_n),
    },
    Observed {
        name: "wear_number_rms_n",
        meaning: "wear number of the leading wheelset, rms, N",
        of: |run| Some(leading(run)?.wear_number_rms_n),
    },
    Observed {
        name: "lateral_force_rms_n",
        meaning: "lateral force of the leading wheelset, rms, N",
        of: |run| Some(leading(run)?.lateral_force_rms_n),
    },
    Observed {
        name: "lateral_force_greatest_n",
        meaning: "lateral force, greatest mean over 2 m of all wheelsets, N",
        of: |run| greatest(wheelsets(run).map(|wheelset| wheelset.lateral_force_greatest_n)),
    },
    Observed {
        name: "lateral_force_over_limit",
        meaning: "lateral force over Prud'homme's limit, greatest mean over 2 m of all wheelsets",
        of: |run| greatest(wheelsets(run).filter_map(|wheelset| wheelset.lateral_force_over_limit)),
    },
    Observed {
        name: "unloading_greatest",
        meaning: "wheel unloading, greatest mean over 2 m of all wheels",
        of: |run| greatest(wheels(run).filter_map(|wheel| wheel.unloading_of_mean_greatest)),
    },
    Observed {
        name: "wheel_load_greatest_n",
        meaning: "wheel load, greatest of all wheels, N",
        of: |run| greatest(wheels(run).map(|wheel| wheel.load_greatest_n)),
    },
    Observed {
        name: "wheel_load_over_static",
        meaning: "wheel load over that at standstill, greatest of all wheels; over 10 is beyond what the model means",
        of: |run| run.wheel_load_over_static,
    },
    Observed {
        name: "wheel_lift_longest_s",
        meaning: "longest time for which a wheel carries no load, s; over 0.05 the vehicle is near derailment",
        of: |run| Some(run.wheel_lift_longest_s),
    },
    Observed {
        name: "damper_force_greatest_n",
        meaning: "force of a damper, greatest of all, N",
        of: |run| greatest(run.indices.greatest_damper_forces_n.iter().copied()),
    },
    Observed {
        name: "last_lateral_m",
        meaning: "greatest lateral displacement of a wheelset in the last 3 s, m",
        of: |run| Some(run.last_lateral_m),
    },
];
