//! One working side of the damper: piston velocity as a function of force.

use heapless::Vec;

use super::corner::Corner;
use super::flow::Laws;
use super::two_chamber::{
    above_vapour_pa, compression_velocities, force_at_difference, signs_above_vapour,
};
use crate::math::elementary::sqrt;
use crate::math::root::bracketed_root;

/// Corners of one side, with their forces (N). There is room for more corners than a side has.
pub(crate) type Corners = Vec<(Corner, f64), 8>;

/// Number of panels in the search for the start and the end of vapour. The panels have equal widths in the square root
/// of the force.
const VAPOUR_PANELS: usize = 32;

/// Chamber under pressure at a force.
#[derive(Clone, Copy)]
pub(crate) struct Chamber {
    /// Force magnitude (N).
    pub(crate) force_n: f64,
    /// Gauge pressure `P = (|F| - F_c)+ / A` (Pa).
    pub(crate) pressure_pa: f64,
    /// Ratio of the volume of entrained air to its volume at atmospheric pressure (1); 1 for rigid oil.
    pub(crate) air_volume: f64,
}

/// Extension (rod-side chamber) or compression (piston-side chamber) of a physical damper.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HydraulicSide<'a> {
    pub(crate) laws: &'a Laws,
    pub(crate) compression: bool,
}

impl Chamber {
    /// Returns the chamber of a law without oil.
    pub(crate) fn without_oil(force_n: f64) -> Self {
        Self {
            force_n,
            pressure_pa: 0.0,
            air_volume: 1.0,
        }
    }
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

    /// Returns the chamber under pressure at a force magnitude (N).
    #[inline(always)]
    pub(crate) fn chamber(&self, force_n: f64) -> Chamber {
        let pressure_pa = (force_n - self.laws.friction_n).max(0.0) / self.area();
        let column = &self.laws.density.column;
        Chamber {
            force_n,
            pressure_pa,
            air_volume: column.map_or(1.0, |column| column.air_volume(pressure_pa)),
        }
    }

    /// Velocity of the piston in the cylinder (m/s) under a force magnitude (N).
    pub(crate) fn velocity(&self, force_n: f64) -> f64 {
        let [velocity] = self.velocities([self.chamber(force_n)]);
        velocity
    }

    /// Velocities of the piston in the cylinder (m/s) for several chambers. Solving them together takes less time than
    /// one by one.
    #[inline(always)]
    pub(crate) fn velocities<const N: usize>(&self, chambers: [Chamber; N]) -> [f64; N] {
        let laws = self.laws;
        if self.compression
            && let Some(vapour) = laws.vapour_pressure_pa
        {
            let forces = chambers.map(|chamber| chamber.force_n - laws.friction_n);
            let velocities = compression_velocities(laws, vapour, forces);
            return core::array::from_fn(|index| {
                if chambers[index].pressure_pa <= 0.0 {
                    0.0
                } else {
                    velocities[index]
                }
            });
        }
        let pressures = chambers.map(|chamber| chamber.pressure_pa);
        let densities = chambers.map(|chamber| {
            laws.density
                .with_air(chamber.pressure_pa, chamber.air_volume)
        });
        let mut flows = laws.through_piston(self.compression, pressures, densities);
        if self.compression {
            let foot = laws.through_foot(pressures, densities);
            for (flow, foot) in flows.iter_mut().zip(foot) {
                *flow += foot;
            }
        }
        core::array::from_fn(|index| {
            if pressures[index] <= 0.0 {
                0.0
            } else {
                flows[index] / self.area()
            }
        })
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
        let width = sqrt(limit_n - friction) / VAPOUR_PANELS as f64;
        let ends: [f64; VAPOUR_PANELS + 1] = core::array::from_fn(|end| width * end as f64);
        let signs = signs_above_vapour(laws, vapour, ends.map(|root| root * root));
        for (ends, signs) in ends.windows(2).zip(signs.windows(2)) {
            if signs[0] * signs[1] < 0.0 {
                let root = bracketed_root(ends[0], ends[1], above);
                add(Corner::Vapour, root * root);
            }
        }
        corners
    }
}
