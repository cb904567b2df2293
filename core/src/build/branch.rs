//! One branch of the element (extension or compression): the velocity law and the springs in series.

use crate::hydraulics::{Corners, HydraulicSide};
use crate::parameters::{OilColumn, Reduced};

/// The velocity law `v_h(F)` of one branch.
#[derive(Clone, Copy)]
pub(crate) enum Law<'a> {
    Physical(HydraulicSide<'a>),
    Reduced(Reduced),
}

/// One branch. All functions take a force magnitude (N) up to `force_limit`.
#[derive(Clone, Copy)]
pub(crate) struct Branch<'a> {
    pub(crate) law: Law<'a>,
    /// Compliance `1/K_rubber + 1/K_seat` (m/N).
    pub(crate) mount_compliance: f64,
    /// Oil column and volume of the chamber under pressure (m^3).
    pub(crate) column: Option<(OilColumn, f64)>,
    /// Force at which the branch yields (N).
    pub(crate) force_limit: f64,
}

impl Branch<'_> {
    /// Velocity `v_h(F)` of the piston in the cylinder (m/s).
    pub(crate) fn velocity(&self, force: f64) -> f64 {
        match &self.law {
            Law::Physical(side) => side.velocity(force),
            Law::Reduced(reduced) => force / reduced.damping_n_s_per_m,
        }
    }

    /// Force below which the piston does not move in the cylinder (N).
    pub(crate) fn friction(&self) -> f64 {
        match &self.law {
            Law::Physical(side) => side.laws.friction_n,
            Law::Reduced(_) => 0.0,
        }
    }

    /// Deflection `delta(F)` (m) of the mount plus that of the oil column under its gauge pressure.
    pub(crate) fn deflection(&self, force: f64) -> f64 {
        let oil = match (&self.column, &self.law) {
            (Some((column, volume)), Law::Physical(side)) => {
                volume / side.area() * column.compression(side.pressure_pa(force))
            }
            _ => 0.0,
        };
        force * self.mount_compliance + oil
    }

    /// Compliance of mount and oil column `d delta/dF` (m/N).
    pub(crate) fn compliance(&self, force: f64) -> f64 {
        let oil = match (&self.column, &self.law) {
            (Some((column, volume)), Law::Physical(side)) if force >= side.laws.friction_n => {
                volume / (side.area() * side.area())
                    * column.compressibility_per_pa(side.pressure_pa(force))
            }
            _ => 0.0,
        };
        self.mount_compliance + oil
    }

    /// Deflection up to which friction holds the piston (m).
    pub(crate) fn held(&self) -> f64 {
        self.friction() * self.mount_compliance
    }

    /// Ratio of force to deflection (N/m); at zero deflection, the limit of this ratio.
    pub(crate) fn secant_stiffness(&self, force: f64, deflection: f64) -> f64 {
        if deflection > 0.0 {
            force / deflection
        } else {
            1.0 / self.compliance(force)
        }
    }

    /// Corners of `v_h` below the force limit, with their forces (N).
    pub(crate) fn corners(&self) -> Corners {
        match &self.law {
            Law::Physical(side) => side.corners(self.force_limit),
            Law::Reduced(_) => Corners::new(),
        }
    }
}
