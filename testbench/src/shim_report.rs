//! Shim packs of a damper: in theory, as published, and as the damper model uses them.

use dashpot_core::CheckedParameters;
use dashpot_core::characteristic::Characteristic;
use dashpot_core::parameters::{DamperParameters, Element, Hydraulics, Valve};
use dashpot_core::shim::{Pack, edge_compliance_m_per_pa};
use serde::Serialize;

use super::TestbenchError;
use super::published::Deflection;
use super::shim_valves::{VALVE_LOCATIONS, ValveLocation, theory_over_published};

/// Deflection coefficient of a pack at a radius.
#[derive(Clone, Debug, Serialize)]
pub struct Coefficient {
    /// Radius (m).
    pub radius_m: f64,
    /// Deflection coefficient Cw (m^6/N).
    pub cw_m6_per_n: f64,
}

/// A pack by disc theory.
#[derive(Clone, Debug, Serialize)]
pub struct PackReport {
    /// Equivalent thickness he (m).
    pub equivalent_thickness_m: f64,
    /// Cw at the ends of four equal parts from clamp to edge.
    pub cw: Vec<Coefficient>,
    /// Edge compliance under uniform pressure (m/Pa).
    pub edge_compliance_m_per_pa: f64,
}

/// Lift and flow at a pressure.
#[derive(Clone, Debug, Serialize)]
pub struct PressureRow {
    /// Pressure (Pa).
    pub pressure_pa: f64,
    /// Edge deflection by disc theory under uniform pressure (m).
    pub theory_uniform_m: Option<f64>,
    /// Published edge deflection under uniform pressure (m).
    pub published_uniform_m: Option<f64>,
    /// Published edge deflection under the real pressure (m).
    pub published_real_m: Option<f64>,
    /// Lift used by the damper model: `k_w (P - P_0)+` (m).
    pub lift_m: f64,
    /// Flow through the pack (m3/s).
    pub flow_m3_per_s: f64,
}

/// A valve and its shim pack.
#[derive(Clone, Debug, Serialize)]
pub struct ValveReport {
    /// Name.
    pub valve: &'static str,
    /// Clamp radius (m).
    pub clamp_radius_m: f64,
    /// Free radius (m).
    pub free_radius_m: f64,
    /// Thicknesses of the shims (m).
    pub shims_m: Vec<f64>,
    /// `None` if the file gives a compliance instead of shims.
    pub pack: Option<PackReport>,
    /// Edge compliance of the file (m/Pa).
    pub given_edge_compliance_m_per_pa: Option<f64>,
    /// Correction factor Ce of the file.
    pub equivalent_pressure_factor: f64,
    /// Edge compliance that the damper model uses (m/Pa).
    pub effective_edge_compliance_m_per_pa: f64,
    /// Preload P_0 (Pa).
    pub preload_pa: f64,
    /// Ratio of theoretical to published deflection; only for a pack of the paper.
    pub theory_over_published: Option<f64>,
    /// Lift and flow at the pressures of the published table.
    pub pressures: Vec<PressureRow>,
    /// Published table; only for a pack of the paper.
    #[serde(skip)]
    published: Option<Vec<Deflection>>,
}

impl ValveReport {
    /// Returns the edge compliance by disc theory under uniform pressure (m/Pa).
    pub fn theory_m_per_pa(&self) -> Option<f64> {
        self.pack.as_ref().map(|pack| pack.edge_compliance_m_per_pa)
    }

    /// Published table; only for a pack of the paper.
    pub fn published(&self) -> Option<&[Deflection]> {
        self.published.as_deref()
    }

    /// Returns the source of the lift used by the damper model.
    pub fn source(&self) -> &'static str {
        match self.given_edge_compliance_m_per_pa {
            Some(_) => "given compliance",
            None => "disc theory",
        }
    }
}

/// Returns the hydraulics of a damper with valves.
///
/// # Errors
/// A reduced damper has none.
pub fn hydraulics(parameters: &DamperParameters) -> Result<&Hydraulics, TestbenchError> {
    match &parameters.element {
        Element::Physical(hydraulics) => Ok(hydraulics),
        _ => Err(TestbenchError::NoShims),
    }
}

/// Computes the report of each valve, with the published deflections of the packs in `paper`.
///
/// # Errors
/// The damper has no valves, or disc theory does not apply to a pack.
///
/// ```
/// use dashpot_files::damper;
/// use dashpot_testbench::shim_report::valve_reports;
/// let (damper, paper) = (damper::load("in-service", &[])?, damper::load("paper", &[])?);
/// let valves = valve_reports(&damper, &paper)?;
/// // The lift of a valve is linear in the pressure beyond the preload.
/// let row = valves[0].pressures.last().unwrap();
/// assert!(row.pressure_pa > valves[0].preload_pa);
/// let linear = valves[0].effective_edge_compliance_m_per_pa * (row.pressure_pa - valves[0].preload_pa);
/// assert!((row.lift_m / linear - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn valve_reports(
    damper: &CheckedParameters,
    paper: &DamperParameters,
) -> Result<Vec<ValveReport>, TestbenchError> {
    let (hydraulics, paper) = (hydraulics(damper)?, hydraulics(paper)?);
    let characteristic = Characteristic::new(damper);
    let report = |location| valve_report(location, hydraulics, paper, &characteristic);
    VALVE_LOCATIONS.iter().map(report).collect()
}

/// Returns radii from clamp to edge in `parts` equal parts.
pub fn radii(valve: &Valve, parts: u32) -> impl Iterator<Item = f64> + use<> {
    let (clamp, free) = (valve.clamp_radius_m, valve.free_radius_m);
    (0..=parts).map(move |i| clamp + (free - clamp) * f64::from(i) / f64::from(parts))
}

/// Returns Cw at the ends of four equal parts from clamp to edge; rounding errors at the clamp become zero.
fn coefficients(pack: &Pack, valve: &Valve) -> Vec<Coefficient> {
    let cw = |radius_m| pack.disc().deflection_coefficient(radius_m);
    let rounding = 1e-12 * cw(valve.free_radius_m);
    radii(valve, 4)
        .map(|radius_m| Coefficient {
            radius_m,
            cw_m6_per_n: Some(cw(radius_m))
                .filter(|cw| *cw > rounding)
                .unwrap_or(0.0),
        })
        .collect()
}

/// Computes the report of a valve, with the published deflections of the pack in `paper`.
fn valve_report(
    location: &ValveLocation,
    hydraulics: &Hydraulics,
    paper: &Hydraulics,
    characteristic: &Characteristic,
) -> Result<ValveReport, TestbenchError> {
    let valve = location.valve_of(hydraulics);
    let pack = location.pack(hydraulics)?;
    let theory = location.theory_m_per_pa(hydraulics)?;
    let table = location.published()?;
    // Compare the published deflections only with the pack they were published for.
    let published = pack.is_some() && pack == location.pack(paper)?;
    let effective = edge_compliance_m_per_pa(location.section, valve)?;
    let pressures: Vec<PressureRow> = table
        .iter()
        .map(|row| {
            let pressure_pa = row.pressure_pa();
            PressureRow {
                pressure_pa,
                theory_uniform_m: theory.map(|edge| edge * pressure_pa),
                published_uniform_m: published.then(|| row.theory_uniform_m()),
                published_real_m: published.then(|| row.fea_real_m()),
                lift_m: effective * (pressure_pa - valve.preload_pa).max(0.0),
                flow_m3_per_s: characteristic
                    .valve_flow_m3_per_s(location.valve, pressure_pa)
                    .unwrap_or(0.0),
            }
        })
        .collect();
    let published = published.then_some(table);
    Ok(ValveReport {
        valve: location.name,
        clamp_radius_m: valve.clamp_radius_m,
        free_radius_m: valve.free_radius_m,
        shims_m: valve.shims_m.to_vec(),
        pack: pack.zip(theory).map(|(pack, theory)| PackReport {
            equivalent_thickness_m: pack.equivalent_thickness_m(),
            cw: coefficients(&pack, valve),
            edge_compliance_m_per_pa: theory,
        }),
        given_edge_compliance_m_per_pa: valve.edge_compliance_m_per_pa,
        equivalent_pressure_factor: valve.equivalent_pressure_factor,
        effective_edge_compliance_m_per_pa: effective,
        preload_pa: valve.preload_pa,
        theory_over_published: theory
            .zip(published.as_deref())
            .and_then(|(theory, table)| theory_over_published(theory, table)),
        pressures,
        published,
    })
}
