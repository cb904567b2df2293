//! The bank of models: a damper with each cause in turn, fitted to the recording.

use super::CauseKind;
use super::fitted::{Fitted, RigPrior};
use super::search::least;
use crate::loops::{Factors, LoopTest};
use dashpot_core::CheckedParameters;
use dashpot_files::damper::KeyedParameters;

const STIFFNESS: &str = "mount.stiffness_n_per_m";
const CLEARANCE: &str = "mount.clearance_m";

/// Standard deviation of the delay in models of other causes (s).
const SMALL_DELAY_S: f64 = 1e-3;

/// Standard deviation of the delay in the model of a lag (s).
const LARGE_DELAY_S: f64 = 20e-3;

/// Standard deviation of the force offset in models of other causes, as a share of half the range of the force.
const SMALL_OFFSET: f64 = 0.01;

/// The same in the model of a wrong zero.
const LARGE_OFFSET: f64 = 0.5;

/// Range of the factors of flow and stiffness, on both sides of 1.
const MAX_FACTOR: f64 = 6.0;

/// Range of the factors of sensors, on both sides of 1.
const MAX_SCALE: f64 = 2.5;

/// Largest clearance (m).
const MAX_CLEARANCE_M: f64 = 12e-3;

/// Changes that do not count, about a third of those that raise an alarm: logarithms of factors,
const SMALL_FLOW: f64 = 0.05;
const SMALL_STIFFNESS: f64 = 0.1;
const SMALL_SCALE: f64 = 0.03;
/// m,
const SMALL_CLEARANCE_M: f64 = 0.15e-3;
/// N (or [`SMALL_OFFSET`]),
const SMALL_ZERO_N: f64 = 100.0;
/// and s.
pub(super) const SMALL_LAG_S: f64 = 1.5e-3;

/// A damper and its recording.
pub(super) struct Bank {
    pub(super) damper: KeyedParameters,
    pub(super) tests: Vec<LoopTest>,
    pub(super) step_s: f64,
}

impl Bank {
    /// Returns the best fit of every cause that can be simulated.
    pub(super) fn fits(&self) -> Vec<Fitted> {
        const CAUSES: [CauseKind; 9] = [
            CauseKind::AsNew,
            CauseKind::Flow,
            CauseKind::Stiffness,
            CauseKind::Clearance,
            CauseKind::ForceScale,
            CauseKind::DisplacementScale,
            CauseKind::ForceZero,
            CauseKind::Lag,
            CauseKind::Reversed,
        ];
        let fits = dashpot_workers::map(&CAUSES, |kind| Ok::<_, ()>(self.fit(*kind)));
        fits.unwrap_or_default().into_iter().flatten().collect()
    }

    /// Fits one cause.
    fn fit(&self, kind: CauseKind) -> Option<Fitted> {
        let (from, to) = match kind {
            CauseKind::Flow | CauseKind::Stiffness => (-MAX_FACTOR.ln(), MAX_FACTOR.ln()),
            CauseKind::ForceScale | CauseKind::DisplacementScale => {
                (-MAX_SCALE.ln(), MAX_SCALE.ln())
            }
            CauseKind::Clearance => (0.0, MAX_CLEARANCE_M),
            _ => return self.fitted(kind, 0.0),
        };
        let square = |size: f64| {
            let fitted = self.fitted(kind, size);
            fitted.map_or(f64::NAN, |fitted| fitted.square)
        };
        self.fitted(kind, least(from, to, square)?)
    }

    /// Returns the model with a cause of this size on the scale of the search.
    fn fitted(&self, kind: CauseKind, size: f64) -> Option<Fitted> {
        let forces = self.forces(kind, size)?;
        let half_range = self
            .tests
            .iter()
            .map(|test| test.force_half_range_n)
            .fold(1e-3, f64::max);
        let prior = RigPrior {
            offset_n: half_range
                * if kind == CauseKind::ForceZero {
                    LARGE_OFFSET
                } else {
                    SMALL_OFFSET
                },
            delay_s: if kind == CauseKind::Lag {
                LARGE_DELAY_S
            } else {
                SMALL_DELAY_S
            },
        };
        let fitted = Fitted::new(kind, &self.tests, &forces, prior, self.step_s);
        let (value, change, small) = match kind {
            CauseKind::AsNew => (0.0, 0.0, f64::INFINITY),
            CauseKind::Reversed => (0.0, 0.0, -1.0),
            CauseKind::Flow => (size.exp(), size, SMALL_FLOW),
            CauseKind::Stiffness => (
                size.exp() * self.damper.number(STIFFNESS).ok()?,
                size,
                SMALL_STIFFNESS,
            ),
            CauseKind::Clearance => {
                let as_new_m = self.damper.number(CLEARANCE).ok()?;
                (size, size - as_new_m, SMALL_CLEARANCE_M)
            }
            CauseKind::ForceScale | CauseKind::DisplacementScale => (size.exp(), size, SMALL_SCALE),
            CauseKind::ForceZero => {
                let small_n = SMALL_ZERO_N.max(SMALL_OFFSET * half_range);
                (fitted.offset_n, fitted.offset_n, small_n)
            }
            _ => (fitted.delay_s, fitted.delay_s, SMALL_LAG_S),
        };
        let is_free = !matches!(kind, CauseKind::AsNew | CauseKind::Reversed);
        Some(Fitted {
            value,
            is_small: change.abs() <= small,
            parameters: u8::from(is_free),
            ..fitted
        })
    }

    /// Returns the forces of the damper with a cause, at ticks; `None` if there is no such damper.
    fn forces(&self, kind: CauseKind, size: f64) -> Option<Vec<Vec<f64>>> {
        let factor = size.exp();
        let stiffness = self.damper.number(STIFFNESS).ok()?;
        let clearance = self.damper.number(CLEARANCE).ok()?;
        // More flow at the same force, v = phi v_h(F), is the damper as new moved by x/phi, with its mount moved by as
        // much less.
        let (changes, scales) = match kind {
            CauseKind::Flow => (
                vec![
                    (STIFFNESS, stiffness * factor),
                    (CLEARANCE, clearance / factor),
                ],
                Factors {
                    displacement: 1.0 / factor,
                    force: 1.0,
                },
            ),
            CauseKind::Stiffness => (vec![(STIFFNESS, stiffness * factor)], Factors::ONE),
            CauseKind::Clearance => (vec![(CLEARANCE, size)], Factors::ONE),
            CauseKind::ForceScale => (
                Vec::new(),
                Factors {
                    displacement: 1.0,
                    force: factor,
                },
            ),
            CauseKind::DisplacementScale => (
                Vec::new(),
                Factors {
                    displacement: 1.0 / factor,
                    force: 1.0,
                },
            ),
            CauseKind::Reversed => (
                Vec::new(),
                Factors {
                    displacement: 1.0,
                    force: -1.0,
                },
            ),
            _ => (Vec::new(), Factors::ONE),
        };
        self.simulated(&self.damper.with(&changes).ok()?, scales)
    }

    fn simulated(&self, damper: &CheckedParameters, scales: Factors) -> Option<Vec<Vec<f64>>> {
        let built = damper.build::<f64>(self.step_s).ok()?;
        let forces = self.tests.iter().map(|test| {
            let moved = |x: &f64| scales.displacement * (x - test.displacement_offset_m);
            let x = &test.displacements_m;
            let mut state = built.at_rest(x.first().map_or(0.0, moved));
            let step = |x: &f64| scales.force * built.step(&mut state, moved(x));
            x.iter().map(step).collect()
        });
        Some(forces.collect())
    }

    /// Returns the rms of the residual beyond the noise, as a share of the force.
    pub(super) fn unexplained(&self, best: &Fitted) -> f64 {
        let forces = || self.tests.iter().flat_map(LoopTest::counted_forces_n);
        let count = best.residuals.len().max(1) as f64;
        let mean = forces().sum::<f64>() / count;
        let force = forces().map(|force| (force - mean).powi(2)).sum::<f64>() / count;
        let noise = self
            .tests
            .iter()
            .map(|test| test.force_noise_n.powi(2))
            .fold(0.0, f64::max);
        let beyond = (best.square / count - noise).max(0.0);
        (beyond / force.max(f64::MIN_POSITIVE)).sqrt()
    }
}
