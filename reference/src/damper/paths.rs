//! Flow paths of the physical damper: flow through the piston and the foot valve as a function of pressure.
//!
//! Pressures are gauge (Pa); flows (m^3/s) and velocities (m/s) are positive in the working direction.

use std::f64::consts::PI;

use dashpot_core::parameters::{
    ATMOSPHERIC_PRESSURE_PA, Hydraulics, Leakage, Relief, Reservoir, Valve,
};

use super::oil::{Fluid, kelvin};
use super::shim::edge_compliance_m_per_pa;

/// Piston areas (m^2).
#[derive(Clone, Copy, Debug)]
pub(super) struct Areas {
    pub(super) extension: f64,
    pub(super) compression: f64,
    pub(super) rod: f64,
}

impl Areas {
    pub(super) fn new(hydraulics: &Hydraulics) -> Self {
        let disc = |diameter: f64| PI * diameter * diameter / 4.0;
        let compression = disc(hydraulics.geometry.piston_diameter_m);
        let rod = disc(hydraulics.geometry.rod_diameter_m);
        Self {
            extension: compression - rod,
            compression,
            rod,
        }
    }
}

/// A valve whose flow area grows with the pressure above its opening: a shim pack
/// (`gradient = Cd 2 pi r_w k_w`) or the relief valve (`gradient = Cd g`).
#[derive(Clone, Copy, Debug)]
struct Opening {
    /// Effective area per pressure (m^2/Pa).
    gradient: f64,
    /// Opening pressure (Pa).
    opens_at: f64,
}

impl Opening {
    fn shims(valve: &Valve) -> Self {
        Self {
            gradient: valve.discharge_coefficient
                * 2.0
                * PI
                * valve.free_radius_m
                * edge_compliance_m_per_pa(valve),
            opens_at: valve.preload_pa,
        }
    }

    fn relief(relief: &Relief) -> Self {
        Self {
            gradient: relief.discharge_coefficient * relief.area_gradient_m2_per_pa,
            opens_at: relief.opening_pressure_pa,
        }
    }

    /// Flow at a pressure `excess` above the opening pressure and a pressure drop `drop`.
    fn flow(&self, excess: f64, drop: f64, density: f64) -> f64 {
        self.gradient * excess.max(0.0) * (2.0 * drop.max(0.0) / density).sqrt()
    }
}

/// All flow paths through the piston in one direction: orifice, shims, leakage, relief.
#[derive(Clone, Debug)]
pub(super) struct PistonPaths {
    /// `Cd A` of the orifice (m^2).
    orifice: f64,
    /// Flow `Q_t` at which the laminar and the turbulent pressure drop of the orifice are equal (m^3/s).
    transition: f64,
    shims: Opening,
    relief: Option<Opening>,
    /// Leakage flow per pressure times dynamic viscosity (m^3).
    leakage: f64,
    pub(super) fluid: Fluid,
}

impl PistonPaths {
    pub(super) fn new(hydraulics: &Hydraulics, valve: &Valve) -> Self {
        let fluid = Fluid::new(&hydraulics.oil);
        let orifice = &hydraulics.orifice;
        let bore = PI * orifice.diameter_m * orifice.diameter_m / 4.0;
        let transition = if orifice.diameter_m > 0.0 {
            orifice.transition_reynolds * fluid.viscosity * bore / orifice.diameter_m
        } else {
            0.0
        };
        let radius = hydraulics.geometry.piston_diameter_m / 2.0;
        Self {
            orifice: orifice.discharge_coefficient * bore,
            transition,
            shims: Opening::shims(valve),
            relief: hydraulics.relief.as_ref().map(Opening::relief),
            leakage: hydraulics
                .leakage
                .as_ref()
                .map_or(0.0, |leakage| annulus(leakage, radius)),
            fluid,
        }
    }

    /// Flow at the pressure drop `drop`; `upstream` is the gauge pressure upstream of the piston.
    pub(super) fn flow(&self, drop: f64, upstream: f64) -> f64 {
        let density = self.fluid.density(upstream);
        let mut flow = self.shims.flow(drop - self.shims.opens_at, drop, density);
        if self.orifice > 0.0 {
            // P = R_t (Q^2 + Q_t Q)
            let square = 2.0 * drop / density * self.orifice * self.orifice;
            let root = (self.transition * self.transition + 4.0 * square).sqrt();
            if root > 0.0 {
                flow += 2.0 * square / (self.transition + root);
            }
        }
        if let Some(relief) = &self.relief {
            flow += relief.flow(drop - relief.opens_at, drop, density);
        }
        flow + self.leakage * drop / (self.fluid.viscosity * density)
    }

    /// Pressure drop up to which no oil flows.
    pub(super) fn closed_up_to(&self) -> f64 {
        if self.orifice > 0.0 || self.leakage > 0.0 {
            return 0.0;
        }
        self.relief
            .iter()
            .fold(self.shims.opens_at, |lowest, relief| {
                lowest.min(relief.opens_at)
            })
    }

    pub(super) fn openings(&self) -> impl Iterator<Item = f64> + '_ {
        std::iter::once(self.shims.opens_at).chain(self.relief.iter().map(|relief| relief.opens_at))
    }
}

/// `Q mu/P` of the annular gap, `pi R c^3 (1 + 1.5 e^2)/(6 L)` (m^3).
fn annulus(leakage: &Leakage, radius: f64) -> f64 {
    let eccentric = 1.0 + 1.5 * leakage.eccentricity_ratio.powi(2);
    PI * radius * leakage.radial_clearance_m.powi(3) * eccentric / (6.0 * leakage.length_m)
}

/// Gauge back pressure (Pa) behind the foot valve.
fn back_pressure(reservoir: &Reservoir, rod_area: f64, temperature_c: f64) -> f64 {
    let volume = reservoir.gas_volume_m3 - rod_area * reservoir.rod_insertion_m;
    (reservoir.fill_pressure_pa + ATMOSPHERIC_PRESSURE_PA)
        * (reservoir.gas_volume_m3 / volume)
        * kelvin(temperature_c)
        / kelvin(reservoir.fill_temperature_c)
        - ATMOSPHERIC_PRESSURE_PA
}

/// The foot valve, from the piston side to the reservoir.
#[derive(Clone, Debug)]
pub(super) struct Foot {
    shims: Opening,
    back_pressure: f64,
}

impl Foot {
    pub(super) fn new(hydraulics: &Hydraulics, rod_area: f64) -> Self {
        Self {
            shims: Opening::shims(&hydraulics.valves.foot_compression),
            back_pressure: hydraulics.reservoir.as_ref().map_or(0.0, |reservoir| {
                back_pressure(reservoir, rod_area, hydraulics.oil.temperature_c)
            }),
        }
    }

    /// Chamber pressure up to which no oil flows.
    pub(super) fn closed_up_to(&self) -> f64 {
        self.shims.opens_at.max(self.back_pressure).max(0.0)
    }

    /// Chamber pressures at which the law has a corner.
    pub(super) fn openings(&self) -> [f64; 2] {
        [self.shims.opens_at, self.back_pressure]
    }

    /// Flow at the chamber pressure `base + above`; the sum is split so that a small excess keeps its precision.
    pub(super) fn flow(&self, base: f64, above: f64, density: f64) -> f64 {
        self.shims.flow(
            (base - self.shims.opens_at) + above,
            (base - self.back_pressure) + above,
            density,
        )
    }
}
