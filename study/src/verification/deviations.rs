//! Deviations between two runs of a case.

use dashpot_reference::deviation::{errors, root_mean_square};
use serde::Serialize;

use dashpot_files::case::Case;
use dashpot_vehicle_run::Run;
use dashpot_vehicle_run::VehicleTick;
use dashpot_vehicle_run::signals::{SIDES, load_n};
use dashpot_vehicle_run::{Indexer, Indices, Sample};

/// Maximum deviations allowed for a step of 1 ms; see the fields of [`Deviations`].
pub const BOUNDS: Deviations<f64> = Deviations {
    acceleration: 0.01,
    lateral_m: 5e-6,
    load_n: 0.7e3,
    index: 0.005,
};

/// Largest deviations of one run from another, one field per quantity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Deviations<T> {
    /// Root mean square error of a body's acceleration, divided by the standard deviation of the acceleration (NRMSE).
    pub acceleration: T,
    /// Root mean square error of a wheelset's lateral displacement, m.
    pub lateral_m: T,
    /// Root mean square error of a wheel load, N.
    pub load_n: T,
    /// Relative error of an index.
    pub index: T,
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

/// Value of an index with its description.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NamedIndex {
    pub value: f64,
    pub name: String,
}

/// Compared signals of a run, at the ticks of the coarser run.
pub struct Trace {
    pub(super) names: Vec<String>,
    pub(super) wheelsets: usize,
    pub(super) times_s: Vec<f64>,
    /// Lateral and vertical acceleration of each body other than wheelsets, m/s^2.
    pub(super) accelerations: Vec<Accelerations>,
    /// Track acceleration under each body, tick by tick.
    pub(super) track_accelerations: Vec<Vec<[f64; 5]>>,
    pub(super) lateral: Vec<Vec<f64>>,
    pub(super) loads: Vec<[Vec<f64>; 2]>,
    pub(super) indexer: Indexer,
    pub(super) inner_step_s: f64,
}

/// Accelerations of a body, tick by tick, m/s^2.
#[derive(Clone, Default)]
pub(super) struct Accelerations {
    lateral: Vec<f64>,
    vertical: Vec<f64>,
}

impl Trace {
    /// Starts the trace of a run that has not been stepped yet.
    pub(super) fn for_run(run: &Run, case: &Case) -> Self {
        Self {
            inner_step_s: run.vehicle().inner_step_s(),
            ..Self::new(case)
        }
    }

    /// Adds a tick.
    pub(super) fn add_state(&mut self, state: &impl VehicleTick) {
        let sample = Sample {
            acceleration: |body| state.acceleration(body),
            unbalanced_m_per_s2: state.unbalanced_m_per_s2(),
            contacts: state.contacts(),
            damper_forces_n: state.damper_forces_n(),
        };
        self.add(&sample, state.coordinates());
    }

    pub(super) fn new(case: &Case) -> Self {
        let (bodies, wheelsets) = (&case.vehicle.bodies, &case.vehicle.wheelsets);
        let names = bodies.iter().map(|body| &body.name);
        let names = names.chain(wheelsets.iter().map(|wheelset| &wheelset.name));
        Self {
            names: names.cloned().collect(),
            wheelsets: wheelsets.len(),
            times_s: Vec::new(),
            accelerations: vec![Accelerations::default(); bodies.len()],
            track_accelerations: Vec::new(),
            lateral: vec![Vec::new(); wheelsets.len()],
            loads: vec![Default::default(); wheelsets.len()],
            indexer: Indexer::new(case),
            inner_step_s: case.step_s,
        }
    }

    pub(super) fn add<A: Fn(usize) -> [f64; 5]>(
        &mut self,
        sample: &Sample<A>,
        coordinates: &[[f64; 5]],
    ) {
        let bodies = self.accelerations.len();
        for (body, series) in self.accelerations.iter_mut().enumerate() {
            let acceleration = (sample.acceleration)(body);
            series.lateral.push(acceleration[0]);
            series.vertical.push(acceleration[1]);
        }
        for (series, coordinates) in self.lateral.iter_mut().zip(&coordinates[bodies..]) {
            series.push(coordinates[0]);
        }
        for (series, contact) in self.loads.iter_mut().zip(sample.contacts) {
            for (side, series) in series.iter_mut().enumerate() {
                series.push(load_n(contact, side));
            }
        }
        self.indexer.add_sample(sample);
    }

    /// Length of the integration steps within a tick, s.
    pub fn inner_step_s(&self) -> f64 {
        self.inner_step_s
    }

    /// Computes the largest deviations of this run from `reference` within the duration of the shorter run.
    pub fn deviations(&self, reference: &Self) -> Deviations<Worst> {
        let mut found = Deviations {
            acceleration: Vec::new(),
            lateral_m: Vec::new(),
            load_n: Vec::new(),
            index: Vec::new(),
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
        if let (Some(indices), Some(expected)) =
            (self.indexer.indices(), reference.indexer.indices())
        {
            let pairs = compared_indices(&indices)
                .into_iter()
                .zip(compared_indices(&expected));
            found.index.extend(pairs.map(|(index, expected)| Worst {
                deviation: (index.value / expected.value - 1.0).abs(),
                quantity: index.name,
            }));
        }
        Deviations {
            acceleration: worst(found.acceleration),
            lateral_m: worst(found.lateral_m),
            load_n: worst(found.load_n),
            index: worst(found.index),
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
    rms_error(series, expected) / root_mean_square(expected.iter().map(|value| value - mean))
}

/// Returns the compared indices: accelerations and ride of the bodies, forces of the wheelsets, and `Y/Q` of the wheels
/// as root mean square. Indices that can be almost zero are left out, because their relative error is meaningless.
fn compared_indices(indices: &Indices) -> Vec<NamedIndex> {
    let mut compared = Vec::new();
    let mut add = |value: f64, name: String| compared.push(NamedIndex { value, name });
    for body in &indices.bodies {
        let name = &body.body;
        add(body.lateral_rms_m_per_s2, format!("{name}, lateral rms"));
        add(body.vertical_rms_m_per_s2, format!("{name}, vertical rms"));
    }
    for ride in &indices.ride {
        let point = &ride.point;
        if let Some(index) = ride.sperling_lateral {
            add(index, format!("{point}, W lateral"));
        }
        if let Some(index) = ride.sperling_vertical {
            add(index, format!("{point}, W vertical"));
        }
        if let Some(index) = ride.mean_comfort {
            add(index, format!("{point}, N_MV"));
        }
    }
    for wheelset in &indices.wheelsets {
        let name = &wheelset.wheelset;
        add(
            wheelset.lateral_force_rms_n,
            format!("{name}, lateral force rms"),
        );
        add(
            wheelset.lateral_force_greatest_n,
            format!("{name}, greatest lateral force"),
        );
        add(wheelset.wear_number_n, format!("{name}, wear number"));
        add(
            wheelset.wear_number_rms_n,
            format!("{name}, wear number rms"),
        );
        for wheel in &wheelset.wheels {
            add(
                wheel.derailment_rms,
                format!("{name}, {}, Y/Q rms", wheel.side),
            );
        }
    }
    compared
}

/// Returns the compared indices of a run, in a fixed order.
pub(super) fn indices(trace: &Trace) -> Vec<NamedIndex> {
    trace
        .indexer
        .indices()
        .as_ref()
        .map(compared_indices)
        .unwrap_or_default()
}
