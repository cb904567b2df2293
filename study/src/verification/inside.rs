//! Effect of dampers that run outside the vehicle model: compares a run with the same run with all dampers inside.

use dashpot_reference::deviation::{errors, root_mean_square};
use serde::Serialize;

use super::deviations::{Deviations, Worst};
use super::trace::Trace;
use dashpot_files::case::Case;
use dashpot_vehicle_run::{Run, VehicleRunError, VehicleTick};

/// Maximum number of compared ticks; each takes about 200 bytes per run.
const MAX_TICKS: u64 = 600_000;

/// Records a run with external dampers, for comparison with the run with all dampers inside.
pub struct InsideComparison {
    start: Run,
    dampers: Vec<usize>,
    ticks: u64,
    trace: Trace,
    outside_n: Vec<Vec<f64>>,
}

/// Differences between a run and the same run with all dampers inside.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Effect {
    /// Compared duration, s.
    pub duration_s: f64,
    /// Differences of each damper that was outside.
    pub dampers: Vec<DamperEffect>,
    /// Largest deviations of the vehicle.
    pub deviations: Deviations<Worst>,
    /// Every index of both runs.
    pub indices: Vec<IndexEffect>,
}

/// An index of the run with external dampers and of the run with all dampers inside.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct IndexEffect {
    /// Name of the index.
    pub index: String,
    /// Value with all dampers inside.
    pub inside: f64,
    /// Value with external dampers.
    pub outside: f64,
    /// Difference relative to the value inside, or to the scale of such an index if the value is smaller.
    pub relative: f64,
    /// True for a minimum, a maximum or a duration, false for a mean or a root mean square.
    pub is_extreme: bool,
}

/// Difference between the forces of a damper in the run with this damper external and in the run with it inside.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DamperEffect {
    /// Name of the damper.
    pub damper: String,
    /// Root mean square of the force with the damper inside, N.
    pub force_rms_n: f64,
    /// Root mean square of the difference between the two forces, N.
    pub difference_rms_n: f64,
}

/// Forces of a damper in both runs, tick by tick.
#[derive(Debug, Clone, PartialEq)]
pub struct Forces {
    /// Name of the damper.
    pub damper: String,
    /// Force of the external damper, N.
    pub outside_n: Vec<f64>,
    /// Force with the damper inside, N.
    pub inside_n: Vec<f64>,
}

impl InsideComparison {
    /// Starts from a run that has not been stepped yet and whose dampers are all still inside; `dampers` are the
    /// indices of the dampers that will be outside.
    pub fn new(run: &Run, case: &Case, dampers: Vec<usize>) -> Self {
        Self {
            start: run.clone(),
            outside_n: vec![Vec::new(); dampers.len()],
            dampers,
            ticks: 0,
            trace: Trace::for_run(run, case),
        }
    }

    /// Adds a tick.
    pub fn add(&mut self, tick: &impl VehicleTick) {
        if self.ticks >= MAX_TICKS {
            return;
        }
        self.ticks += 1;
        self.trace.add(tick);
        for (series, damper) in self.outside_n.iter_mut().zip(&self.dampers) {
            series.push(tick.damper_forces_n()[*damper]);
        }
    }

    /// Runs the same case with all dampers inside, and compares the two runs within the duration of the shorter one.
    /// Returns `None` if no tick was added.
    ///
    /// # Errors
    /// Same errors as [`Run::step`].
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
            indices: index_effects(&self.trace, &inside.trace),
        };
        Ok(Some((effect, forces)))
    }
}

/// Every index of both runs.
fn index_effects(outside: &Trace, inside: &Trace) -> Vec<IndexEffect> {
    let pairs = outside.compared().into_iter().zip(inside.compared());
    let effects = pairs.map(|(outside, inside)| IndexEffect {
        relative: outside.deviation(&inside),
        index: inside.name,
        inside: inside.value,
        outside: outside.value,
        is_extreme: inside.is_extreme,
    });
    effects.collect()
}
