//! Elements with nonlinear forces: dampers and stops here, friction in `friction.rs`, each along one displacement
//! between two bodies.

use dashpot_core::Damper;

use super::block::{N, Vector};
use crate::vehicle::linear::{Attachment, Linear};

/// Displacement of an element's second end relative to its first along one axis, as a function of the bodies'
/// coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Across {
    /// Indices of both bodies; `None` on the track.
    bodies: [Option<usize>; 2],
    /// Displacement per unit of each coordinate of each body.
    gradients: [Vector; 2],
}

impl Across {
    pub fn new(linear: &Linear, ends: &[Attachment; 2], axis: usize) -> Self {
        let rows = linear.displacement(ends);
        let bodies = [ends[0].body, ends[1].body];
        let gradients = bodies.map(|body| match body {
            Some(body) => std::array::from_fn(|i| rows[(axis, N * body + i)]),
            None => [0.0; N],
        });
        Self { bodies, gradients }
    }

    /// Displacement when the bodies are at `coordinates(body)`.
    #[inline(always)]
    pub fn displacement(&self, coordinates: impl Fn(usize) -> Vector) -> f64 {
        let mut displacement = 0.0;
        for (body, gradient) in self.bodies.iter().zip(&self.gradients) {
            if let Some(body) = body {
                let q = coordinates(*body);
                displacement += gradient.iter().zip(&q).map(|(a, b)| a * b).sum::<f64>();
            }
        }
        displacement
    }

    /// True if an end is on the track.
    pub fn is_on_track(&self) -> bool {
        self.bodies.iter().any(Option::is_none)
    }

    /// Adds to the forces on the bodies a force that pulls the two ends together.
    #[inline(always)]
    pub fn pull(&self, force: f64, forces: &mut [Vector]) {
        for (body, gradient) in self.bodies.iter().zip(&self.gradients) {
            if let Some(body) = body {
                for (sum, share) in forces[*body].iter_mut().zip(gradient) {
                    *sum -= force * share;
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

/// A two-sided stop.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StopElement {
    pub across: Across,
    pub points: Vec<[f64; 2]>,
}

impl StopElement {
    /// Force that resists a displacement, with the sign of the displacement: zero in the gap, linear between the
    /// points, extrapolated with the last slope beyond them.
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
                gradients: [[0.0; N]; 2],
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
