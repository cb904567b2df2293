//! Signals and indices of a run, for comparison with another run of the same case.

use std::sync::Arc;

use dashpot_files::case::Case;
use dashpot_rail::track::Track;
use dashpot_vehicle_run::contact::Contact;
use dashpot_vehicle_run::wear::WearLaw;
use dashpot_vehicle_run::{Indexer, Run, RunWear, VehicleTick};

use super::compared::{Compared, compared};

/// Compared signals of a run, at the ticks of the coarser run.
pub struct Trace {
    pub(super) names: Vec<String>,
    dampers: Vec<String>,
    pub(super) wheelsets: usize,
    pub(super) times_s: Vec<f64>,
    /// Lateral and vertical acceleration of each body other than wheelsets, m/s^2.
    pub(super) accelerations: Vec<Accelerations>,
    /// Track acceleration under each body, tick by tick.
    pub(super) track_accelerations: Vec<Vec<[f64; 5]>>,
    pub(super) lateral: Vec<Vec<f64>>,
    pub(super) loads: Vec<[Vec<f64>; 2]>,
    indexer: Indexer,
    wear: RunWear,
    pub(super) inner_step_s: f64,
}

/// Accelerations of a body, tick by tick, m/s^2.
#[derive(Clone, Default)]
pub(super) struct Accelerations {
    pub lateral: Vec<f64>,
    pub vertical: Vec<f64>,
}

impl Trace {
    /// Starts the trace of a run that has not been stepped yet.
    pub(super) fn for_run(run: &Run, case: &Case) -> Self {
        Self {
            inner_step_s: run.vehicle().inner_step_s(),
            ..Self::new(case, run.contacts(), Arc::clone(run.track()))
        }
    }

    /// Starts the trace of a case with the contact of each wheelset and the built track.
    pub(super) fn new(case: &Case, contacts: &[Contact], track: Arc<Track>) -> Self {
        let (bodies, wheelsets) = (&case.vehicle.bodies, &case.vehicle.wheelsets);
        let names = bodies.iter().map(|body| &body.name);
        let names = names.chain(wheelsets.iter().map(|wheelset| &wheelset.name));
        let dampers = case.vehicle.dampers();
        Self {
            names: names.cloned().collect(),
            dampers: dampers.map(|damper| damper.name.clone()).collect(),
            wheelsets: wheelsets.len(),
            times_s: Vec::new(),
            accelerations: vec![Accelerations::default(); bodies.len()],
            track_accelerations: Vec::new(),
            lateral: vec![Vec::new(); wheelsets.len()],
            loads: vec![Default::default(); wheelsets.len()],
            indexer: Indexer::new(case),
            wear: RunWear::on(case, contacts, track, WearLaw::default()),
            inner_step_s: case.step_s,
        }
    }

    /// Adds a tick.
    pub(super) fn add(&mut self, tick: &impl VehicleTick) {
        let bodies = self.accelerations.len();
        for (body, series) in self.accelerations.iter_mut().enumerate() {
            let acceleration = tick.acceleration(body);
            series.lateral.push(acceleration[0]);
            series.vertical.push(acceleration[1]);
        }
        for (series, coordinates) in self.lateral.iter_mut().zip(&tick.coordinates()[bodies..]) {
            series.push(coordinates[0]);
        }
        for (series, contact) in self.loads.iter_mut().zip(tick.contacts()) {
            for (side, series) in series.iter_mut().enumerate() {
                series.push(contact.wheels[side].load_n());
            }
        }
        self.indexer.add(tick);
        self.wear.add(tick);
    }

    /// Length of the integration steps within a tick, s.
    pub fn inner_step_s(&self) -> f64 {
        self.inner_step_s
    }

    /// Returns the compared indices in a fixed order; none before the first tick.
    pub(super) fn compared(&self) -> Vec<Compared> {
        let wear = self.wear.indices();
        let indices = self.indexer.indices();
        indices.map_or_else(Vec::new, |indices| {
            compared(&indices, wear.as_ref(), &self.dampers)
        })
    }
}
