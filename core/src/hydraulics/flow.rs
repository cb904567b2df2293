//! Volume flow (m^3/s) through each path under its pressure difference (Pa).

use core::f64::consts::PI;

use super::compressed::Density;
use crate::math::square_roots::square_roots;
use crate::oil::ZERO_CELSIUS_K;
use crate::parameters::{
    ATMOSPHERIC_PRESSURE_PA, Hydraulics, Leakage, Relief, Reservoir, Valve, circle_area,
};
use crate::shim::edge_compliance;

/// A shim-pack valve, ready to evaluate: `Q = Cd 2 pi r_w k_w (P - P_0)+ sqrt(2 (P - P_b)+/rho)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShimValve {
    /// `Cd 2 pi r_w k_w` (m^2/Pa).
    area_gradient: f64,
    pub(crate) preload_pa: f64,
}

impl ShimValve {
    fn new(valve: &Valve) -> Self {
        Self {
            area_gradient: valve.discharge_coefficient
                * 2.0
                * PI
                * valve.free_radius_m
                * edge_compliance(valve),
            preload_pa: valve.preload_pa,
        }
    }

    /// Flow through the valve at a pressure (Pa) that lifts the shims and a jet velocity (m/s).
    #[inline(always)]
    pub(crate) fn flow(&self, lift_pa: f64, jet_m_per_s: f64) -> f64 {
        self.area_gradient * positive_part(lift_pa - self.preload_pa) * jet_m_per_s
    }
}

/// Paths through the piston that are open both ways: orifice, annular leakage and relief valve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FlowPaths {
    /// `Cd A` of the orifice (m^2).
    orifice_area: f64,
    /// Flow at which the laminar and the turbulent pressure drop of the orifice are equal (m^3/s).
    transition_flow: f64,
    /// Leakage conductance times density (kg/(s Pa)).
    leakage: f64,
    relief: Option<Relief>,
}

impl FlowPaths {
    fn new(hydraulics: &Hydraulics) -> Self {
        let orifice = &hydraulics.orifice;
        let area = circle_area(orifice.diameter_m);
        let transition_flow = if orifice.diameter_m > 0.0 {
            orifice.transition_reynolds * hydraulics.oil.kinematic_viscosity_m2_per_s() * area
                / orifice.diameter_m
        } else {
            0.0
        };
        let leakage = hydraulics.leakage.as_ref();
        Self {
            orifice_area: orifice.discharge_coefficient * area,
            transition_flow,
            leakage: leakage.map_or(0.0, |leakage| leakage_conductance(leakage, hydraulics)),
            relief: hydraulics.relief,
        }
    }

    /// Flows under pressure differences (Pa) across the piston, at densities (kg/m^3) and jet velocities (m/s).
    #[inline(always)]
    fn flows<const N: usize>(
        &self,
        pressures_pa: [f64; N],
        densities_kg_per_m3: [f64; N],
        jets_m_per_s: [f64; N],
    ) -> [f64; N] {
        let mut orifice = jets_m_per_s.map(|jet| self.orifice_area * jet);
        // P = R_t Q^2 + R_l Q with R_l = R_t Q_t and turbulent^2 = P/R_t.
        if self.transition_flow > 0.0 {
            let half = 0.5 * self.transition_flow;
            let roots = square_roots(orifice.map(|turbulent| half * half + turbulent * turbulent));
            for (turbulent, root) in orifice.iter_mut().zip(roots) {
                *turbulent = *turbulent * *turbulent / (half + root);
            }
        }
        let (relief_gradient, relief_opening) = self.relief.as_ref().map_or((0.0, 0.0), |valve| {
            let gradient = valve.discharge_coefficient * valve.area_gradient_m2_per_pa;
            (gradient, valve.opening_pressure_pa)
        });
        core::array::from_fn(|lane| {
            let pressure = pressures_pa[lane];
            let relief =
                relief_gradient * positive_part(pressure - relief_opening) * jets_m_per_s[lane];
            orifice[lane] + self.leakage * pressure / densities_kg_per_m3[lane] + relief
        })
    }
}

/// Jet velocity `sqrt(2 D/rho)` (m/s) of oil under a pressure difference D (Pa).
pub(crate) fn jet_velocity(difference_pa: f64, density_kg_per_m3: f64) -> f64 {
    let [jet] = jet_velocities([difference_pa], [density_kg_per_m3]);
    jet
}

/// Jet velocities (m/s); NaN for a negative pressure difference (Pa).
#[inline(always)]
fn jet_velocities<const N: usize>(
    differences_pa: [f64; N],
    densities_kg_per_m3: [f64; N],
) -> [f64; N] {
    square_roots(core::array::from_fn(|lane| {
        2.0 * differences_pa[lane] / densities_kg_per_m3[lane]
    }))
}

/// The number, or 0 if it is negative. Unlike `max`, it takes one vector instruction.
#[inline(always)]
fn positive_part(number: f64) -> f64 {
    if number > 0.0 { number } else { 0.0 }
}

/// The flow in each lane, 0 where the pressure difference is not positive.
#[inline(always)]
fn where_positive<const N: usize>(differences_pa: [f64; N], flows: [f64; N]) -> [f64; N] {
    core::array::from_fn(|lane| {
        if differences_pa[lane] <= 0.0 {
            0.0
        } else {
            flows[lane]
        }
    })
}

/// The laws of a physical damper, checked and ready to evaluate.
#[derive(Clone, Debug)]
pub(crate) struct Laws {
    pub(crate) density: Density,
    pub(crate) paths: FlowPaths,
    pub(crate) extension: ShimValve,
    pub(crate) compression: ShimValve,
    pub(crate) foot: ShimValve,
    pub(crate) relief_opening_pa: Option<f64>,
    pub(crate) rod_side_area: f64,
    pub(crate) piston_area: f64,
    pub(crate) back_pressure_pa: f64,
    pub(crate) friction_n: f64,
    pub(crate) vapour_pressure_pa: Option<f64>,
}

impl Laws {
    /// Area of the rod (m^2).
    pub(crate) fn rod_area(&self) -> f64 {
        self.piston_area - self.rod_side_area
    }

    /// Gauge pressure of the piston side at which the foot valve opens (Pa).
    pub(crate) fn foot_opening_pa(&self) -> f64 {
        self.foot.preload_pa.max(self.back_pressure_pa)
    }

    /// Flows through the foot valve under pressures of the piston side (Pa), at the densities there (kg/m^3).
    #[inline(always)]
    pub(crate) fn through_foot<const N: usize>(
        &self,
        pressures_pa: [f64; N],
        densities_kg_per_m3: [f64; N],
    ) -> [f64; N] {
        let differences = pressures_pa.map(|pressure| pressure - self.back_pressure_pa);
        let jets = jet_velocities(differences, densities_kg_per_m3);
        let flows = core::array::from_fn(|lane| self.foot.flow(pressures_pa[lane], jets[lane]));
        where_positive(differences, flows)
    }

    /// Flows through the piston in extension or compression under pressure differences (Pa), at the densities upstream
    /// (kg/m^3).
    #[inline(always)]
    pub(crate) fn through_piston<const N: usize>(
        &self,
        compression: bool,
        differences_pa: [f64; N],
        densities_kg_per_m3: [f64; N],
    ) -> [f64; N] {
        let valve = if compression {
            &self.compression
        } else {
            &self.extension
        };
        let jets = jet_velocities(differences_pa, densities_kg_per_m3);
        let paths = self.paths.flows(differences_pa, densities_kg_per_m3, jets);
        let flows =
            core::array::from_fn(|lane| paths[lane] + valve.flow(differences_pa[lane], jets[lane]));
        where_positive(differences_pa, flows)
    }

    /// Returns the laws of checked parameters.
    pub(crate) fn new(hydraulics: &Hydraulics) -> Self {
        let valves = &hydraulics.valves;
        let geometry = &hydraulics.geometry;
        Self {
            density: Density::new(&hydraulics.oil),
            paths: FlowPaths::new(hydraulics),
            extension: ShimValve::new(&valves.piston_extension),
            compression: ShimValve::new(&valves.piston_compression),
            foot: ShimValve::new(&valves.foot_compression),
            relief_opening_pa: hydraulics.relief.map(|relief| relief.opening_pressure_pa),
            rod_side_area: geometry.piston_area() - geometry.rod_area(),
            piston_area: geometry.piston_area(),
            back_pressure_pa: hydraulics.reservoir.map_or(0.0, |reservoir| {
                back_pressure(
                    &reservoir,
                    geometry.rod_area(),
                    hydraulics.oil.temperature_c,
                )
            }),
            friction_n: hydraulics.seal.map_or(0.0, |seal| seal.friction_n),
            vapour_pressure_pa: hydraulics.two_chamber.map(|two| two.vapour_pressure_pa),
        }
    }
}

/// Conductance times density of the leakage past the piston (kg/(s Pa)).
fn leakage_conductance(leakage: &Leakage, hydraulics: &Hydraulics) -> f64 {
    let (c, e) = (leakage.radial_clearance_m, leakage.eccentricity_ratio);
    let radius = 0.5 * hydraulics.geometry.piston_diameter_m;
    PI * radius * c * c * c * (1.0 + 1.5 * e * e)
        / (6.0 * hydraulics.oil.kinematic_viscosity_m2_per_s() * leakage.length_m)
}

/// Gauge pressure behind the foot valve (Pa).
fn back_pressure(reservoir: &Reservoir, rod_area: f64, temperature_c: f64) -> f64 {
    let warming =
        (temperature_c + ZERO_CELSIUS_K) / (reservoir.fill_temperature_c + ZERO_CELSIUS_K);
    let absolute = (reservoir.fill_pressure_pa + ATMOSPHERIC_PRESSURE_PA)
        * (reservoir.gas_volume_m3 / reservoir.volume_m3(rod_area))
        * warming;
    absolute - ATMOSPHERIC_PRESSURE_PA
}
