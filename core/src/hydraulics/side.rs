//! One working side: piston velocity as a function of force.

use heapless::Vec;

use super::flow::Laws;
use super::two_chamber::{compression_velocity, force_at_difference};

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

    /// Velocity of the piston in the cylinder (m/s) under the force magnitude (N).
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

    /// Slope of the velocity over the root of the pressure, of the orifice alone (m/(s sqrt Pa)).
    pub(crate) fn orifice_velocity_per_root_pressure(&self) -> f64 {
        let laws = self.laws;
        laws.paths.orifice_area * laws.oil.jet_velocity(1.0, 0.0) / self.area()
    }

    /// Forces (N) at which the law has a corner: valves that open.
    pub(crate) fn corners(&self) -> Vec<f64, 8> {
        let laws = self.laws;
        let mut corners = Vec::new();
        let mut add = |pressure_pa: f64, area: f64| {
            if pressure_pa > 0.0 {
                // Capacity 8 exceeds the number of valves.
                let _ = corners.push(laws.friction_n + pressure_pa * area);
            }
        };
        if let (true, Some(_)) = (self.compression, laws.vapour_pressure_pa) {
            // The rod side adds pressure only with flow, so the foot valve opens on the rod area.
            let rod = laws.piston_area - laws.rod_side_area;
            add(laws.foot.preload_pa.max(laws.back_pressure_pa), rod);
            for opening in [Some(laws.compression.preload_pa), laws.relief_opening_pa] {
                if let Some(opening) = opening.filter(|pressure| *pressure > 0.0) {
                    add(force_at_difference(laws, opening), 1.0);
                }
            }
            return corners;
        }
        let valve = if self.compression {
            laws.compression
        } else {
            laws.extension
        };
        add(valve.preload_pa, self.area());
        if let Some(opening) = laws.relief_opening_pa {
            add(opening, self.area());
        }
        if self.compression {
            add(laws.foot.preload_pa.max(laws.back_pressure_pa), self.area());
        }
        corners
    }
}
