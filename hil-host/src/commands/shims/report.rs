//! What `dashpot shims` tells of each valve, beside the published deflections.

use std::io::{self, Write};

use dashpot_core::characteristic::Characteristic;
use dashpot_core::parameters::{Hydraulics, Valve};
use dashpot_core::shim::{Pack, edge_compliance_m_per_pa};
use serde::Serialize;

use super::place::{Place, radii};
use crate::failure::Outcome;
use crate::published::deflections;

/// The first erratum of the source paper, as docs/validation.md states it.
const ERRATUM: &str = "Tables 2-4 of the paper do not follow from its Table 1: the disc theory gives 33, 41 and 30 times \
     the tabulated deflections, and no bonded stack fits either. A damper file may give the edge \
     compliance instead of the pack; the preset `paper` gives the tabulated ones.";

#[derive(Serialize)]
struct Coefficient {
    radius_m: f64,
    cw_m6_per_n: f64,
}

#[derive(Serialize)]
struct PackReport {
    equivalent_thickness_m: f64,
    cw: Vec<Coefficient>,
    edge_compliance_m_per_pa: f64,
}

#[derive(Serialize)]
pub(super) struct Row {
    pub(super) pressure_pa: f64,
    /// Disc theory at the edge, uniform pressure.
    theory_uniform_m: Option<f64>,
    published_uniform_m: Option<f64>,
    published_real_m: Option<f64>,
    /// Lift the damper works with: `k_w (P - P_0)+`.
    lift_m: f64,
    flow_m3_per_s: f64,
}

#[derive(Serialize)]
pub(super) struct ValveReport {
    valve: &'static str,
    clamp_radius_m: f64,
    free_radius_m: f64,
    shims_m: Vec<f64>,
    /// `None` when the file gives a compliance and no shims.
    pack: Option<PackReport>,
    given_edge_compliance_m_per_pa: Option<f64>,
    equivalent_pressure_factor: f64,
    effective_edge_compliance_m_per_pa: f64,
    preload_pa: f64,
    /// Theory over published deflection, for a pack of the paper.
    theory_over_published: Option<f64>,
    pub(super) pressures: Vec<Row>,
}

#[derive(Serialize)]
pub(super) struct Report<'a> {
    damper: &'a str,
    valves: Vec<ValveReport>,
    erratum: &'static str,
    plots: Vec<String>,
}

impl<'a> Report<'a> {
    /// Of the damper called `damper`, its valves and the files drawn.
    pub(super) fn new(damper: &'a str, valves: Vec<ValveReport>, plots: Vec<String>) -> Self {
        Self {
            damper,
            valves,
            erratum: ERRATUM,
            plots,
        }
    }
}

/// Cw from clamp to edge, four equal parts; a clamp's rounding counts as the zero it is.
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

/// What a valve does beside its published deflections, which `paper` was described with.
pub(super) fn valve_report(
    place: &Place,
    hydraulics: &Hydraulics,
    paper: &Hydraulics,
    characteristic: &Characteristic,
) -> Outcome<ValveReport> {
    let valve = (place.of)(hydraulics);
    let pack = place.pack(hydraulics)?;
    let table = deflections(place.table)?;
    // The published deflections stand beside the pack they were published for only.
    let published = pack.is_some() && pack == place.pack(paper)?;
    let edge = pack
        .as_ref()
        .map(|pack| pack.compliance_m_per_pa(valve.free_radius_m));
    let effective = edge_compliance_m_per_pa(place.section, valve)?;
    let pressures: Vec<Row> = table
        .iter()
        .map(|row| {
            let pressure_pa = row.pressure_mpa * 1e6;
            Row {
                pressure_pa,
                theory_uniform_m: edge.map(|edge| edge * pressure_pa),
                published_uniform_m: published.then_some(row.theory_uniform_mm * 1e-3),
                published_real_m: published.then_some(row.fea_real_mm * 1e-3),
                lift_m: effective * (pressure_pa - valve.preload_pa).max(0.0),
                flow_m3_per_s: characteristic
                    .valve_flow_m3_per_s(place.valve, pressure_pa)
                    .unwrap_or(0.0),
            }
        })
        .collect();
    let theory_over_published = pressures
        .last()
        .and_then(|row| Some(row.theory_uniform_m? / row.published_uniform_m?));
    Ok(ValveReport {
        valve: place.name,
        clamp_radius_m: valve.clamp_radius_m,
        free_radius_m: valve.free_radius_m,
        shims_m: valve.shims_m.to_vec(),
        pack: pack.as_ref().map(|pack| PackReport {
            equivalent_thickness_m: pack.equivalent_thickness_m(),
            cw: coefficients(pack, valve),
            edge_compliance_m_per_pa: pack.compliance_m_per_pa(valve.free_radius_m),
        }),
        given_edge_compliance_m_per_pa: valve.edge_compliance_m_per_pa,
        equivalent_pressure_factor: valve.equivalent_pressure_factor,
        effective_edge_compliance_m_per_pa: effective,
        preload_pa: valve.preload_pa,
        theory_over_published,
        pressures,
    })
}

/// The report for people.
pub(super) fn print(out: &mut dyn Write, report: &Report<'_>) -> io::Result<()> {
    writeln!(out, "shim packs of {}", report.damper)?;
    for valve in &report.valves {
        print_valve(out, valve)?;
    }
    if report
        .valves
        .iter()
        .any(|valve| valve.theory_over_published.is_some())
    {
        writeln!(out, "\nerratum: {}", report.erratum)?;
    }
    if !report.plots.is_empty() {
        writeln!(out, "\nplots: {}", report.plots.join(", "))?;
    }
    Ok(())
}

fn print_valve(out: &mut dyn Write, valve: &ValveReport) -> io::Result<()> {
    writeln!(
        out,
        "\n{}: clamped at {:.1} mm, free at {:.1} mm, {} shims",
        valve.valve,
        valve.clamp_radius_m * 1e3,
        valve.free_radius_m * 1e3,
        valve.shims_m.len()
    )?;
    if let Some(pack) = &valve.pack {
        writeln!(
            out,
            "  equivalent thickness he {:.4} mm; edge compliance by theory {:.4} mm/MPa",
            pack.equivalent_thickness_m * 1e3,
            pack.edge_compliance_m_per_pa * 1e9
        )?;
        write!(out, "  r, mm       ")?;
        for row in &pack.cw {
            write!(out, "{:>12.2}", row.radius_m * 1e3)?;
        }
        write!(out, "\n  Cw, m^6/N   ")?;
        for row in &pack.cw {
            write!(out, "{:>12.4e}", row.cw_m6_per_n)?;
        }
        writeln!(out)?;
    }
    let source = if valve.given_edge_compliance_m_per_pa.is_some() {
        "given"
    } else {
        "theory"
    };
    writeln!(
        out,
        "  the damper works with {:.4e} m/Pa: {source} x Ce {}, preload {:.2} MPa",
        valve.effective_edge_compliance_m_per_pa,
        valve.equivalent_pressure_factor,
        valve.preload_pa * 1e-6
    )?;
    writeln!(
        out,
        "  {:>8}{:>14}{:>18}{:>16}{:>14}{:>13}",
        "P, MPa", "theory, mm", "published, mm", "(FEA real), mm", "lift used, mm", "flow, cm3/s"
    )?;
    let millimetres = |value: Option<f64>, digits: usize| {
        value.map_or_else(|| "-".to_owned(), |m| format!("{:.digits$}", m * 1e3))
    };
    for row in &valve.pressures {
        writeln!(
            out,
            "  {:>8.0}{:>14}{:>18}{:>16}{:>14.6}{:>13.2}",
            row.pressure_pa * 1e-6,
            millimetres(row.theory_uniform_m, 4),
            millimetres(row.published_uniform_m, 6),
            millimetres(row.published_real_m, 6),
            row.lift_m * 1e3,
            row.flow_m3_per_s * 1e6
        )?;
    }
    if let Some(ratio) = valve.theory_over_published {
        writeln!(out, "  theory over published: {ratio:.1}")?;
    }
    Ok(())
}
