//! Builds constants from parameters. Building can fail and takes time; it allocates nothing.

mod branch;
mod checked;
mod fit;
mod knots;
mod span;

pub(crate) use branch::Branch;
use branch::Law;
pub use checked::CheckedParameters;
pub(crate) use checked::ElementLaws;
use span::Stage;

use crate::bins::DOUBLINGS;
use crate::damper::Damper;
use crate::error::BuildError;
use crate::hydraulics::HydraulicSide;
use crate::parameters::{DamperParameters, Mount, OilColumn, STEP_ALLOWED, STEP_RANGE_S};
use crate::real::Real;
use crate::scalars::{MAX_BOUND_M, Scalars};
use crate::table::PIECES;

impl DamperParameters {
    /// Checks the parameters and builds the damper: [`Self::check`], then [`CheckedParameters::build`].
    ///
    /// # Errors
    /// The first field that is out of range, with the range.
    pub fn build<T: Real>(&self, step_s: f64) -> Result<Damper<T>, BuildError> {
        self.check()?.build(step_s)
    }
}

impl CheckedParameters {
    /// Builds the constants of this damper for a fixed step (s).
    ///
    /// The work is bounded (a few thousand evaluations of the flow laws) and allocates nothing. Run it on the host or
    /// outside the tick.
    ///
    /// # Errors
    /// A step outside [`STEP_RANGE_S`], or springs so stiff that a number of the table is not finite.
    pub fn build<T: Real>(&self, step_s: f64) -> Result<Damper<T>, BuildError> {
        if !STEP_RANGE_S.contains(&step_s) {
            return Err(BuildError::new("step", "step_s", step_s, STEP_ALLOWED));
        }
        let branches = self.branches();
        let damper: Damper<T> = self.assemble(&branches, step_s);
        if !damper.is_finite() {
            let key = Mount::RANGES.stiffness_n_per_m.key;
            let allowed =
                "low enough that the table is finite; a larger limits.force_n or f64 also helps";
            return Err(BuildError::new(
                "mount",
                key,
                self.mount.stiffness_n_per_m,
                allowed,
            ));
        }
        #[cfg(feature = "log")]
        log::debug!(
            "built damper {:08x} for a step of {step_s} s",
            damper.revision()
        );
        Ok(damper)
    }

    /// Returns the branches of extension and compression.
    pub(crate) fn branches(&self) -> [Branch<'_>; 2] {
        match &self.laws {
            ElementLaws::Physical(laws) => [false, true].map(|compression| {
                let volume = |column: OilColumn| {
                    let volume = if compression {
                        column.piston_side_volume_m3
                    } else {
                        column.rod_side_volume_m3
                    };
                    (column, volume)
                };
                let law = Law::Physical(HydraulicSide { laws, compression });
                self.branch(law, laws.density.column.map(volume), self.limits.force_n)
            }),
            ElementLaws::Reduced(reduced) => {
                let saturation = reduced.damping_n_s_per_m * reduced.saturation_velocity_m_per_s;
                let limit = saturation.min(self.limits.force_n);
                [self.branch(Law::Reduced(*reduced), None, limit); 2]
            }
        }
    }

    fn branch<'a>(
        &self,
        law: Law<'a>,
        column: Option<(OilColumn, f64)>,
        force_limit: f64,
    ) -> Branch<'a> {
        Branch {
            law,
            mount_compliance: self.mount.compliance_m_per_n(),
            column,
            force_limit,
        }
    }

    /// Samples both branches into a table.
    fn assemble<T: Real>(&self, branches: &[Branch<'_>; 2], step_s: f64) -> Damper<T> {
        let max_move = self.limits.rate_m_per_s * step_s;
        // The last stage reaches at most `sqrt(2) * (largest stretch) + max_move`. A step that passes the yield point
        // ends beyond it by at most an eighth of the step's travel.
        let yields = branches.map(|branch| branch.deflection(branch.force_limit));
        let reach = 1.5 * (1.2 * yields[0].max(yields[1]) + 0.2 * max_move) + max_move;
        let first_knot = first_knot(reach);
        let mut table = T::ZERO_TABLE;
        let sides = table.pieces.chunks_exact_mut(PIECES);
        for ((branch, direction), pieces) in branches.iter().zip([1.0, -1.0]).zip(sides) {
            knots::write(&Stage::new(branch, step_s, first_knot), direction, pieces);
        }
        T::index(&mut table);
        let span = position_span(max_move);
        let half_clearance = T::from_f64(0.5 * self.mount.clearance_m);
        // Friction holds the piston until the mount has this stretch, which is the same on both sides.
        let held = T::from_f64(branches[0].held());
        let mut scalars = Scalars {
            step_s: T::from_f64(step_s),
            half_clearance,
            held,
            offset: half_clearance + held,
            first_knot: T::from_f64(first_knot),
            half_force_limit: T::from_f64(
                0.5 * branches[0].force_limit.max(branches[1].force_limit),
            ),
            move_bound: T::from_f64(max_move.min(MAX_BOUND_M)).doubled_bits(),
            position_rounder: T::from_f64(1.5 * span),
            // Twice the grid of positions, so that a stretch far below the grid is rounded to zero.
            rest_rounder: T::from_f64(2.0 * span * T::EPSILON),
            displacement_bound: T::from_f64(self.limits.displacement_m).doubled_bits(),
            stretch_bound: T::ZERO,
        };
        scalars.stretch_bound = scalars.computed_stretch_bound();
        Damper::new(scalars, table)
    }
}

/// Returns the power of two (m) at which a table must start, so that its doublings cover `reach` (m).
fn first_knot(reach: f64) -> f64 {
    let mut end = 1.0;
    while end < reach {
        end *= 2.0;
    }
    while 0.5 * end >= reach {
        end *= 0.5;
    }
    end / f64::from(1_u32 << DOUBLINGS)
}

/// Returns a power of two (m), the span, whose unit in the last place is the grid of positions.
///
/// Moves are at most half of the span. The span is at least 2^-7 m, which gives a grid of 2^-30 m in `f32`.
fn position_span(max_move: f64) -> f64 {
    let mut span = 1.0 / 128.0;
    while span < 2.0 * max_move {
        span *= 2.0;
    }
    span
}
