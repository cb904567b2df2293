//! Volume flow (m^3/s) of each path under its pressure difference (Pa).

use core::f64::consts::PI;

use crate::error::{BuildError, require, require_ranges};
use crate::math::elementary::sqrt;
use crate::parameters::{Hydraulics, Oil, Relief, Valve};
use crate::shim::edge_compliance_m_per_pa;

/// Shim-pack valve ready to evaluate: `Q = Cd 2 pi r_w k_w (P - P_0)+ sqrt(2 (P - P_b)+/rho)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShimValve {
    /// `Cd 2 pi r_w k_w` (m^2/Pa).
    area_gradient: f64,
    pub(crate) preload_pa: f64,
}

impl ShimValve {
    fn new(section: &'static str, valve: &Valve) -> Result<Self, BuildError> {
        let check = |field, value, valid, allowed| require(section, field, value, valid, allowed);
        let compliance = edge_compliance_m_per_pa(section, valve)?;
        check(
            "free_radius_m",
            valve.free_radius_m,
            valve.free_radius_m > 0.0 && valve.free_radius_m <= 1.0,
            "above 0 and at most 1 m",
        )?;
        check(
            "clamp_radius_m",
            valve.clamp_radius_m,
            valve.clamp_radius_m > 0.0 && valve.clamp_radius_m < valve.free_radius_m,
            "above 0 and below free_radius_m",
        )?;
        require_ranges!(section, valve;
            equivalent_pressure_factor in 0.0..=10.0, "0 to 10";
            discharge_coefficient in 0.0..=1.0, "0 to 1";
            preload_pa in 0.0..=1e8, "0 to 1e8 Pa";
        )?;
        Ok(Self {
            area_gradient: valve.discharge_coefficient
                * 2.0
                * PI
                * valve.free_radius_m
                * compliance,
            preload_pa: valve.preload_pa,
        })
    }

    /// Flow of a jet at `jet_m_per_s` through the valve, which lifts under `lift_pa`.
    pub(crate) fn flow(&self, lift_pa: f64, jet_m_per_s: f64) -> f64 {
        self.area_gradient * (lift_pa - self.preload_pa).max(0.0) * jet_m_per_s
    }
}

/// The paths of the piston that are open both ways: orifice, annular leakage, relief valve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FlowPaths {
    /// `Cd A` of the orifice (m^2).
    orifice_area: f64,
    /// Flow at which laminar and turbulent pressure drop of the orifice are equal (m^3/s).
    transition_flow: f64,
    /// Leakage conductance times density (kg/(s Pa)).
    leakage: f64,
    relief: Option<Relief>,
}

impl FlowPaths {
    /// Flow at `pressure_pa` across the piston of oil of a density, whose jet has `jet_m_per_s`.
    fn flow(&self, pressure_pa: f64, density_kg_per_m3: f64, jet_m_per_s: f64) -> f64 {
        let turbulent = self.orifice_area * jet_m_per_s;
        // P = R_t Q^2 + R_l Q with R_l = R_t Q_t and turbulent^2 = P/R_t.
        let orifice = if self.transition_flow > 0.0 && turbulent > 0.0 {
            let half = 0.5 * self.transition_flow;
            turbulent * turbulent / (half + sqrt(half * half + turbulent * turbulent))
        } else {
            turbulent
        };
        let relief = self.relief.as_ref().map_or(0.0, |valve| {
            valve.discharge_coefficient
                * valve.area_gradient_m2_per_pa
                * (pressure_pa - valve.opening_pressure_pa).max(0.0)
                * jet_m_per_s
        });
        orifice + self.leakage * pressure_pa / density_kg_per_m3 + relief
    }
}

/// `sqrt(2 D/rho)` (m/s) of a pressure difference D (Pa) that drives oil of a density.
pub(crate) fn jet_velocity(difference_pa: f64, density_kg_per_m3: f64) -> f64 {
    sqrt(2.0 * difference_pa / density_kg_per_m3)
}

/// Every law of a physical damper, checked and ready to evaluate.
#[derive(Clone, Debug)]
pub(crate) struct Laws {
    pub(crate) oil: Oil,
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

    /// Gauge pressure on the piston side from which the foot valve passes oil (Pa).
    pub(crate) fn foot_opening_pa(&self) -> f64 {
        self.foot.preload_pa.max(self.back_pressure_pa)
    }

    /// Flow through the foot valve under the piston-side pressure.
    pub(crate) fn through_foot(&self, pressure_pa: f64) -> f64 {
        let difference = pressure_pa - self.back_pressure_pa;
        if difference <= 0.0 {
            return 0.0;
        }
        let density = self.oil.density_kg_per_m3(pressure_pa);
        self.foot
            .flow(pressure_pa, jet_velocity(difference, density))
    }

    /// Flow through the piston in extension or compression at a difference from an upstream pressure.
    pub(crate) fn through_piston(
        &self,
        compression: bool,
        difference_pa: f64,
        upstream_pa: f64,
    ) -> f64 {
        if difference_pa <= 0.0 {
            return 0.0;
        }
        let valve = if compression {
            &self.compression
        } else {
            &self.extension
        };
        let density = self.oil.density_kg_per_m3(upstream_pa);
        let jet = jet_velocity(difference_pa, density);
        self.paths.flow(difference_pa, density, jet) + valve.flow(difference_pa, jet)
    }

    pub(crate) fn new(hydraulics: &Hydraulics) -> Result<Self, BuildError> {
        let (piston_area, rod_area) = areas(hydraulics)?;
        let rod_side_area = piston_area - rod_area;
        hydraulics.oil.validate()?;
        let valves = &hydraulics.valves;
        Ok(Self {
            oil: hydraulics.oil,
            paths: flow_paths(hydraulics)?,
            extension: ShimValve::new("valves.piston_extension", &valves.piston_extension)?,
            compression: ShimValve::new("valves.piston_compression", &valves.piston_compression)?,
            foot: ShimValve::new("valves.foot_compression", &valves.foot_compression)?,
            relief_opening_pa: hydraulics.relief.map(|relief| relief.opening_pressure_pa),
            rod_side_area,
            piston_area,
            back_pressure_pa: back_pressure(hydraulics, rod_area)?,
            friction_n: friction(hydraulics)?,
            vapour_pressure_pa: vapour_pressure(hydraulics)?,
        })
    }
}

fn areas(hydraulics: &Hydraulics) -> Result<(f64, f64), BuildError> {
    let geometry = &hydraulics.geometry;
    require_ranges!("geometry", geometry; piston_diameter_m in 1e-3..=1.0, "1e-3 to 1 m";)?;
    require(
        "geometry",
        "rod_diameter_m",
        geometry.rod_diameter_m,
        geometry.rod_diameter_m >= 0.0
            && geometry.rod_diameter_m <= 0.95 * geometry.piston_diameter_m,
        "0 to 0.95 of piston_diameter_m",
    )?;
    let area = |diameter: f64| 0.25 * PI * diameter * diameter;
    Ok((
        area(geometry.piston_diameter_m),
        area(geometry.rod_diameter_m),
    ))
}

fn flow_paths(hydraulics: &Hydraulics) -> Result<FlowPaths, BuildError> {
    let orifice = &hydraulics.orifice;
    require(
        "orifice",
        "diameter_m",
        orifice.diameter_m,
        orifice.diameter_m >= 0.0 && orifice.diameter_m < hydraulics.geometry.piston_diameter_m,
        "0 to below piston_diameter_m",
    )?;
    require_ranges!("orifice", orifice;
        discharge_coefficient in 0.0..=1.0, "0 to 1";
        transition_reynolds in 0.0..=1e5, "0 to 1e5";
    )?;
    let area = 0.25 * PI * orifice.diameter_m * orifice.diameter_m;
    let transition_flow = if orifice.diameter_m > 0.0 {
        orifice.transition_reynolds * hydraulics.oil.kinematic_viscosity_m2_per_s() * area
            / orifice.diameter_m
    } else {
        0.0
    };
    Ok(FlowPaths {
        orifice_area: orifice.discharge_coefficient * area,
        transition_flow,
        leakage: leakage(hydraulics)?,
        relief: relief(hydraulics)?,
    })
}

fn leakage(hydraulics: &Hydraulics) -> Result<f64, BuildError> {
    let Some(leakage) = &hydraulics.leakage else {
        return Ok(0.0);
    };
    require_ranges!("leakage", leakage;
        radial_clearance_m in 0.0..=1e-3, "0 to 1e-3 m";
        length_m in 1e-4..=1.0, "1e-4 to 1 m";
        eccentricity_ratio in 0.0..=1.0, "0 to 1";
    )?;
    let (c, e) = (leakage.radial_clearance_m, leakage.eccentricity_ratio);
    let radius = 0.5 * hydraulics.geometry.piston_diameter_m;
    Ok(PI * radius * c * c * c * (1.0 + 1.5 * e * e)
        / (6.0 * hydraulics.oil.kinematic_viscosity_m2_per_s() * leakage.length_m))
}

fn relief(hydraulics: &Hydraulics) -> Result<Option<Relief>, BuildError> {
    let Some(relief) = hydraulics.relief else {
        return Ok(None);
    };
    require_ranges!("relief", relief;
        opening_pressure_pa in 0.0..=1e8, "0 to 1e8 Pa";
        area_gradient_m2_per_pa in 0.0..=1e-6, "0 to 1e-6 m2/Pa";
        discharge_coefficient in 0.0..=1.0, "0 to 1";
    )?;
    Ok(Some(relief))
}

fn back_pressure(hydraulics: &Hydraulics, rod_area: f64) -> Result<f64, BuildError> {
    use crate::oil::ZERO_CELSIUS_K;
    use crate::parameters::ATMOSPHERIC_PRESSURE_PA;
    let Some(reservoir) = &hydraulics.reservoir else {
        return Ok(0.0);
    };
    require_ranges!("reservoir", reservoir;
        fill_pressure_pa in 0.0..=1e7, "0 to 1e7 Pa";
        gas_volume_m3 in 1e-6..=1.0, "1e-6 to 1 m3";
        fill_temperature_c in -60.0..=150.0, "-60 to 150 degC";
    )?;
    let volume = reservoir.gas_volume_m3 - rod_area * reservoir.rod_insertion_m;
    require(
        "reservoir",
        "rod_insertion_m",
        reservoir.rod_insertion_m,
        reservoir.rod_insertion_m.abs() <= 1.0 && volume >= 0.1 * reservoir.gas_volume_m3,
        "-1 to 1 m and leaving a tenth of gas_volume_m3",
    )?;
    let warming = (hydraulics.oil.temperature_c + ZERO_CELSIUS_K)
        / (reservoir.fill_temperature_c + ZERO_CELSIUS_K);
    let absolute = (reservoir.fill_pressure_pa + ATMOSPHERIC_PRESSURE_PA)
        * (reservoir.gas_volume_m3 / volume)
        * warming;
    Ok(absolute - ATMOSPHERIC_PRESSURE_PA)
}

fn friction(hydraulics: &Hydraulics) -> Result<f64, BuildError> {
    let Some(seal) = &hydraulics.seal else {
        return Ok(0.0);
    };
    require_ranges!("seal", seal; friction_n in 0.0..=1e4, "0 to 1e4 N";)?;
    Ok(seal.friction_n)
}

fn vapour_pressure(hydraulics: &Hydraulics) -> Result<Option<f64>, BuildError> {
    use crate::parameters::ATMOSPHERIC_PRESSURE_PA;
    let Some(two_chamber) = &hydraulics.two_chamber else {
        return Ok(None);
    };
    require_ranges!("two_chamber", two_chamber;
        vapour_pressure_pa in -ATMOSPHERIC_PRESSURE_PA..=0.0, "-101325 to 0 Pa (gauge)";
    )?;
    require(
        "geometry",
        "rod_diameter_m",
        hydraulics.geometry.rod_diameter_m,
        hydraulics.geometry.rod_diameter_m > 0.0,
        "above 0 with two_chamber",
    )?;
    Ok(Some(two_chamber.vapour_pressure_pa))
}
