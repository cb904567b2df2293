//! Report of `dashpot shims`: each valve, compared with the published deflections.

use std::io::{self, Write};

use dashpot_core::characteristic::Characteristic;
use dashpot_core::parameters::{Hydraulics, Valve};
use dashpot_core::shim::{Pack, edge_compliance_m_per_pa};
use serde::Serialize;

use super::fe::{self, PlateReport};
use crate::commands::failure::Outcome;
use dashpot_testbench::published::Deflection;
use dashpot_testbench::shim_valves::{ValveLocation, theory_over_published};

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
    /// Edge deflection by disc theory under uniform pressure.
    theory_uniform_m: Option<f64>,
    published_uniform_m: Option<f64>,
    published_real_m: Option<f64>,
    /// Lift used by the damper model: `k_w (P - P_0)+`.
    lift_m: f64,
    flow_m3_per_s: f64,
}

#[derive(Serialize)]
pub(super) struct ValveReport {
    valve: &'static str,
    clamp_radius_m: f64,
    free_radius_m: f64,
    shims_m: Vec<f64>,
    /// `None` if the file gives a compliance instead of shims.
    pack: Option<PackReport>,
    given_edge_compliance_m_per_pa: Option<f64>,
    equivalent_pressure_factor: f64,
    pub(super) effective_edge_compliance_m_per_pa: f64,
    pub(super) preload_pa: f64,
    /// Ratio of theoretical to published deflection; only for a pack of the paper.
    theory_over_published: Option<f64>,
    pub(super) pressures: Vec<Row>,
    /// Published table; only for a pack of the paper.
    #[serde(skip)]
    published: Option<Vec<Deflection>>,
}

impl ValveReport {
    /// Returns the edge compliance by disc theory under uniform pressure (m/Pa).
    pub(super) fn theory_m_per_pa(&self) -> Option<f64> {
        self.pack.as_ref().map(|pack| pack.edge_compliance_m_per_pa)
    }

    /// Published table; only for a pack of the paper.
    pub(super) fn published(&self) -> Option<&[Deflection]> {
        self.published.as_deref()
    }

    /// Returns the source of the lift used by the damper model.
    pub(super) fn source(&self) -> &'static str {
        match self.given_edge_compliance_m_per_pa {
            Some(_) => "given compliance",
            None => "disc theory",
        }
    }
}

#[derive(Serialize)]
pub(super) struct Report<'a> {
    damper: &'a str,
    valves: Vec<ValveReport>,
    erratum: String,
    /// Only with `--fe`.
    #[serde(skip_serializing_if = "Option::is_none")]
    plates: Option<PlateReport>,
    plots: Vec<String>,
}

impl<'a> Report<'a> {
    /// Creates the report on `damper` from its valves, the paper's erratum and the plot files.
    pub(super) fn new(
        damper: &'a str,
        valves: Vec<ValveReport>,
        erratum: &str,
        plates: Option<PlateReport>,
        plots: Vec<String>,
    ) -> Self {
        Self {
            damper,
            valves,
            erratum: format!(
                "{erratum} A damper file may give the edge compliance instead of the pack; the preset \
                 `paper` uses the tabulated values."
            ),
            plates,
            plots,
        }
    }
}

/// Returns radii from clamp to edge in `parts` equal parts.
pub(super) fn radii(valve: &Valve, parts: u32) -> impl Iterator<Item = f64> + use<> {
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
pub(super) fn valve_report(
    location: &ValveLocation,
    hydraulics: &Hydraulics,
    paper: &Hydraulics,
    characteristic: &Characteristic,
) -> Outcome<ValveReport> {
    let valve = location.valve_of(hydraulics);
    let pack = location.pack(hydraulics)?;
    let theory = location.theory_m_per_pa(hydraulics)?;
    let table = location.published()?;
    // Compare the published deflections only with the pack they were published for.
    let published = pack.is_some() && pack == location.pack(paper)?;
    let effective = edge_compliance_m_per_pa(location.section, valve)?;
    let pressures: Vec<Row> = table
        .iter()
        .map(|row| {
            let pressure_pa = row.pressure_pa();
            Row {
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

/// Prints the report as text.
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
    if let Some(plates) = &report.plates {
        fe::print(out, plates)?;
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
    writeln!(
        out,
        "  used by the damper model: {:.4e} m/Pa ({} x Ce {}), preload {:.2} MPa",
        valve.effective_edge_compliance_m_per_pa,
        valve.source(),
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
        writeln!(out, "  ratio of theory to published: {ratio:.1}")?;
    }
    Ok(())
}
