//! Changes of a run by the events of its case.

use dashpot_files::case::{Case, Change, Course};
use dashpot_rail::creep::CreepLaw;
use dashpot_rail::vehicle::{Vehicle, VehicleError, VehicleState};

/// Courses of all quantities that events change. Quantities that no event changes are left to the caller.
#[derive(Debug, Clone)]
pub(super) struct Influences {
    speed: Course<1>,
    friction_factor: Course<1>,
    /// Force and moment about the centre of a body, by its index.
    forces: Vec<(usize, Course<5>)>,
    step_s: f64,
}

impl Influences {
    /// Resolves the events of `case` for its vehicle.
    pub fn new<L: CreepLaw>(case: &Case, vehicle: &Vehicle<L>) -> Self {
        let mut friction_factor = Course::new([1.0]);
        let mut forces: Vec<(usize, Course<5>)> = Vec::new();
        for event in &case.events {
            match &event.change {
                Change::Speed(_) => {}
                Change::FrictionFactor(factor) => {
                    friction_factor.then(event.time_s, event.ramp_s, [*factor]);
                }
                Change::Force {
                    body,
                    at_m,
                    force_n,
                } => {
                    let index = vehicle.names().iter().position(|name| name == body);
                    let force = |index| vehicle.about_centre(index, *at_m, *force_n);
                    let Some((index, force)) = index.and_then(|index| Some((index, force(index)?)))
                    else {
                        continue;
                    };
                    let place = forces.iter().position(|(other, _)| *other == index);
                    let place = place.unwrap_or_else(|| {
                        forces.push((index, Course::new([0.0; 5])));
                        forces.len() - 1
                    });
                    forces[place].1.then(event.time_s, event.ramp_s, force);
                }
            }
        }
        Self {
            speed: case.speeds_m_per_s(),
            friction_factor,
            forces,
            step_s: case.step_s,
        }
    }

    /// Sets what changes in the tick that starts at `time_s`. Does not allocate.
    pub fn apply(&self, time_s: f64, state: &mut VehicleState) -> Result<(), VehicleError> {
        if let Some([speed]) = self.change(&self.speed, time_s) {
            state.set_speed_m_per_s(speed)?;
        }
        if let Some([factor]) = self.change(&self.friction_factor, time_s) {
            state.set_friction_factor(factor)?;
        }
        for (body, course) in &self.forces {
            if let Some(force) = self.change(course, time_s) {
                state.apply(*body, force)?;
            }
        }
        Ok(())
    }

    /// Returns the value in the middle of the tick if it differs from that in the tick before.
    fn change<const N: usize>(&self, course: &Course<N>, time_s: f64) -> Option<[f64; N]> {
        let [before, now] = [-0.5, 0.5].map(|ticks| course.at(time_s + ticks * self.step_s));
        (now != before).then_some(now)
    }
}
