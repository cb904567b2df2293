//! One branch of the element (extension or compression): the velocity law and the springs in series.

use crate::hydraulics::{Chamber, Corners, HydraulicSide};
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
        let [velocity] = self.velocities([self.chamber(force)]);
        velocity
    }

    /// Velocities of the piston in the cylinder (m/s) for several chambers.
    #[inline(always)]
    pub(crate) fn velocities<const N: usize>(&self, chambers: [Chamber; N]) -> [f64; N] {
        match &self.law {
            Law::Physical(side) => side.velocities(chambers),
            Law::Reduced(reduced) => {
                chambers.map(|chamber| chamber.force_n / reduced.damping_n_s_per_m)
            }
        }
    }

    /// Returns the chamber under pressure at a force.
    #[inline(always)]
    pub(crate) fn chamber(&self, force: f64) -> Chamber {
        match &self.law {
            Law::Physical(side) => side.chamber(force),
            Law::Reduced(_) => Chamber::without_oil(force),
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
        self.deflection_of(&self.chamber(force))
    }

    /// [`Branch::deflection`] with the chamber at the force.
    #[inline(always)]
    pub(crate) fn deflection_of(&self, chamber: &Chamber) -> f64 {
        let oil = match (&self.column, &self.law) {
            (Some((column, volume)), Law::Physical(side)) => {
                volume / side.area()
                    * column.compression_with(chamber.pressure_pa, chamber.air_volume)
            }
            _ => 0.0,
        };
        chamber.force_n * self.mount_compliance + oil
    }

    /// Compliance of mount and oil column `d delta/dF` (m/N).
    #[inline(always)]
    pub(crate) fn compliance(&self, chamber: &Chamber) -> f64 {
        let oil = match (&self.column, &self.law) {
            (Some((column, volume)), Law::Physical(side))
                if chamber.force_n >= side.laws.friction_n =>
            {
                volume / (side.area() * side.area())
                    * column.compressibility_with(chamber.pressure_pa, chamber.air_volume)
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
    #[inline(always)]
    pub(crate) fn secant_stiffness(&self, chamber: &Chamber, deflection: f64) -> f64 {
        if deflection > 0.0 {
            chamber.force_n / deflection
        } else {
            1.0 / self.compliance(chamber)
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
