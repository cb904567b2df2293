//! `dashpot rig`: the bench test and its indices, or all tests of a sheet.

mod sheet;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use plotters::prelude::SeriesLabelPosition;
use serde::Serialize;

use super::step_size::{self, StepSize};
use super::{DamperArguments, Format, print_report};
use crate::commands::failure::Outcome;
use dashpot_files::harmonic::Harmonic;
use dashpot_files::output::write_folder;
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::loops;
use dashpot_report::plot::sheet::{Layout, sheet as drawn_on_a_sheet};
use dashpot_report::plot::style::{BLUE_LINE, RED_LINE};
use dashpot_testbench::bench_test::{self, Cycle, Indices};
use dashpot_testbench::published::{
    NominalCharacteristic, NominalIndex, nominal_characteristic, nominal_indices,
};

/// Bench test: a made harmonic motion until the force repeats, indices and loops of one settled cycle.
#[derive(Debug, Clone, clap::Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  dashpot rig --damper paper --amplitude-m 24.875e-3 --frequency-hz 0.64 --plots rig-plots
  dashpot rig --damper in-service --set mount.clearance_m=2e-3 --amplitude-m 5e-3 --frequency-hz 2 --format json
  dashpot rig --damper in-service --sheet example --page sheet.html
  dashpot rig --damper my.toml --sheet acceptance.toml --page sheet.html --format json > sheet.json

A sheet is a file of tests and of the limits that their indices must keep, with the clause that each limit is from; data/sheets/example.toml is
one, docs/rig.md has every key. Exit code 1 when a limit is not kept; the sheet is written all the same."
)]
pub struct RigArguments {
    /// The damper.
    #[command(flatten)]
    pub damper: DamperArguments,
    /// Amplitude of the motion, m.
    #[arg(long, default_value_t = Harmonic::TABLE_5.amplitude_m, value_name = "M")]
    pub amplitude_m: f64,
    /// Frequency of the motion, Hz.
    #[arg(long, default_value_t = Harmonic::TABLE_5.frequency_hz, value_name = "HZ")]
    pub frequency_hz: f64,
    /// The step, us.
    #[arg(help = step_size::help("Step", "; shortened to a whole number of steps a cycle"), long, default_value = "100", value_name = "US")]
    pub step_us: StepSize,
    /// Folder the loops of force over displacement and velocity are written to, as force-loops.svg; none
    /// when not given.
    #[arg(long, value_name = "FOLDER")]
    pub plots: Option<PathBuf>,
    /// Tests and limits to go through in place of one motion: a sheet that ships or a TOML file, `-` for standard input.
    #[arg(long, value_name = "NAME|FILE", conflicts_with_all = ["amplitude_m", "frequency_hz", "plots"])]
    pub sheet: Option<String>,
    /// The sheet as a page to keep or to print, one self-contained HTML file; `-` for standard output.
    #[arg(long, value_name = "FILE", requires = "sheet")]
    pub page: Option<PathBuf>,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

#[derive(Serialize)]
struct Report<'a> {
    damper: &'a str,
    amplitude_m: f64,
    frequency_hz: f64,
    peak_velocity_m_per_s: f64,
    step_s: f64,
    cycles: usize,
    #[serde(flatten)]
    indices: Indices,
    /// Table 5 of the paper, where the motion is that of the table.
    published: Option<NominalCharacteristic>,
    plots: Vec<String>,
}

/// An index here, and its row of Table 5.
type Row = (String, NominalIndex);

/// Runs the bench test and prints its indices.
///
/// # Errors
/// A damper, a motion or a sheet that is refused, a force that does not repeat, or a limit of the sheet that is not kept.
pub fn run(arguments: &RigArguments) -> Outcome<()> {
    if let Some(name) = &arguments.sheet {
        return sheet::run(arguments, name);
    }
    let damper = arguments.damper.load()?;
    let motion = Harmonic {
        amplitude_m: arguments.amplitude_m,
        frequency_hz: arguments.frequency_hz,
    };
    let cycle = bench_test::run_until_periodic(&damper, motion, arguments.step_us.step_s())?;
    let indices = cycle.indices();
    let published = is_nominal(&motion)
        .then(nominal_characteristic)
        .transpose()?;
    let name = &arguments.damper.damper;
    let plots = match &arguments.plots {
        Some(folder) => draw(folder, name, &cycle, published.as_ref())?,
        None => Vec::new(),
    };
    let rows: Vec<Row> = nominal_indices()?
        .into_iter()
        .map(|row| Ok((row.format_value(&indices)?, row)))
        .collect::<Outcome<_>>()?;
    let report = Report {
        damper: name,
        amplitude_m: motion.amplitude_m,
        frequency_hz: motion.frequency_hz,
        peak_velocity_m_per_s: motion.peak_velocity_m_per_s(),
        step_s: cycle.step_s,
        cycles: cycle.cycles,
        indices,
        published,
        plots,
    };
    print_report(arguments.format, &report, |out, report| {
        print(out, report, &rows)
    })
}

/// Writes the loops of a cycle called `name` into `folder`, with the largest forces measured where they
/// are published; returns their path.
fn draw(
    folder: &Path,
    name: &str,
    cycle: &Cycle,
    published: Option<&NominalCharacteristic>,
) -> Outcome<Vec<String>> {
    let motion = &cycle.motion;
    let computed = format!("{name}, computed");
    let (displacement, velocity) = loops::of_cycle(&computed, BLUE_LINE, cycle);
    let (mut displacement, mut velocity) = (vec![displacement], vec![velocity]);
    if let Some(NominalCharacteristic { test, .. }) = published {
        let (x, v) = (motion.amplitude_m * 1e3, motion.peak_velocity_m_per_s());
        for (name, force_n) in [
            (
                "largest forces measured (Table 5)",
                test.max_extension_force_n,
            ),
            ("", -test.max_compression_force_n),
        ] {
            for (curves, reach) in [(&mut displacement, x), (&mut velocity, v)] {
                let points = [-reach, reach].map(|at| (at, force_n * 1e-3));
                curves.push(Curve::new(name, RED_LINE, points).dashed());
            }
        }
    }
    let mut panels = loops::panels(displacement, velocity);
    // The middle of a loop is empty.
    panels[0].legend = Some(SeriesLabelPosition::MiddleMiddle);
    for (panel, over) in panels.iter_mut().zip(["displacement", "velocity"]) {
        panel.title = format!(
            "Force over {over}, made motion of ±{:.3} mm at {} Hz",
            motion.amplitude_m * 1e3,
            motion.frequency_hz
        );
    }
    let drawing = drawn_on_a_sheet(Layout::row(panels.len(), 640, 480), &panels)?;
    Ok(write_folder(folder, &[("force-loops.svg", drawing)])?)
}

/// Whether the motion is that of Table 5.
fn is_nominal(motion: &Harmonic) -> bool {
    let nominal = Harmonic::TABLE_5;
    let same = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b;
    same(motion.amplitude_m, nominal.amplitude_m) && same(motion.frequency_hz, nominal.frequency_hz)
}

fn print(out: &mut dyn Write, report: &Report<'_>, rows: &[Row]) -> io::Result<()> {
    writeln!(
        out,
        "{}: made motion of +-{:.3} mm at {} Hz, peak velocity {:.4} m/s; cycle {} repeats, step {:.2} us\n",
        report.damper,
        report.amplitude_m * 1e3,
        report.frequency_hz,
        report.peak_velocity_m_per_s,
        report.cycles,
        report.step_s * 1e6
    )?;
    let nominal = report.published.is_some();
    let heading = if nominal {
        format!("{:>18}{:>23}", "paper simulation", "paper test, measured")
    } else {
        String::new()
    };
    writeln!(
        out,
        "  {:<27}{:<8}{:>12}{heading}",
        "index", "unit", "computed"
    )?;
    for (here, published) in rows {
        write!(
            out,
            "  {:<27}{:<8}{here:>12}",
            published.index, published.unit
        )?;
        if nominal {
            write!(out, "{:>18}{:>23}", published.simulation, published.test)?;
        }
        writeln!(out)?;
    }
    if nominal {
        writeln!(
            out,
            "\npaper: Table 5, same motion. Its equations with its Tables 2-4 do not give its Table 5 \
             (docs/validation.md)."
        )?;
    }
    if !report.plots.is_empty() {
        writeln!(out, "\nplots: {}", report.plots.join(", "))?;
    }
    Ok(())
}
