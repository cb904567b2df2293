//! Elements whose force is not linear: dampers and stops, each along one displacement between two bodies.

use dashpot_core::Damper;

use super::block::{N, Vector};
use crate::vehicle::linear::{Linear, Place};

/// The displacement of the second end of an element against the first along its axis, from the coordinates of its bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Across {
    bodies: [Option<usize>; 2],
    by: [Vector; 2],
}

impl Across {
    pub fn new(linear: &Linear, places: &[Place; 2], axis: usize) -> Self {
        let rows = linear.displacement(places);
        let bodies = [places[0].body, places[1].body];
        let by = bodies.map(|body| match body {
            Some(body) => std::array::from_fn(|i| rows[(axis, N * body + i)]),
            None => [0.0; N],
        });
        Self { bodies, by }
    }

    /// Of the coordinates that `of` gives for a body.
    #[inline(always)]
    pub fn displacement(&self, of: impl Fn(usize) -> Vector) -> f64 {
        let mut displacement = 0.0;
        for (body, by) in self.bodies.iter().zip(&self.by) {
            if let Some(body) = body {
                let coordinates = of(*body);
                displacement += by.iter().zip(&coordinates).map(|(a, b)| a * b).sum::<f64>();
            }
        }
        displacement
    }

    /// Whether an end is on the track, which the coordinates are relative to.
    pub fn is_on_track(&self) -> bool {
        self.bodies.iter().any(Option::is_none)
    }

    /// Adds a force that pulls the ends together to the forces on the bodies.
    #[inline(always)]
    pub fn pull(&self, force: f64, forces: &mut [Vector]) {
        for (body, by) in self.bodies.iter().zip(&self.by) {
            if let Some(body) = body {
                for (sum, by) in forces[*body].iter_mut().zip(by) {
                    *sum -= force * by;
                }
            }
        }
    }
}

/// A hydraulic damper of the vehicle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DamperElement {
    pub name: String,
    pub across: Across,
    pub damper: Damper<f64>,
}

/// A stop on both sides.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StopElement {
    pub across: Across,
    pub points: Vec<[f64; 2]>,
}

impl StopElement {
    /// Force against a displacement, of its sign: zero in the gap, linear between the points, on with the last slope beyond.
    #[inline(always)]
    pub fn force(&self, displacement: f64) -> f64 {
        let reach = displacement.abs();
        let Some([gap, _]) = self.points.first() else {
            return 0.0;
        };
        if reach <= *gap {
            return 0.0;
        }
        let mut force = 0.0;
        for pair in self.points.windows(2) {
            let [[x0, f0], [x1, f1]] = [pair[0], pair[1]];
            if reach > x0 {
                force = f0 + (f1 - f0) / (x1 - x0) * (reach - x0);
            }
        }
        force.copysign(displacement)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_is_piecewise_linear_on_both_sides() {
        let stop = StopElement {
            across: Across {
                bodies: [None; 2],
                by: [[0.0; N]; 2],
            },
            points: vec![[0.02, 0.0], [0.026, 2e3], [0.032, 5e3]],
        };
        for (x, expected) in [
            (0.0, 0.0),
            (0.02, 0.0),
            (0.023, 1e3),
            (0.026, 2e3),
            (0.029, 3.5e3),
            (0.032, 5e3),
            (0.042, 10e3),
        ] {
            assert!((stop.force(x) - expected).abs() < 1e-9, "{x}");
            assert!((stop.force(-x) + expected).abs() < 1e-9, "{x}");
        }
    }
}
