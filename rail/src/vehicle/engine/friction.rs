//! Dry friction: a spring in series with a slider.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::Vehicle;
use super::across::Across;
use super::state::VehicleState;
use crate::contact::PatchSource;
use crate::creep::CreepLaw;
use crate::vehicle::element::{Element, Law};
use crate::vehicle::error::VehicleError;
use crate::vehicle::linear::{Attachment, Linear};
use crate::vehicle::standstill::AttachedEnds;

/// Maximum phase of the oscillation of the bodies on stuck friction elements during a tick, rad. Forces follow the
/// positions that are predicted for the end of the tick. Up to 1.5 rad such an oscillation decays.
const MAX_PHASE_RAD: f64 = 1.0;

/// A friction element of the vehicle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FrictionElement {
    pub name: String,
    pub across: Across,
    stiffness_n_per_m: f64,
    friction_n: f64,
    load: Option<Load>,
}

/// The load of a spring that friction follows.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Load {
    /// Vertical displacement of the spring.
    across: Across,
    coefficient: f64,
    /// At standstill, N.
    standing_n: f64,
    /// Change of the load per displacement of the spring, N/m.
    change_n_per_m: f64,
}

/// The elements of a vehicle with their forces at standstill.
pub(super) struct Standing<'a> {
    pub linear: &'a Linear,
    pub elements: &'a [Element],
    pub attached: &'a [AttachedEnds],
    /// Force of each element on its second end, N.
    pub forces: &'a [Vector3<f64>],
}

impl Load {
    /// The load of the element called `spring`. [`Standstill`](crate::vehicle::Standstill) checks that it carries one.
    fn new(spring: &str, coefficient: f64, standing: &Standing<'_>) -> Option<Self> {
        let number = standing
            .elements
            .iter()
            .position(|element| element.name == spring)?;
        let stiffness = standing.elements[number].law.vertical_stiffness()?;
        let force = standing.forces[number].z;
        Some(Self {
            across: Across::new(standing.linear, &standing.attached[number].0, 2),
            coefficient,
            standing_n: force.abs(),
            // The force on the second end changes by `-stiffness` times the displacement.
            change_n_per_m: -stiffness * force.signum(),
        })
    }
}

impl FrictionElement {
    /// `None` if the element has another law.
    pub fn new(element: &Element, ends: &[Attachment; 2], standing: &Standing<'_>) -> Option<Self> {
        let Law::Friction {
            direction,
            stiffness_n_per_m,
            friction_n,
            load,
        } = &element.law
        else {
            return None;
        };
        let load = load.as_ref();
        Some(Self {
            name: element.name.clone(),
            across: Across::new(standing.linear, ends, direction.axis()),
            stiffness_n_per_m: *stiffness_n_per_m,
            friction_n: *friction_n,
            load: load.and_then(|load| Load::new(&load.spring, load.coefficient, standing)),
        })
    }

    /// Limit of the friction force, with the displacements along [`Across`] by `displacement`, N.
    #[inline(always)]
    pub fn limit_n(&self, displacement: impl Fn(&Across) -> f64) -> f64 {
        self.load.as_ref().map_or(self.friction_n, |load| {
            let change_n = load.change_n_per_m * displacement(&load.across);
            self.friction_n + load.coefficient * (load.standing_n + change_n).max(0.0)
        })
    }

    /// Force that resists a displacement, with the sign of the stretch of the spring. The slider stays where it is
    /// unless the spring would exceed the limit; then it moves until the spring has exactly this force.
    #[inline(always)]
    pub fn force(&self, displacement: f64, limit_n: f64, slider_m: &mut f64) -> f64 {
        let trial = self.stiffness_n_per_m * (displacement - *slider_m);
        if trial.abs() <= limit_n {
            return trial;
        }
        let force = limit_n.copysign(trial);
        *slider_m = displacement - force / self.stiffness_n_per_m;
        force
    }
}

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// Moves all sliders to where their springs exert no force.
    pub(super) fn relax_friction(&self, state: &mut VehicleState) {
        for (element, slider) in self.frictions.iter().zip(&mut state.sliders_m) {
            let from = if element.across.is_on_track() {
                &state.coordinates
            } else {
                &state.work.in_middle
            };
            *slider = element.across.displacement(|body| from[body]);
        }
    }
}

/// Checks that the step follows the oscillation of the bodies on `stuck`, the springs of all friction elements.
pub(super) fn check_stiffness(stuck: &Linear, step_s: f64) -> Result<(), VehicleError> {
    let fastest = stuck.fastest_rad_per_s();
    if fastest * step_s <= MAX_PHASE_RAD {
        return Ok(());
    }
    Err(VehicleError::FrictionTooStiff {
        frequency_hz: fastest / TAU,
        allowed_hz: MAX_PHASE_RAD / step_s / TAU,
        step_s,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn element() -> FrictionElement {
        let linear = Linear::new(&[]);
        let held = Attachment::new(None, Vector3::zeros());
        FrictionElement {
            name: "friction".to_owned(),
            across: Across::new(&linear, &[held; 2], 0),
            stiffness_n_per_m: 5e6,
            friction_n: 10e3,
            load: None,
        }
    }

    /// Work of a cycle of amplitude `amplitude_m`, J, by the exact integral of a force that is linear between samples.
    fn work_j(amplitude_m: f64, samples: usize) -> f64 {
        let (element, mut slider) = (element(), 0.0);
        let (mut before, mut work) = ([0.0; 2], 0.0);
        // The first quarter loads the element; the cycle after it is closed.
        for sample in 1..=5 * samples {
            let at = sample as f64 / samples as f64;
            // A triangle wave: up to the amplitude at 1, down to minus it at 3, and up again at 5.
            let share = 1.0 - ((at + 1.0).rem_euclid(4.0) - 2.0).abs();
            let x = amplitude_m * share;
            let force = element.force(x, element.friction_n, &mut slider);
            if sample > samples {
                work += 0.5 * (force + before[1]) * (x - before[0]);
            }
            before = [x, force];
        }
        work
    }

    /// `4 Fd (A - Fd/ks)`: 320 J at 10 mm.
    #[test]
    fn a_loop_dissipates_the_work_of_the_slider() {
        for amplitude_m in [2.5e-3, 4e-3, 10e-3] {
            let expected = 4.0 * 10e3 * (amplitude_m - 10e3 / 5e6);
            // Corners are samples: 2 Fd/ks is a whole number of samples.
            let found = work_j(amplitude_m, 5000);
            assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
        }
    }

    #[test]
    fn a_slider_that_sticks_does_not_move_at_all() {
        let (element, mut slider) = (element(), 1e-3);
        for number in 0..1000 {
            let x = 1e-3 + 1.999e-3 * f64::from(number).sin();
            let force = element.force(x, element.friction_n, &mut slider);
            assert_eq!(slider.to_bits(), 1e-3_f64.to_bits());
            assert_eq!(force.to_bits(), (5e6 * (x - 1e-3)).to_bits());
        }
        assert!(work_j(1.5e-3, 1000).abs() < 1e-12);
        assert!(work_j(2e-3, 1000).abs() < 1e-12);
    }

    #[test]
    fn a_slider_that_slides_has_exactly_its_limit() {
        let (element, mut slider) = (element(), 0.0);
        assert_eq!(element.force(5e-3, 10e3, &mut slider), 10e3);
        assert!((slider - 3e-3).abs() < 1e-15);
        assert_eq!(element.force(-9e-3, 10e3, &mut slider), -10e3);
        // A limit that falls while the ends rest lets the slider move.
        assert_eq!(element.force(-9e-3, 4e3, &mut slider), -4e3);
        assert_eq!(element.force(-9e-3, 0.0, &mut slider), 0.0);
        assert_eq!(slider, -9e-3);
    }

    #[test]
    fn no_motion_makes_the_force_other_than_finite() {
        let element = element();
        for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN, f64::MAX] {
            let mut slider = 0.0;
            let force = element.force(x, 10e3, &mut slider);
            assert_eq!(force.abs(), 10e3, "{x}");
        }
    }
}
