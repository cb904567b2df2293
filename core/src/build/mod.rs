//! Parameters to constants: everything that may fail, allocate nothing and take its time.

mod branch;
mod fit;
mod grid;
pub(crate) mod root;

use branch::{Branch, Law};
use grid::Grid;
use heapless::Vec;

use crate::damper::{Damper, IMPLICIT_SHARE, Scalars};
use crate::error::{BuildError, require};
use crate::hydraulics::{HydraulicSide, Laws};
use crate::math::Real;
use crate::parameters::{DamperParameters, Element, Limits, Mount, OilColumn, Reduced};
use crate::table::Piece;

/// Corners a table can align with.
type Corners = Vec<(f64, f64), 24>;

/// Weights of corners when a grid is aligned: a reduced element yields in every run, a physical one at
/// a limit it hardly meets.
const VALVE_WEIGHT: f64 = 1.0;
const LIMIT_WEIGHT: f64 = 1e-3;

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

    /// Samples both branches into tables.
    fn assemble<T: Real>(&self, branches: &[Branch<'_>; 2], step_s: f64) -> Damper<T> {
        let stage_s = IMPLICIT_SHARE * step_s;
        let largest_move = self.limits.rate_m_per_s * step_s;
        // Friction holds the piston until the mount, alike on both sides, has this stretch.
        let held = branches[0].friction() * branches[0].mount_compliance;
        let yields = branches.map(|branch| branch.deflection(branch.force_limit));
        let yield_largest = yields[0].max(yields[1]);

        let mut stage_corners = Corners::new();
        let mut output_corners = Corners::new();
        for branch in branches {
            for corner in branch.corners() {
                if corner < branch.force_limit {
                    // Capacity 24 exceeds both branches' corners.
                    let _ =
                        stage_corners.push((branch.reach(corner, stage_s) - held, VALVE_WEIGHT));
                }
            }
            let yields = branch.reach(branch.force_limit, stage_s) - held;
            let _ = stage_corners.push((yields, LIMIT_WEIGHT));
            let yields = branch.deflection(branch.force_limit) - held;
            let _ = output_corners.push((yields, LIMIT_WEIGHT));
        }
        // The last stage looks at most sqrt(2) times the largest stretch past a move; the end of
        // a step lies at most an eighth of its travel beyond yield.
        let output_reach = 1.2 * yield_largest + 0.2 * largest_move;
        let stage_reach = 1.5 * output_reach + largest_move;
        let knee = branches
            .iter()
            .map(|branch| branch.knee(stage_s))
            .fold(0.0, f64::max);
        let stage_grid = Grid::aligned(stage_reach, knee, &stage_corners);
        let output_grid = Grid::aligned(output_reach, 0.0, &output_corners);

        let side = |compression: bool| if compression { -1.0 } else { 1.0 };
        let at = |compression: bool, y: f64| {
            let branch = &branches[usize::from(compression)];
            let reach = stage_grid.stretch(y) + held;
            (branch, reach, branch.stage_force(reach, stage_s))
        };
        let flow = fit::cubics(|compression, y| {
            let (branch, reach, force) = at(compression, y);
            side(compression)
                * if force < branch.force_limit {
                    stage_s * branch.velocity(force)
                } else {
                    reach - branch.deflection(force)
                }
        });
        let potential = fit::cubics(|compression, y| {
            let (branch, _, force) = at(compression, y);
            step_s * branch.flow_potential(force)
        });
        let output = fit::cubics(|compression, y| {
            let branch = &branches[usize::from(compression)];
            let force = branch.force(output_grid.stretch(y) + held);
            // A rounding below the limit, so that no piece exceeds it.
            let highest = branch.force_limit * (1.0 - 8.0 * T::EPSILON);
            side(compression) * (force.min(highest) - branch.friction()).max(0.0)
        });
        let stage = core::array::from_fn(|place| Piece {
            flow: flow[place],
            potential: potential[place],
        });
        let stage_shift = T::from_f64(stage_grid.shift);
        Damper::new(
            Scalars {
                step_s: T::from_f64(step_s),
                half_clearance: T::from_f64(0.5 * self.mount.clearance_m),
                held: T::from_f64(held),
                yield_stretch: T::from_f64(yields[0].min(yields[1]) * (1.0 - 1e-5)),
                force_limit: T::from_f64(branches[0].force_limit.max(branches[1].force_limit)),
                largest_move: T::from_f64(largest_move),
                stage_scale: T::from_f64(stage_grid.scale),
                stage_shift,
                stage_shift_root: stage_shift.square_root(),
                output_scale: T::from_f64(output_grid.scale),
                mount_stiffness: T::from_f64(1.0 / branches[0].mount_compliance),
            },
            stage,
            output,
        )
    }
}

fn validate_mount(mount: &Mount) -> Result<(), BuildError> {
    let check = |field, value, valid, allowed| require("mount", field, value, valid, allowed);
    check(
        "stiffness_n_per_m",
        mount.stiffness_n_per_m,
        (1e4..=1e12).contains(&mount.stiffness_n_per_m),
        "1e4 to 1e12 N/m",
    )?;
    if let Some(stiffness) = mount.seat_stiffness_n_per_m {
        check(
            "seat_stiffness_n_per_m",
            stiffness,
            (1e4..=1e12).contains(&stiffness),
            "1e4 to 1e12 N/m",
        )?;
    }
    check(
        "clearance_m",
        mount.clearance_m,
        (0.0..=0.1).contains(&mount.clearance_m),
        "0 to 0.1 m",
    )
}

fn validate_limits(limits: &Limits) -> Result<(), BuildError> {
    let check = |field, value, valid, allowed| require("limits", field, value, valid, allowed);
    check(
        "force_n",
        limits.force_n,
        (1.0..=1e7).contains(&limits.force_n),
        "1 to 1e7 N",
    )?;
    check(
        "rate_m_per_s",
        limits.rate_m_per_s,
        (1e-3..=100.0).contains(&limits.rate_m_per_s),
        "1e-3 to 100 m/s",
    )
}

fn validate_reduced(reduced: &Reduced) -> Result<(), BuildError> {
    let check = |field, value, valid, allowed| require("reduced", field, value, valid, allowed);
    check(
        "damping_n_s_per_m",
        reduced.damping_n_s_per_m,
        (1.0..=1e9).contains(&reduced.damping_n_s_per_m),
        "1 to 1e9 N s/m",
    )?;
    check(
        "saturation_velocity_m_per_s",
        reduced.saturation_velocity_m_per_s,
        (1e-6..=100.0).contains(&reduced.saturation_velocity_m_per_s),
        "1e-6 to 100 m/s",
    )
}
