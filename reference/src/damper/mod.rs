//! Reference solution of the damper: it implements the laws in the documentation of the parameters and integrates them
//! with an adaptive stiff solver at a tolerance of 1e-12 per step.
//!
//! It shares nothing with the fixed step except the parameters. Chamber pressure and piston position are states;
//! contact at the clearance, opening valves, release and yielding are events. Displacement is positive in extension;
//! force is positive if it resists extension.

mod bracket;
mod chambers;
mod integrator;
mod motion;
mod oil;
mod passage;
mod paths;
mod segment;
mod shim;
pub(crate) mod side;

use std::rc::Rc;

use dashpot_core::DamperParameters;

use self::integrator::EsdirkIntegrator;
pub use self::motion::Statistics;
use self::motion::{Mode, Motion, Piece};
use self::segment::Scales;
pub use self::segment::{Arrival, Integrator, STATES, Segment};
use self::side::Side;
use crate::error::ReferenceError;

/// Number of linear pieces of a motion between two checks for cancellation.
const PIECES_PER_CHECK: usize = 64;

/// Reference solver of one damper.
pub struct Reference {
    sides: Rc<[Side; 2]>,
    half_clearance: f64,
    statistics: Statistics,
}

impl Reference {
    /// Builds the laws of a damper.
    ///
    /// # Errors
    /// A law has no solution: the force limit is below the force at which the piston starts, there is no flow path or
    /// no stiffness, or the clearance is negative.
    pub fn new(parameters: &DamperParameters) -> Result<Self, ReferenceError> {
        let clearance = parameters.mount.clearance_m;
        if !(clearance >= 0.0 && clearance.is_finite()) {
            return Err(ReferenceError::Clearance {
                clearance_m: clearance,
            });
        }
        Ok(Self {
            sides: Rc::new(Side::both(parameters)?),
            half_clearance: clearance / 2.0,
            statistics: Statistics::default(),
        })
    }

    /// Returns the force (N) at each time (s). The displacement (m) is linear between samples; the damper starts at
    /// rest in the middle of its clearance. The rate of the input is not limited.
    ///
    /// # Errors
    /// Times that do not increase, values that are not finite, unequal lengths, or a tolerance that the solver cannot
    /// reach.
    pub fn forces(
        &mut self,
        times_s: &[f64],
        displacements_m: &[f64],
    ) -> Result<Vec<f64>, ReferenceError> {
        self.forces_unless(times_s, displacements_m, &|| false)
    }

    /// Returns the forces as [`Self::forces`] does, unless `is_cancelled` returns true first.
    ///
    /// # Errors
    /// The errors of [`Self::forces`], and [`ReferenceError::Cancelled`] after a cancellation.
    pub fn forces_unless(
        &mut self,
        times_s: &[f64],
        displacements_m: &[f64],
        is_cancelled: &dyn Fn() -> bool,
    ) -> Result<Vec<f64>, ReferenceError> {
        let mut solver = EsdirkIntegrator::default();
        self.forces_by(&mut solver, times_s, displacements_m, is_cancelled)
    }

    /// Returns the forces as [`Self::forces`] does, but uses another solver for the segments.
    ///
    /// # Errors
    /// The errors of [`Self::forces`].
    pub fn forces_with(
        &mut self,
        solver: &mut dyn Integrator,
        times_s: &[f64],
        displacements_m: &[f64],
    ) -> Result<Vec<f64>, ReferenceError> {
        self.forces_by(solver, times_s, displacements_m, &|| false)
    }

    fn forces_by(
        &mut self,
        solver: &mut dyn Integrator,
        times: &[f64],
        x: &[f64],
        is_cancelled: &dyn Fn() -> bool,
    ) -> Result<Vec<f64>, ReferenceError> {
        check_samples(times, x)?;
        self.statistics = Statistics::default();
        let Some(scales) = scales(&self.sides, times, x) else {
            return Ok(vec![0.0; times.len()]);
        };
        let motion = Motion {
            sides: Rc::clone(&self.sides),
            scales,
            half_clearance: self.half_clearance,
            mode: Mode::Clearance { piston: x[0] },
            statistics: Statistics::default(),
        };
        let (forces, statistics) = run(motion, times, x, solver, is_cancelled)?;
        self.statistics = statistics;
        Ok(forces)
    }

    /// Laws of extension and compression.
    pub(crate) fn sides(&self) -> &[Side; 2] {
        &self.sides
    }

    /// Force at which the stronger side yields (N).
    pub(crate) fn force_limit_n(&self) -> f64 {
        self.sides[0].yield_force.max(self.sides[1].yield_force)
    }

    /// Statistics of the last run.
    pub fn statistics(&self) -> Statistics {
        self.statistics
    }

    /// Returns the force (N) at a constant velocity (m/s) after the springs have settled; both are signed.
    ///
    /// The force is the seal friction plus `A P`, where `v(P)` is the velocity, up to the force at which the damper
    /// yields. At velocity 0 the result is 0, although any force up to the one that starts the piston is possible.
    pub fn static_force(&self, velocity_m_per_s: f64) -> f64 {
        if velocity_m_per_s == 0.0 {
            return 0.0;
        }
        let side = &self.sides[usize::from(velocity_m_per_s < 0.0)];
        let coordinate = side.coordinate_at(velocity_m_per_s.abs());
        side.force(coordinate).copysign(velocity_m_per_s)
    }
}

/// Runs the chain over the whole motion unless it is cancelled.
fn run(
    mut motion: Motion,
    times: &[f64],
    x: &[f64],
    solver: &mut dyn Integrator,
    is_cancelled: &dyn Fn() -> bool,
) -> Result<(Vec<f64>, Statistics), ReferenceError> {
    let mut forces = Vec::with_capacity(times.len());
    forces.push(motion.force(x[0]));
    for i in 1..times.len() {
        if i % PIECES_PER_CHECK == 0 && is_cancelled() {
            return Err(ReferenceError::Cancelled);
        }
        let piece = Piece {
            start: x[i - 1],
            end: x[i],
            duration: times[i] - times[i - 1],
        };
        motion
            .follow(&piece, solver)
            .map_err(|error| ReferenceError::Piece {
                start_s: times[i - 1],
                end_s: times[i],
                source: Box::new(error),
            })?;
        forces.push(motion.force(x[i]));
    }
    motion.statistics.steps = solver.steps();
    Ok((forces, motion.statistics))
}

/// Scales of a motion: its RMS velocity and a typical force of each side. This force is the smaller of two: the force
/// at the RMS velocity, and the force that stretches the springs by the RMS displacement. `None` if nothing moves.
fn scales(sides: &[Side; 2], times: &[f64], x: &[f64]) -> Option<Scales> {
    let duration = times[times.len() - 1] - times[0];
    let (mut velocity, mut amplitude) = (0.0, 0.0);
    for (t, x) in times.windows(2).zip(x.windows(2)) {
        velocity += (x[1] - x[0]).powi(2) / (t[1] - t[0]);
    }
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    for x in x {
        amplitude += (x - mean).powi(2);
    }
    let velocity = (velocity / duration).sqrt();
    let amplitude = (amplitude / x.len() as f64).sqrt();
    if !(velocity > 0.0 && amplitude > 0.0) {
        return None;
    }
    let coordinate = [0, 1].map(|i| {
        let side: &Side = &sides[i];
        let elastic = side.coordinate_stretched(side.closed_stretch + amplitude);
        side.coordinate_at(velocity).min(elastic)
    });
    let stretch = [0, 1]
        .map(|i| sides[i].stretch(sides[i].force(coordinate[i])) - sides[i].closed_stretch)
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    Some(Scales {
        velocity,
        coordinate,
        time: stretch / velocity,
        stretch,
    })
}

fn check_samples(times: &[f64], x: &[f64]) -> Result<(), ReferenceError> {
    if times.is_empty() || times.len() != x.len() {
        return Err(ReferenceError::Lengths {
            times: times.len(),
            displacements: x.len(),
        });
    }
    if let Some(i) = (0..times.len()).find(|i| !(times[*i].is_finite() && x[*i].is_finite())) {
        return Err(ReferenceError::Sample {
            sample: i,
            time_s: times[i],
            displacement_m: x[i],
        });
    }
    if let Some(i) = times.windows(2).position(|t| t[1] <= t[0]) {
        return Err(ReferenceError::Times {
            sample: i + 1,
            time_s: times[i + 1],
            before_s: times[i],
        });
    }
    Ok(())
}
