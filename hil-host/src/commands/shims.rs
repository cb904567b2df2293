//! `dashpot shims`: the shim packs of a damper, theory beside published.

use std::io::Write;
use std::path::{Path, PathBuf};

use dashpot_core::characteristic::{Characteristic, ShimPackValve};
use dashpot_core::parameters::{Element, Hydraulics, Valve};
use dashpot_core::shim::{Pack, edge_compliance_m_per_pa};
use plotters::prelude::SeriesLabelPosition;
use serde::{Deserialize, Serialize};

use super::{DamperArguments, Format};
use crate::damper_file;
use crate::failure::{Failure, Outcome};
use crate::output::write_whole;
use crate::plot::curves::{Curve, Panel, ramp, sheet};
use crate::plot::style::BLUE_LINE;

/// Shim packs: Cw over radius, equivalent thickness, deflection under pressure, flow; theory beside published.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot shims --damper paper
  dashpot shims --damper in-service --plots shims --format json")]
pub struct ShimsArguments {
    /// The damper.
    #[command(flatten)]
    pub damper: DamperArguments,
    /// Folder the plots are written to.
    #[arg(long, default_value = "shims-plots", value_name = "FOLDER")]
    pub plots: PathBuf,
    /// Write no plots.
    #[arg(long)]
    pub no_plots: bool,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

/// The first erratum of the source paper, as docs/validation.md states it.
const ERRATUM: &str = "Tables 2-4 of the paper do not follow from its Table 1: the disc theory gives 33, 41 and 30 times \
     the tabulated deflections, and no bonded stack fits either. A damper file may give the edge \
     compliance instead of the pack; the preset `paper` gives the tabulated ones.";

/// A valve of the paper: its name, the key of the damper file, its place and its table.
struct Place {
    name: &'static str,
    section: &'static str,
    valve: ShimPackValve,
    of: fn(&Hydraulics) -> &Valve,
    table: &'static str,
}

const PLACES: [Place; 3] = [
    Place {
        name: "piston extension",
        section: "valves.piston_extension",
        valve: ShimPackValve::PistonExtension,
        of: |hydraulics| &hydraulics.valves.piston_extension,
        table: include_str!("../../../data/published/table2_piston_extension.csv"),
    },
    Place {
        name: "piston compression",
        section: "valves.piston_compression",
        valve: ShimPackValve::PistonCompression,
        of: |hydraulics| &hydraulics.valves.piston_compression,
        table: include_str!("../../../data/published/table3_piston_compression.csv"),
    },
    Place {
        name: "foot compression",
        section: "valves.foot_compression",
        valve: ShimPackValve::FootCompression,
        of: |hydraulics| &hydraulics.valves.foot_compression,
        table: include_str!("../../../data/published/table4_foot_compression.csv"),
    },
];

/// A row of Tables 2-4.
#[derive(Deserialize)]
struct Published {
    pressure_mpa: f64,
    theory_uniform_mm: f64,
    fea_real_mm: f64,
}

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
struct Row {
    pressure_pa: f64,
    /// Disc theory at the edge, uniform pressure.
    theory_uniform_m: Option<f64>,
    published_uniform_m: Option<f64>,
    published_real_m: Option<f64>,
    /// Lift the damper works with: `k_w (P - P_0)+`.
    lift_m: f64,
    flow_m3_per_s: f64,
}

#[derive(Serialize)]
struct ValveReport {
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
    pressures: Vec<Row>,
}

#[derive(Serialize)]
struct Report<'a> {
    damper: &'a str,
    valves: Vec<ValveReport>,
    erratum: &'static str,
    plots: Vec<String>,
}

/// Prints the shim packs of a damper and draws them.
///
/// # Errors
/// A damper that is refused or has no shim packs, or a plot that cannot be written.
pub fn run(arguments: &ShimsArguments) -> Outcome<()> {
    let name = &arguments.damper.damper;
    let parameters = arguments.damper.load()?;
    let Element::Physical(hydraulics) = &parameters.element else {
        return Err(Failure::new(format!(
            "{name}: a reduced damper has no shim packs; allowed: a damper with [valves], such as `paper`"
        )));
    };
    let characteristic = Characteristic::new(&parameters)?;
    let paper = damper_file::load("paper", &[])?;
    let Element::Physical(paper) = &paper.element else {
        return Err(Failure::new("the preset `paper` has no valves"));
    };
    let valves: Vec<ValveReport> = PLACES
        .iter()
        .map(|place| valve_report(place, hydraulics, paper, &characteristic))
        .collect::<Outcome<_>>()?;
    let plots = if arguments.no_plots {
        Vec::new()
    } else {
        draw(&arguments.plots, hydraulics, &valves, &characteristic)?
    };
    let report = Report {
        damper: name,
        valves,
        erratum: ERRATUM,
        plots,
    };
    let mut out = std::io::stdout().lock();
    let printed = match arguments.format {
        Format::Text => print(&mut out, &report),
        Format::Json => serde_json::to_writer_pretty(&mut out, &report)
            .map_err(std::io::Error::from)
            .and_then(|()| writeln!(out)),
    };
    printed.map_err(|error| Failure::new(format!("cannot print: {error}")))
}

/// The pack of a valve, if its file describes one.
fn pack(place: &Place, valve: &Valve) -> Outcome<Option<Pack>> {
    if valve.shims_m.is_empty() {
        return Ok(None);
    }
    Ok(Some(Pack::new(place.section, valve)?))
}

fn valve_report(
    place: &Place,
    hydraulics: &Hydraulics,
    paper: &Hydraulics,
    characteristic: &Characteristic,
) -> Outcome<ValveReport> {
    let valve = (place.of)(hydraulics);
    let pack = pack(place, valve)?;
    let table: Vec<Published> = csv::Reader::from_reader(place.table.as_bytes())
        .deserialize()
        .collect::<Result<_, _>>()
        .map_err(|error| Failure::new(format!("published {}: {error}", place.name)))?;
    // The published deflections stand beside the pack they were published for only.
    let published = pack.is_some() && pack == self::pack(place, (place.of)(paper))?;
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
            cw: radii(valve, 4)
                .map(|radius_m| Coefficient {
                    radius_m,
                    cw_m6_per_n: pack.disc().deflection_coefficient(radius_m),
                })
                .collect(),
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

/// Radii from clamp to edge, `parts` equal parts.
fn radii(valve: &Valve, parts: u32) -> impl Iterator<Item = f64> + use<> {
    let (clamp, free) = (valve.clamp_radius_m, valve.free_radius_m);
    (0..=parts).map(move |i| clamp + (free - clamp) * f64::from(i) / f64::from(parts))
}

/// Writes the plots into `folder` and tells their paths.
fn draw(
    folder: &Path,
    hydraulics: &Hydraulics,
    valves: &[ValveReport],
    characteristic: &Characteristic,
) -> Outcome<Vec<String>> {
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::in_file(folder, format!("cannot make the folder: {error}")))?;
    let mut deflections = Vec::new();
    let mut flows = Vec::new();
    for (place, report) in PLACES.iter().zip(valves) {
        let valve = (place.of)(hydraulics);
        if let Some(pack) = pack(place, valve)? {
            let colours = ramp(report.pressures.len());
            let curves = report.pressures.iter().zip(colours).map(|(row, colour)| {
                let points = radii(valve, 120)
                    .map(|r| (r * 1e3, pack.compliance_m_per_pa(r) * row.pressure_pa * 1e3));
                Curve::new(format!("{:.0} MPa", row.pressure_pa * 1e-6), colour, points)
            });
            deflections.push(Panel {
                title: format!("{} valve", capital(place.name)),
                x_label: "radius, mm".into(),
                y_label: "deflection under uniform pressure, mm".into(),
                legend: SeriesLabelPosition::UpperLeft,
                curves: curves.collect(),
            });
        }
        let points = (0..=200).map(|i| {
            let pressure_mpa = 0.05 * f64::from(i);
            let flow = characteristic.valve_flow_m3_per_s(place.valve, pressure_mpa * 1e6);
            (pressure_mpa, flow.unwrap_or(0.0) * 1e6)
        });
        flows.push(Panel {
            title: format!("{} valve", capital(place.name)),
            x_label: "pressure, MPa".into(),
            y_label: "flow through the pack, cm³/s".into(),
            legend: SeriesLabelPosition::UpperLeft,
            curves: vec![Curve::new(place.name, BLUE_LINE, points)],
        });
    }
    let mut paths = Vec::new();
    for (name, panels) in [
        ("shim-deflection.svg", deflections),
        ("valve-flow.svg", flows),
    ] {
        if panels.is_empty() {
            continue;
        }
        let svg = sheet(480 * panels.len() as u32, 440, &panels)?;
        let path = folder.join(name);
        write_whole(&path, |file| {
            file.write_all(svg.as_bytes())
                .map_err(|error| Failure::in_file(&path, format!("cannot write: {error}")))
        })?;
        paths.push(path.display().to_string());
    }
    Ok(paths)
}

/// `name` with a capital first letter.
fn capital(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

fn print(out: &mut impl Write, report: &Report<'_>) -> std::io::Result<()> {
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

fn print_valve(out: &mut impl Write, valve: &ValveReport) -> std::io::Result<()> {
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
