//! Report of `dashpot shims`: each valve, compared with the published deflections.

use std::io::{self, Write};

use serde::Serialize;

use super::fe::{self, PlateReport};
use dashpot_testbench::shim_report::ValveReport;

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
