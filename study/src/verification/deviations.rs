//! How far two runs of a case are apart.

use dashpot_reference::deviation::{errors, root_mean_square};
use serde::Serialize;

use dashpot_files::case::Case;
use dashpot_vehicle_run::Run;
use dashpot_vehicle_run::VehicleTick;
use dashpot_vehicle_run::signals::{SIDES, load_n};
use dashpot_vehicle_run::{Indexer, Indices, Sample};

/// Greatest deviations of a step of 1 ms: acceleration of bodies over its root mean square, m of a wheelset to the side, N of a wheel's
/// load, and of an index over itself.
pub const BOUNDS: Deviations<f64> = Deviations {
    acceleration: 0.01,
    lateral_m: 5e-6,
    load_n: 0.7e3,
    index: 0.005,
};

/// The worst deviations of a run from another.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Deviations<T> {
    /// Root mean square of the difference of a body's acceleration over that of the acceleration about its mean (NRMSE).
    pub acceleration: T,
    /// Root mean square of the difference of a wheelset's lateral displacement, m.
    pub lateral_m: T,
    /// Root mean square of the difference of a wheel's load, N.
    pub load_n: T,
    /// Difference of an index over the index.
    pub index: T,
}

/// A deviation and what has it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Worst {
    /// The number.
    pub deviation: f64,
    /// What has it.
    pub of: String,
}

/// What is compared of a run, tick by tick of the coarser one.
pub struct Trace {
    pub(super) names: Vec<String>,
    pub(super) wheelsets: usize,
    pub(super) times_s: Vec<f64>,
    /// Of each body that is no wheelset, lateral and vertical.
    pub(super) accelerations: Vec<[Vec<f64>; 2]>,
    /// Of each body, in the same ticks.
    pub(super) track_accelerations: Vec<Vec<[f64; 5]>>,
    pub(super) lateral: Vec<Vec<f64>>,
    pub(super) loads: Vec<[Vec<f64>; 2]>,
    pub(super) indexer: Indexer,
    pub(super) inner_step_s: f64,
}

impl Trace {
    /// Of a run that has not begun.
    pub(super) fn of(run: &Run, case: &Case) -> Self {
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
            accelerations: vec![Default::default(); bodies.len()],
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
            for (series, value) in series.iter_mut().zip(acceleration) {
                series.push(value);
            }
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

    /// Length of the steps inside a tick, s.
    pub fn inner_step_s(&self) -> f64 {
        self.inner_step_s
    }

    /// The worst deviations of this run from `reference`, over as long as both last.
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
            for (direction, (series, expected)) in ["lateral", "vertical"]
                .iter()
                .zip(series.iter().zip(expected))
            {
                let deviation = about_mean(series, expected);
                found
                    .acceleration
                    .push((deviation, format!("{}, {direction}", self.names[body])));
            }
        }
        let names = &self.names[self.names.len() - self.wheelsets..];
        for (name, (series, expected)) in names
            .iter()
            .zip(self.lateral.iter().zip(&reference.lateral))
        {
            found
                .lateral_m
                .push((difference(series, expected), name.clone()));
        }
        for (name, (series, expected)) in names.iter().zip(self.loads.iter().zip(&reference.loads))
        {
            for (side, (series, expected)) in SIDES.iter().zip(series.iter().zip(expected)) {
                found
                    .load_n
                    .push((difference(series, expected), format!("{name}, {side}")));
            }
        }
        if let (Some(indices), Some(expected)) =
            (self.indexer.indices(), reference.indexer.indices())
        {
            let pairs = told(&indices).into_iter().zip(told(&expected));
            for ((number, of), (expected, _)) in pairs {
                found.index.push(((number / expected - 1.0).abs(), of));
            }
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
    /// Whether every deviation is within [`BOUNDS`].
    pub fn is_within_bounds(&self) -> bool {
        self.acceleration.deviation <= BOUNDS.acceleration
            && self.lateral_m.deviation <= BOUNDS.lateral_m
            && self.load_n.deviation <= BOUNDS.load_n
            && self.index.deviation <= BOUNDS.index
    }
}

fn worst(all: Vec<(f64, String)>) -> Worst {
    let worst = all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
    let (deviation, of) = worst.unwrap_or((f64::NAN, "nothing".into()));
    Worst { deviation, of }
}

fn difference(series: &[f64], expected: &[f64]) -> f64 {
    let ticks = series.len().min(expected.len());
    root_mean_square(errors(&series[..ticks], &expected[..ticks]))
}

fn about_mean(series: &[f64], expected: &[f64]) -> f64 {
    let mean = expected.iter().sum::<f64>() / expected.len().max(1) as f64;
    difference(series, expected) / root_mean_square(expected.iter().map(|value| value - mean))
}

/// The indices that are compared: those of the car body's and bogies' ride, and of the forces of wheels that are not nearly zero.
fn told(indices: &Indices) -> Vec<(f64, String)> {
    let mut told = Vec::new();
    for body in &indices.bodies {
        let name = &body.body;
        told.push((body.lateral_rms_m_per_s2, format!("{name}, lateral rms")));
        told.push((body.vertical_rms_m_per_s2, format!("{name}, vertical rms")));
    }
    for ride in &indices.ride {
        let point = &ride.point;
        let both = [
            ("lateral", ride.sperling_lateral),
            ("vertical", ride.sperling_vertical),
        ];
        told.extend(
            both.into_iter()
                .filter_map(|(direction, index)| Some((index?, format!("{point}, W {direction}")))),
        );
        told.extend(
            ride.mean_comfort
                .map(|index| (index, format!("{point}, N_MV"))),
        );
    }
    for wheelset in &indices.wheelsets {
        let name = &wheelset.wheelset;
        told.push((
            wheelset.lateral_force_rms_n,
            format!("{name}, lateral force rms"),
        ));
        told.push((
            wheelset.lateral_force_greatest_n,
            format!("{name}, greatest lateral force"),
        ));
        told.push((wheelset.wear_number_n, format!("{name}, wear number")));
        told.push((
            wheelset.wear_number_rms_n,
            format!("{name}, wear number rms"),
        ));
        for wheel in &wheelset.wheels {
            told.push((
                wheel.derailment_rms,
                format!("{name}, {}, Y/Q rms", wheel.side),
            ));
        }
    }
    told
}

/// The indices of a run that are compared, and what each is.
pub(super) fn indices(trace: &Trace) -> Vec<(f64, String)> {
    trace
        .indexer
        .indices()
        .as_ref()
        .map(told)
        .unwrap_or_default()
}
