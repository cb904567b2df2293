//! Parameters to constants: everything that may fail, allocate nothing and take its time.

mod branch;
mod fit;
mod grid;
pub(crate) mod root;

use branch::{Branch, Law};
use grid::Grid;
use heapless::Vec;

use crate::damper::{Damper, IMPLICIT_SHARE, Scalars};
use crate::error::{BuildError, require, require_ranges};
use crate::hydraulics::{HydraulicSide, Laws};
use crate::math::Real;
use crate::parameters::{
    DamperParameters, Element, LARGEST_CLEARANCE_M, Limits, Mount, OilColumn, Reduced,
};
use crate::table::{PIECES, Piece};

/// Corners a table can align with.
type Corners = Vec<(f64, f64), 24>;

/// Weights of corners when a grid is aligned: a reduced element yields in every run, a physical one at
/// a limit it hardly meets.
const VALVE_WEIGHT: f64 = 1.0;
const LIMIT_WEIGHT: f64 = 1e-3;

/// Share by which the table's force exceeds the limit where the element yields, above rounding in `f32`.
const YIELD_MARGIN: f64 = 1e-5;

impl DamperParameters {
    /// Checks every parameter.
    ///
    /// # Errors
    /// The first field out of its range, with the range.
    pub fn validate(&self) -> Result<(), BuildError> {
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
                )
            }
            Element::Reduced(reduced) => validate_reduced(reduced),
        }
    }

    /// The constants of this damper for a fixed step (s).
    ///
    /// Bounded work (some ten thousand evaluations of the flow laws), no allocation; run it on the
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
        self.validate()?;
        let damper = match &self.element {
            Element::Physical(hydraulics) => {
                let laws = Laws::new(hydraulics)?;
                let branch = |compression: bool| {
                    let volume = |column: OilColumn| {
                        let volume = if compression {
                            column.piston_side_volume_m3
                        } else {
                            column.rod_side_volume_m3
                        };
                        (column, volume)
                    };
                    let law = Law::Physical(HydraulicSide {
                        laws: &laws,
                        compression,
                    });
                    self.branch(law, laws.oil.column.map(volume), self.limits.force_n)
                };
                self.assemble(&[branch(false), branch(true)], step_s)
            }
            Element::Reduced(reduced) => {
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
        let stage_s = IMPLICIT_SHARE * step_s;
        let largest_move = self.limits.rate_m_per_s * step_s;
        // Friction holds the piston until the mount, alike on both sides, has this stretch.
        let held = branches[0].friction() * branches[0].mount_compliance;
        let held_stiffness = if held > 0.0 {
            1.0 / branches[0].mount_compliance
        } else {
            0.0
        };

        let mut corners = Corners::new();
        for branch in branches {
            let forces = branch.corners();
            let met = forces.iter().filter(|&&force| force < branch.force_limit);
            let limit = (branch.force_limit, LIMIT_WEIGHT);
            for (force, weight) in met.map(|&force| (force, VALVE_WEIGHT)).chain([limit]) {
                // Capacity 24 exceeds both branches' corners.
                let _ = corners.push((branch.reach(force, stage_s) - held, weight));
            }
        }
        // The last stage looks at most sqrt(2) times the largest stretch past a move; the end of
        // a step lies at most an eighth of its travel beyond yield.
        let yields = branches.map(|branch| branch.deflection(branch.force_limit));
        let reach = 1.5 * (1.2 * yields[0].max(yields[1]) + 0.2 * largest_move) + largest_move;
        let knees = branches.map(|branch| branch.knee(stage_s));
        let grid = Grid::aligned(reach, knees[0].max(knees[1]), &corners);

        let at = |compression: bool, y: f64| {
            let branch = &branches[usize::from(compression)];
            let reach = grid.stretch(y) + held;
            (branch, reach, branch.stage_force(reach, stage_s))
        };
        let flow = fit::cubics(|compression, y| {
            let (branch, reach, force) = at(compression, y);
            let flow = if force < branch.force_limit {
                step_s * branch.velocity(force)
            } else {
                (reach - branch.deflection(force)) / IMPLICIT_SHARE
            };
            if compression { -flow } else { flow }
        });
        let potential = fit::cubics(|compression, y| {
            let (branch, _, force) = at(compression, y);
            step_s * branch.flow_potential(force)
        });
        let stiffness = fit::cubics(|compression, y| {
            let (branch, _, force) = at(compression, y);
            let secant = branch.secant_stiffness(force);
            if force < branch.force_limit {
                secant - held_stiffness
            } else {
                // A trace above the limit, to which the step then holds the force.
                (1.0 + YIELD_MARGIN) * secant - held_stiffness
            }
        });
        let shift = T::from_f64(grid.shift);
        let start = shift.square_root();
        let table = core::array::from_fn(|place| Piece {
            flow: flow[place],
            potential: potential[place],
            stiffness: stiffness[place],
            centre: start + T::from_f64((place % PIECES) as f64),
            padding: [T::ZERO; 3],
        });
        let span = position_span(largest_move);
        let half_clearance = T::from_f64(0.5 * self.mount.clearance_m);
        let held = T::from_f64(held);
        let scalars = Scalars {
            step_s: T::from_f64(step_s),
            half_clearance,
            held,
            offset: half_clearance + held,
            force_limit: T::from_f64(branches[0].force_limit.max(branches[1].force_limit)),
            largest_move: T::from_f64(largest_move),
            scale: T::from_f64(grid.scale),
            shift,
            origin: T::from_f64(768.5 - start.to_f64()),
            held_stiffness: T::from_f64(held_stiffness),
            position_rounder: T::from_f64(1.5 * span),
            // Twice the grid of positions.
            rest_rounder: T::from_f64(2.0 * span * T::EPSILON),
        };
        Damper::new(scalars, table)
    }
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
        force_n in 1.0..=1e7, "1 to 1e7 N";
        rate_m_per_s in 1e-3..=100.0, "1e-3 to 100 m/s";
    )
}

fn validate_reduced(reduced: &Reduced) -> Result<(), BuildError> {
    require_ranges!("reduced", reduced;
        damping_n_s_per_m in 1.0..=1e9, "1 to 1e9 N s/m";
        saturation_velocity_m_per_s in 1e-6..=100.0, "1e-6 to 100 m/s";
    )
}
