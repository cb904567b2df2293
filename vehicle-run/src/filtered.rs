//! Wheel forces as acceptance tests judge them: filtered at 20 Hz, and averaged over 2 m.

use dashpot_files::case::Case;
use dashpot_rail::indices::LowPass;

use super::indices::{Ticks, Windowed};
use super::signals::{SIDES, load_n, slug};
use super::{FILTER_HZ, VehicleTick};

/// Filters the forces of every wheelset tick by tick: the lateral force on the track and `Y/Q`, averaged over 2 m, and
/// the load of each wheel.
#[derive(Debug, Clone)]
pub struct FilteredForces {
    names: Vec<String>,
    ticks: Ticks,
    wheelsets: Vec<Wheelset>,
    values: Vec<f64>,
}

#[derive(Debug, Clone)]
struct Wheelset {
    lateral: Averaged,
    derailment: [Averaged; 2],
    loads: [LowPass; 2],
}

/// A low-pass, and the mean of its last outputs.
#[derive(Debug, Clone)]
struct Averaged {
    filter: LowPass,
    last: Windowed,
}

impl Averaged {
    /// Returns the mean over the window up to this value, or over all values before the first whole window.
    fn next(&mut self, value: f64, window: usize) -> f64 {
        self.last.add(self.filter.next(value), window);
        self.last.mean()
    }
}

impl FilteredForces {
    /// Starts with the first tick of a case.
    pub fn new(case: &Case) -> Self {
        let mut names = Vec::new();
        for wheelset in &case.vehicle.wheelsets {
            let name = slug(&wheelset.name);
            names.push(format!("{name}_filtered_lateral_force_n"));
            for side in SIDES {
                names.push(format!("{name}_{side}_filtered_derailment"));
                names.push(format!("{name}_{side}_filtered_load_n"));
            }
        }
        let ticks = Ticks::new(case);
        let filter = LowPass::new(FILTER_HZ, 1.0 / case.step_s);
        let averaged = || Averaged {
            filter: filter.clone(),
            last: Windowed::new(ticks.longest_window()),
        };
        let wheelsets = case.vehicle.wheelsets.iter().map(|_| Wheelset {
            lateral: averaged(),
            derailment: [averaged(), averaged()],
            loads: [filter.clone(), filter.clone()],
        });
        Self {
            wheelsets: wheelsets.collect(),
            ticks,
            values: Vec::with_capacity(names.len()),
            names,
        }
    }

    /// Names of the values, which end in the unit.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Adds a tick and returns its values. Does not allocate.
    pub fn next(&mut self, tick: &impl VehicleTick) -> &[f64] {
        self.values.clear();
        self.ticks.go_on(tick);
        let window = self.ticks.window();
        for (wheelset, contact) in self.wheelsets.iter_mut().zip(tick.contacts()) {
            self.values
                .push(wheelset.lateral.next(contact.force_n[1], window));
            let coefficients = contact.derailment_coefficients();
            for (side, coefficient) in coefficients.into_iter().enumerate() {
                self.values
                    .push(wheelset.derailment[side].next(coefficient, window));
                self.values
                    .push(wheelset.loads[side].next(load_n(contact, side)));
            }
        }
        &self.values
    }
}
