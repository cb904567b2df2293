//! Parameters to constants: everything that may fail, allocate nothing and take its time.

mod branch;
mod fit;
mod knots;
pub(crate) mod root;
mod span;

use branch::{Branch, Law};
use span::Stage;

use crate::damper::Damper;
use crate::error::{BuildError, require, require_ranges};
use crate::hydraulics::{HydraulicSide, Laws};
use crate::math::Real;
use crate::parameters::{
    DamperParameters, Element, LARGEST_CLEARANCE_M, LARGEST_FORCE_N, Limits, Mount, OilColumn,
    Reduced,
};
use crate::scalars::Scalars;
use crate::table::{DOUBLINGS, PIECES};

/// The laws of an element, checked and ready to evaluate.
#[allow(clippy::large_enum_variant)] // one per damper, never in an array
pub(crate) enum ElementLaws {
    /// Hydraulics.
    Physical(Laws),
    /// Damping coefficient and saturation velocity.
    Reduced(Reduced),
}

impl DamperParameters {
    /// Checks every parameter.
    ///
    /// # Errors
    /// The first field out of its range, with the range.
    pub fn validate(&self) -> Result<(), BuildError> {
        self.laws().map(drop)
    }

    /// The laws of the element, every parameter checked.
    pub(crate) fn laws(&self) -> Result<ElementLaws, BuildError> {
        validate_mount(&self.mount)?;
        validate_limits(&self.limits)?;
        match &self.element {
            Element::Physical(hydraulics) => {
                let laws = Laws::new(hydraulics)?;
                require(
                    "limits",
                    "force_n",
                    self.limits.force_n,
                    self.limits.force_n > 2.0 * laws.friction_n,
                    "above twice seal.friction_n",
                )?;
                Ok(ElementLaws::Physical(laws))
            }
            Element::Reduced(reduced) => {
                validate_reduced(reduced)?;
                Ok(ElementLaws::Reduced(*reduced))
            }
        }
    }

    /// The constants of this damper for a fixed step (s).
    ///
    /// Bounded work (some thousand evaluations of the flow laws), no allocation; run it on the
    /// host or outside the tick.
    ///
    /// # Errors
    /// The first field out of its range, with the range.
    pub fn build<T: Real>(&self, step_s: f64) -> Result<Damper<T>, BuildError> {
        require(
            "step",
            "step_s",
            step_s,
            (1e-6..=2e-2).contains(&step_s),
            "1e-6 to 2e-2 s",
        )?;
        let damper = match &self.laws()? {
            ElementLaws::Physical(laws) => {
                let branch = |compression: bool| {
                    let volume = |column: OilColumn| {
                        let volume = if compression {
                            column.piston_side_volume_m3
                        } else {
                            column.rod_side_volume_m3
                        };
                        (column, volume)
                    };
                    let law = Law::Physical(HydraulicSide { laws, compression });
                    self.branch(law, laws.oil.column.map(volume), self.limits.force_n)
                };
                self.assemble(&[branch(false), branch(true)], step_s)
            }
            ElementLaws::Reduced(reduced) => {
                let saturation = reduced.damping_n_s_per_m * reduced.saturation_velocity_m_per_s;
                let limit = saturation.min(self.limits.force_n);
                let branch = self.branch(Law::Reduced(*reduced), None, limit);
                self.assemble(&[branch, branch], step_s)
            }
        };
        #[cfg(feature = "log")]
        log::debug!("built damper {:08x} for {step_s} s", damper.revision());
        Ok(damper)
    }

    fn branch<'a>(
        &self,
        law: Law<'a>,
        column: Option<(OilColumn, f64)>,
        force_limit: f64,
    ) -> Branch<'a> {
        let seat = self.mount.seat_stiffness_n_per_m;
        Branch {
            law,
            mount_compliance: 1.0 / self.mount.stiffness_n_per_m
                + seat.map_or(0.0, |stiffness| 1.0 / stiffness),
            column,
            force_limit,
        }
    }

    /// Samples both branches into a table.
    fn assemble<T: Real>(&self, branches: &[Branch<'_>; 2], step_s: f64) -> Damper<T> {
        let largest_move = self.limits.rate_m_per_s * step_s;
        // The last stage looks at most sqrt(2) times the largest stretch past a move; the end of
        // a step lies at most an eighth of its travel beyond yield.
        let yields = branches.map(|branch| branch.deflection(branch.force_limit));
        let reach = 1.5 * (1.2 * yields[0].max(yields[1]) + 0.2 * largest_move) + largest_move;
        let first_knot = first_knot(reach);
        let mut table = T::ZERO_TABLE;
        let (extension, compression) = table.pieces.split_at_mut(PIECES);
        for (branch, direction, pieces) in [
            (&branches[0], 1.0, extension),
            (&branches[1], -1.0, compression),
        ] {
            knots::write(&Stage::new(branch, step_s, first_knot), direction, pieces);
        }
        T::index(&mut table);
        let span = position_span(largest_move);
        let half_clearance = T::from_f64(0.5 * self.mount.clearance_m);
        // Friction holds the piston until the mount, alike on both sides, has this stretch.
        let held = T::from_f64(branches[0].held());
        let scalars = Scalars {
            step_s: T::from_f64(step_s),
            half_clearance,
            held,
            offset: half_clearance + held,
            first_knot: T::from_f64(first_knot),
            half_force_limit: T::from_f64(
                0.5 * branches[0].force_limit.max(branches[1].force_limit),
            ),
            largest_move: T::from_f64(largest_move),
            position_rounder: T::from_f64(1.5 * span),
            // Twice the grid of positions.
            rest_rounder: T::from_f64(2.0 * span * T::EPSILON),
        };
        Damper::new(scalars, table)
    }
}

/// The power of two (m) from which the doublings of a table go beyond `reach`.
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

/// Span (m) over which the unit in the last place is the grid of positions: moves are at most half of
/// it, and it is at least 2^-7 m, a grid of 2^-30 m in `f32`.
fn position_span(largest_move: f64) -> f64 {
    let mut span = 1.0 / 128.0;
    while span < 2.0 * largest_move {
        span *= 2.0;
    }
    span
}

fn validate_mount(mount: &Mount) -> Result<(), BuildError> {
    require_ranges!("mount", mount; stiffness_n_per_m in 1e4..=1e12, "1e4 to 1e12 N/m";)?;
    if let Some(stiffness) = mount.seat_stiffness_n_per_m {
        require(
            "mount",
            "seat_stiffness_n_per_m",
            stiffness,
            (1e4..=1e12).contains(&stiffness),
            "1e4 to 1e12 N/m",
        )?;
    }
    require_ranges!("mount", mount; clearance_m in 0.0..=LARGEST_CLEARANCE_M, "0 to 0.1 m";)
}

fn validate_limits(limits: &Limits) -> Result<(), BuildError> {
    require_ranges!("limits", limits;
        force_n in 1.0..=LARGEST_FORCE_N, "1 to 1e7 N";
        rate_m_per_s in 1e-3..=100.0, "1e-3 to 100 m/s";
    )
}

fn validate_reduced(reduced: &Reduced) -> Result<(), BuildError> {
    require_ranges!("reduced", reduced;
        damping_n_s_per_m in 1.0..=1e9, "1 to 1e9 N s/m";
        saturation_velocity_m_per_s in 1e-6..=100.0, "1e-6 to 100 m/s";
    )
}
