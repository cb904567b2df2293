//! Compression with the pressures of both chambers.
//!
//! Pressures are gauge (Pa). Flows (m^3/s) and velocities (m/s) are positive in compression. The working
//! pressure is `F/A_comp` after the seal friction has been subtracted from the force.

use super::bracket::increasing_root;
use super::paths::{Areas, Foot, PistonPaths};

/// Compression with both chamber pressures, `P_1` on the piston side and `P_2` on the rod side:
/// `A_ext v = Q_piston(P_1 - P_2)`, `A_rod v = Q_foot(P_1)`, `F = P_1 A_comp - P_2 A_ext`;
/// at `P_2 = p_vap` only the sum of the two balances holds.
#[derive(Clone, Debug)]
pub(super) struct TwoChambers {
    pub(super) piston: PistonPaths,
    pub(super) foot: Foot,
    pub(super) areas: Areas,
    /// Lowest gauge pressure of the rod side (Pa).
    pub(super) vapour: f64,
}

impl TwoChambers {
    /// Force up to which neither the foot valve nor the piston passes oil, if the rod side does not boil (N).
    fn closed_force(&self) -> f64 {
        self.areas.rod * self.foot.closed_up_to()
            + self.areas.extension * self.piston.closed_up_to()
    }

    pub(super) fn closed_up_to(&self) -> f64 {
        let (foot, piston) = (self.foot.closed_up_to(), self.piston.closed_up_to());
        let force = if foot - piston >= self.vapour {
            self.closed_force()
        } else {
            // The rod side boils first; the piston paths open against its vapour pressure.
            let upstream = self.vapour + piston;
            upstream * self.areas.compression - self.vapour * self.areas.extension
        };
        force.max(0.0) / self.areas.compression
    }

    /// Piston velocity (m/s) at the working pressure `closed + above` (Pa).
    pub(super) fn velocity(&self, closed: f64, above: f64) -> f64 {
        match self.split(closed, above) {
            Some((foot_excess, drop)) => self.through(drop, self.foot.closed_up_to(), foot_excess),
            None => {
                let upstream =
                    closed + above + self.vapour * self.areas.extension / self.areas.compression;
                self.through(upstream - self.vapour, upstream, 0.0)
            }
        }
    }

    /// Piston velocity (m/s) from both flows at the piston-side pressure `base + over` (Pa).
    fn through(&self, drop: f64, base: f64, over: f64) -> f64 {
        let density = self.piston.fluid.density(base + over);
        (self.piston.flow(drop, base + over) + self.foot.flow(base, over, density))
            / self.areas.compression
    }

    /// Splits a working pressure into the excess over the foot valve's opening pressure and the pressure drop over the
    /// piston; `None` if the rod side boils.
    fn split(&self, closed: f64, above: f64) -> Option<(f64, f64)> {
        let Areas {
            extension,
            compression,
            rod,
        } = self.areas;
        let (foot, piston) = (self.foot.closed_up_to(), self.piston.closed_up_to());
        let excess = (closed * compression - self.closed_force()) + above * compression;
        if excess < 0.0 {
            return None;
        }
        // The search is for the smaller part of the excess, so that neither part is a difference of nearly equal
        // numbers. Where a valve opens, both flows are smooth functions of the square root of its part.
        let half = 0.5 * excess;
        let (over, drop) = if self.imbalance(piston + half / extension, foot, half / rod) >= 0.0 {
            let parts = |root: f64| {
                let over = root * root;
                (over, piston + (excess - rod * over) / extension)
            };
            parts(increasing_root(0.0, (half / rod).sqrt(), |root| {
                let (over, drop) = parts(root);
                self.imbalance(drop, foot, over)
            }))
        } else {
            let parts = |root: f64| {
                let share = root * root;
                ((excess - extension * share) / rod, piston + share)
            };
            parts(increasing_root(0.0, (half / extension).sqrt(), |root| {
                let (over, drop) = parts(root);
                -self.imbalance(drop, foot, over)
            }))
        };
        (foot + over - drop >= self.vapour).then_some((over, drop))
    }

    /// Flow through the foot valve minus the flow that the rod displaces, times `A_ext`.
    fn imbalance(&self, drop: f64, base: f64, over: f64) -> f64 {
        let density = self.piston.fluid.density(base + over);
        self.areas.extension * self.foot.flow(base, over, density)
            - self.areas.rod * self.piston.flow(drop, base + over)
    }

    /// Working pressures up to `limit` at which a piston valve opens, or the rod side starts or stops boiling.
    pub(super) fn kinks(&self, limit: f64) -> Vec<f64> {
        let Areas {
            extension,
            compression,
            rod,
        } = self.areas;
        let base = self.foot.closed_up_to();
        let mut kinks: Vec<f64> = self
            .piston
            .openings()
            .map(|drop| {
                let max = limit * compression / rod;
                let over = increasing_root(0.0, max, |over| self.imbalance(drop, base, over));
                let upstream = (base + over).max(drop + self.vapour);
                (upstream * compression - (upstream - drop).max(self.vapour) * extension)
                    / compression
            })
            .collect();
        let closed = self.closed_up_to();
        let boils = |above: f64| self.split(closed, above).is_none();
        let scan = |i: u32| (limit - closed).max(0.0) * (f64::from(i) / 400.0).powi(2);
        for i in 1..=400 {
            let (mut low, mut high) = (scan(i - 1), scan(i));
            let before = boils(low);
            if before != boils(high) {
                for _ in 0..100 {
                    let middle = 0.5 * (low + high);
                    if boils(middle) == before {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                kinks.push(closed + high);
            }
        }
        kinks
    }
}

#[cfg(test)]
mod tests {
    use dashpot_core::parameters::{Geometry, Hydraulics, Oil, Orifice, Valve, Valves};

    use super::*;

    fn chambers() -> TwoChambers {
        let valve = Valve::with_edge_compliance(0.016, 0.029, 1e-11, 0.6);
        let foot = valve.clone().preload_pa(7e4);
        let hydraulics = Hydraulics::new(
            Geometry::new(0.057, 0.092),
            Orifice::new(2e-3, 0.76),
            Valves::new(valve.clone(), valve.clone(), foot),
            Oil::new(860.0),
        );
        let areas = Areas::new(&hydraulics);
        TwoChambers {
            piston: PistonPaths::new(&hydraulics, &valve),
            foot: Foot::new(&hydraulics, areas.rod),
            areas,
            vapour: -6e4,
        }
    }

    /// A small excess goes almost wholly to the foot valve. The drop over the piston must not lose its digits, or the
    /// velocity has noise that the solver follows with tiny steps.
    #[test]
    fn velocity_at_a_small_excess_is_smooth() {
        let chambers = chambers();
        let closed = chambers.closed_up_to();
        let relative = 1e-6;
        for above in (-8..=2).map(|exponent| 10f64.powi(exponent)) {
            let velocity = |above| chambers.velocity(closed, above);
            let growth = velocity(above * (1.0 + relative)) / velocity(above) - 1.0;
            assert!(
                (0.4 * relative..1.6 * relative).contains(&growth),
                "{above} Pa: {growth:e}"
            );
        }
    }
}
