//! One working side of the damper: piston velocity as a function of force.

use heapless::Vec;

use super::corner::Corner;
use super::flow::Laws;
use super::two_chamber::{above_vapour_pa, compression_velocity, force_at_difference};
use crate::math::elementary::sqrt;
use crate::math::root::bracketed_root;

/// Corners of one side, with their forces (N). There is room for more corners than a side has.
pub(crate) type Corners = Vec<(Corner, f64), 8>;

/// Number of panels in the search for the start and the end of vapour. The panels have equal widths in the square root
/// of the force.
const VAPOUR_PANELS: u32 = 32;

/// Extension (rod-side chamber) or compression (piston-side chamber) of a physical damper.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HydraulicSide<'a> {
    pub(crate) laws: &'a Laws,
    pub(crate) compression: bool,
}

impl HydraulicSide<'_> {
    /// Area under pressure (m^2).
    pub(crate) fn area(&self) -> f64 {
        if self.compression {
            self.laws.piston_area
        } else {
            self.laws.rod_side_area
        }
    }

    /// Gauge pressure `P = (|F| - F_c)+ / A` (Pa).
    pub(crate) fn pressure_pa(&self, force_n: f64) -> f64 {
        (force_n - self.laws.friction_n).max(0.0) / self.area()
    }

    /// Velocity of the piston in the cylinder (m/s) under a force magnitude (N).
    pub(crate) fn velocity(&self, force_n: f64) -> f64 {
        let laws = self.laws;
        let pressure = self.pressure_pa(force_n);
        if pressure <= 0.0 {
            return 0.0;
        }
        if !self.compression {
            return laws.through_piston(false, pressure, pressure) / self.area();
        }
        if let Some(vapour) = laws.vapour_pressure_pa {
            return compression_velocity(laws, vapour, force_n - laws.friction_n);
        }
        (laws.through_piston(true, pressure, pressure) + laws.through_foot(pressure)) / self.area()
    }

    /// Returns the corners of the law below `limit_n` (N): opening valves, start and end of vapour.
    pub(crate) fn corners(&self, limit_n: f64) -> Corners {
        let laws = self.laws;
        let friction = laws.friction_n;
        let mut corners = Corners::new();
        let mut add = |corner: Corner, force: f64| {
            if force > 0.0 && force < limit_n - friction {
                // There is room for every corner.
                let _ = corners.push((corner, friction + force));
            }
        };
        let foot = laws.foot_opening_pa();
        let valve = if self.compression {
            &laws.compression
        } else {
            &laws.extension
        };
        let openings = [
            (Corner::PistonValveOpens, valve.preload_pa),
            (Corner::ReliefOpens, laws.relief_opening_pa.unwrap_or(0.0)),
        ];
        let openings = openings.into_iter().filter(|(_, opening)| *opening > 0.0);
        let Some(vapour) = laws.vapour_pressure_pa.filter(|_| self.compression) else {
            openings.for_each(|(corner, opening)| add(corner, opening * self.area()));
            if self.compression {
                add(Corner::FootValveOpens, foot * self.area());
            }
            return corners;
        };
        // Until the foot valve opens, nothing flows and both chambers have the same pressure. The force is therefore
        // this pressure times the rod area.
        add(Corner::FootValveOpens, foot * laws.rod_area());
        openings.for_each(|(corner, opening)| {
            add(corner, force_at_difference(laws, vapour, opening));
        });
        let above = |root: f64| above_vapour_pa(laws, vapour, root * root);
        let width = sqrt(limit_n - friction) / f64::from(VAPOUR_PANELS);
        for panel in 0..VAPOUR_PANELS {
            let (from, to) = (width * f64::from(panel), width * f64::from(panel + 1));
            if above(from) * above(to) < 0.0 {
                let root = bracketed_root(from, to, above);
                add(Corner::Vapour, root * root);
            }
        }
        corners
    }
}
