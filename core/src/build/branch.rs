//! One branch of the element, extension or compression: the velocity law and its series chain.

use heapless::Vec;

use super::root::bracketed_root;
use crate::hydraulics::HydraulicSide;
use crate::math::elementary::sqrt;
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
    fn compliance(&self, force: f64) -> f64 {
        let oil = match (&self.column, &self.law) {
            (Some((column, volume)), Law::Physical(side)) if force >= side.laws.friction_n => {
                volume / (side.area() * side.area())
                    * column.compressibility_per_pa(side.pressure_pa(force))
            }
            _ => 0.0,
        };
        self.mount_compliance + oil
    }

    /// Force beyond friction over the deflection beyond friction's (N/m), at friction the limit of it.
    pub(crate) fn secant_stiffness(&self, force: f64) -> f64 {
        let friction = self.friction();
        let deflection = self.deflection(force) - friction * self.mount_compliance;
        if force > friction && deflection > 0.0 {
            (force - friction) / deflection
        } else {
            1.0 / self.compliance(friction)
        }
    }

    /// Force at the end of an implicit stage (N): `delta(F) + g v_h(F) = reach`, at most the limit.
    pub(crate) fn stage_force(&self, reach: f64, stage_s: f64) -> f64 {
        if reach >= self.reach(self.force_limit, stage_s) {
            return self.force_limit;
        }
        bracketed_root(0.0, self.force_limit, |force| {
            self.reach(force, stage_s) - reach
        })
    }

    /// `delta(F) + g v_h(F)` (m).
    pub(crate) fn reach(&self, force: f64, stage_s: f64) -> f64 {
        self.deflection(force) + stage_s * self.velocity(force)
    }

    /// Flow potential `H(F) = integral of v_h over delta from 0 to F` (m^2/s).
    pub(crate) fn flow_potential(&self, force: f64) -> f64 {
        /// Five-point Gauss-Legendre rule on [-1, 1] (Abramowitz and Stegun 25.4.29).
        const RULE: [(f64, f64); 5] = [
            (-0.906_179_845_938_664, 0.236_926_885_056_189),
            (-0.538_469_310_105_683, 0.478_628_670_499_366),
            (0.0, 0.568_888_888_888_889),
            (0.538_469_310_105_683, 0.478_628_670_499_366),
            (0.906_179_845_938_664, 0.236_926_885_056_189),
        ];
        const PANELS: u32 = 12;
        let start = self.friction();
        if force <= start {
            return 0.0;
        }
        // In the root of the force the integrand is smooth at the start.
        let width = sqrt(force - start) / f64::from(PANELS);
        let mut sum = 0.0;
        for panel in 0..PANELS {
            for (node, weight) in RULE {
                let root = width * (f64::from(panel) + 0.5 + 0.5 * node);
                let at = start + root * root;
                sum += weight * self.velocity(at) * self.compliance(at) * root;
            }
        }
        sum * width
    }

    /// Stretch `beta^2/(4 alpha)` (m) of a stage `alpha s^2 + beta s` at low pressure, s its root: below
    /// it the orifice's root law rules, above it the springs.
    pub(crate) fn knee(&self, stage_s: f64) -> f64 {
        match &self.law {
            Law::Physical(side) => {
                let beta = stage_s * side.orifice_velocity_per_root_pressure();
                let start = self.friction();
                let alpha =
                    self.compliance(start + 1e-6 * (self.force_limit - start)) * side.area();
                0.25 * beta * beta / alpha
            }
            Law::Reduced(_) => 0.0,
        }
    }

    /// Forces (N) at which `v_h` has a corner.
    pub(crate) fn corners(&self) -> Vec<f64, 8> {
        match &self.law {
            Law::Physical(side) => side.corners(),
            Law::Reduced(_) => Vec::new(),
        }
    }
}
