//! One branch of the element, extension or compression: the velocity law and its series chain.

use heapless::Vec;

use crate::characteristic::Corner;
use crate::hydraulics::HydraulicSide;
use crate::parameters::{OilColumn, Reduced};

/// The velocity law `v_h(F)` of one branch.
#[derive(Clone, Copy)]
pub(crate) enum Law<'a> {
    Physical(HydraulicSide<'a>),
    Reduced(Reduced),
}

/// A branch: all functions take the force magnitude (N) up to `force_limit`.
#[derive(Clone, Copy)]
pub(crate) struct Branch<'a> {
    pub(crate) law: Law<'a>,
    /// `1/K_rubber + 1/K_seat` (m/N).
    pub(crate) mount_compliance: f64,
    /// Oil column and its volume (m^3).
    pub(crate) column: Option<(OilColumn, f64)>,
    /// The branch yields at this force (N).
    pub(crate) force_limit: f64,
}

impl Branch<'_> {
    /// `v_h(F)` (m/s).
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

    /// Shortening of the chain `delta(F)` (m): mount and oil column, the latter under the oil's
    /// gauge pressure.
    pub(crate) fn deflection(&self, force: f64) -> f64 {
        let oil = match (&self.column, &self.law) {
            (Some((column, volume)), Law::Physical(side)) => {
                volume / side.area() * column.compression(side.pressure_pa(force))
            }
            _ => 0.0,
        };
        force * self.mount_compliance + oil
    }

    /// `d delta/dF` (m/N).
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

    /// Deflection up to which the piston is held (m).
    pub(crate) fn held(&self) -> f64 {
        self.friction() * self.mount_compliance
    }

    /// Force over deflection (N/m), without force the limit of it.
    pub(crate) fn secant_stiffness(&self, force: f64, deflection: f64) -> f64 {
        if deflection > 0.0 {
            force / deflection
        } else {
            1.0 / self.compliance(force)
        }
    }

    /// Corners of `v_h`, with their forces (N) below the limit.
    pub(crate) fn corners(&self) -> Vec<(Corner, f64), 8> {
        match &self.law {
            Law::Physical(side) => side.corners(self.force_limit),
            Law::Reduced(_) => Vec::new(),
        }
    }
}
