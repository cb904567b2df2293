//! What it changes that dampers stand outside: the run beside the same one with all of its dampers inside.

use dashpot_reference::deviation::{errors, root_mean_square};
use serde::Serialize;

use super::deviations::{Deviations, Trace, Worst};
use dashpot_files::case::Case;
use dashpot_vehicle_run::{Run, VehicleRunError, VehicleTick};

/// Ticks that are compared at most: some 200 bytes each are kept of both runs.
const MOST_TICKS: u64 = 600_000;

/// Keeps of a run what is compared.
pub struct Beside {
    start: Run,
    dampers: Vec<usize>,
    ticks: u64,
    trace: Trace,
    outside_n: Vec<Vec<f64>>,
}

/// Differences of a run from the same one with all dampers inside.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Effect {
    /// Time that they are of, s.
    pub duration_s: f64,
    /// Dampers outside.
    pub dampers: Vec<DamperEffect>,
    /// Of the vehicle.
    pub deviations: Deviations<Worst>,
}

/// Difference of a damper's force outside from that inside.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DamperEffect {
    /// Name.
    pub damper: String,
    /// Root mean square of the force inside, N.
    pub force_rms_n: f64,
    /// Root mean square of the difference, N.
    pub difference_rms_n: f64,
}

/// Forces of a damper in both runs, tick by tick, N.
#[derive(Debug, Clone, PartialEq)]
pub struct Forces {
    /// Name.
    pub damper: String,
    /// With the damper outside.
    pub outside_n: Vec<f64>,
    /// With it inside.
    pub inside_n: Vec<f64>,
}

impl Beside {
    /// Of a run that has not begun, its dampers still inside, and the numbers of those that will be outside.
    pub fn new(run: &Run, case: &Case, dampers: Vec<usize>) -> Self {
        Self {
            start: run.clone(),
            outside_n: vec![Vec::new(); dampers.len()],
            dampers,
            ticks: 0,
            trace: Trace::of(run, case),
        }
    }

    /// Adds a tick.
    pub fn add(&mut self, tick: &impl VehicleTick) {
        if self.ticks >= MOST_TICKS {
            return;
        }
        self.ticks += 1;
        self.trace.add_state(tick);
        for (series, damper) in self.outside_n.iter_mut().zip(&self.dampers) {
            series.push(tick.damper_forces_n()[*damper]);
        }
    }

    /// Runs the same case with all dampers inside, as far as both go; nothing of a run without a tick.
    ///
    /// # Errors
    /// As [`Run::step`].
    pub fn compare(self, case: &Case) -> Result<Option<(Effect, Vec<Forces>)>, VehicleRunError> {
        if self.ticks == 0 {
            return Ok(None);
        }
        let mut run = self.start;
        let mut inside = Self::new(&run, case, self.dampers.clone());
        while inside.ticks < self.ticks && run.step()?.is_none() {
            inside.add(run.state());
        }
        let names: Vec<&str> = run.vehicle().damper_names().collect();
        let pairs = self.dampers.iter().zip(self.outside_n);
        let forces: Vec<Forces> = pairs
            .zip(inside.outside_n)
            .map(|((damper, mut outside_n), inside_n)| {
                outside_n.truncate(inside_n.len());
                Forces {
                    damper: names[*damper].to_owned(),
                    outside_n,
                    inside_n,
                }
            })
            .collect();
        let dampers = forces.iter().map(|forces| DamperEffect {
            damper: forces.damper.clone(),
            force_rms_n: root_mean_square(forces.inside_n.iter().copied()),
            difference_rms_n: root_mean_square(errors(&forces.outside_n, &forces.inside_n)),
        });
        let effect = Effect {
            duration_s: inside.ticks as f64 * case.step_s,
            dampers: dampers.collect(),
            deviations: self.trace.deviations(&inside.trace),
        };
        Ok(Some((effect, forces)))
    }
}
