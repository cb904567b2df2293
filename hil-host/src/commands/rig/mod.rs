//! `dashpot rig`: simulates a bench test and its indices, or all tests of a sheet.

mod sheet;

pub(super) use sheet::publish;

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
use dashpot_report::plot::style::{COMPARED, RESULT};
use dashpot_testbench::bench_test::{self, Cycle, Indices};
use dashpot_testbench::published::{
    NominalCharacteristic, NominalIndex, nominal_characteristic, nominal_indices,
};

/// Simulate a bench test: a harmonic motion until the force is periodic, with indices and loops of one settled cycle.
#[derive(Debug, Clone, clap::Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  dashpot rig --damper paper --amplitude-m 24.875e-3 --frequency-hz 0.64 --plots rig-plots
  dashpot rig --damper in-service --set mount.clearance_m=2e-3 --amplitude-m 5e-3 --frequency-hz 2 --format json
  dashpot rig --damper in-service --sheet example --page sheet.html
  dashpot rig --damper my.toml --sheet acceptance.toml --page sheet.html --format json > sheet.json

A sheet is a file of tests with limits for their indices and the clause that each limit comes from. See
data/sheets/example.toml for an example and docs/rig.md for all keys. The exit code is 1 if a limit is violated; the
page is written in any case."
)]
pub struct RigArguments {
    /// Damper.
    #[command(flatten)]
    pub damper: DamperArguments,
    /// Amplitude of the motion, m.
    #[arg(long, default_value_t = Harmonic::TABLE_5.amplitude_m, value_name = "M")]
    pub amplitude_m: f64,
    /// Frequency of the motion, Hz.
    #[arg(long, default_value_t = Harmonic::TABLE_5.frequency_hz, value_name = "HZ")]
    pub frequency_hz: f64,
    /// Step, us.
    #[arg(
        help = step_size::help("Step", "; shortened to give a whole number of steps per cycle"),
        long,
        default_value = "100",
        value_name = "US"
    )]
    pub step_us: StepSize,
    /// Write loops of force against displacement and velocity to this folder as force-loops.svg.
    #[arg(long, value_name = "FOLDER")]
    pub plots: Option<PathBuf>,
    /// Run the tests of a sheet instead of a single motion: built-in name or TOML file, `-` for standard input.
    #[arg(long, value_name = "NAME|FILE", conflicts_with_all = ["amplitude_m", "frequency_hz", "plots"])]
    pub sheet: Option<String>,
    /// Page of the sheet for archiving or printing, a self-contained HTML file; `-` for standard output.
    #[arg(long, value_name = "FILE", requires = "sheet")]
    pub page: Option<PathBuf>,
    /// Output format of the results.
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
    /// Table 5 of the paper, if the motion is that of the table.
    published: Option<NominalCharacteristic>,
    plots: Vec<String>,
}

/// A computed index and its row of Table 5.
type Row = (String, NominalIndex);

/// Runs the bench test and prints its indices.
///
/// # Errors
/// The damper, motion or sheet is invalid, the force does not become periodic, or a limit of the sheet is violated.
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

/// Writes the loops of a cycle to `folder`, with the measured maximum forces if they are published; returns the path.
fn draw(
    folder: &Path,
    name: &str,
    cycle: &Cycle,
    published: Option<&NominalCharacteristic>,
) -> Outcome<Vec<String>> {
    let motion = &cycle.motion;
    let computed = format!("{name}, computed");
    let (displacement, velocity) = loops::of_cycle(&computed, RESULT, cycle);
    let (mut displacement, mut velocity) = (vec![displacement], vec![velocity]);
    if let Some(NominalCharacteristic { test, .. }) = published {
        let (x, v) = (motion.amplitude_m * 1e3, motion.peak_velocity_m_per_s());
        for (name, force_n) in [
            (
                "measured maximum forces (Table 5)",
                test.max_extension_force_n,
            ),
            ("", -test.max_compression_force_n),
        ] {
            for (curves, reach) in [(&mut displacement, x), (&mut velocity, v)] {
                let points = [-reach, reach].map(|at| (at, force_n * 1e-3));
                curves.push(Curve::new(name, COMPARED, points).dashed());
            }
        }
    }
    let mut panels = loops::panels(displacement, velocity);
    // The legend is in the middle of the loop, which is empty.
    panels[0].legend = Some(SeriesLabelPosition::MiddleMiddle);
    for (panel, over) in panels.iter_mut().zip(["displacement", "velocity"]) {
        panel.title = format!(
            "Force against {over}, harmonic motion of ±{:.3} mm at {} Hz",
            motion.amplitude_m * 1e3,
            motion.frequency_hz
        );
    }
    let drawing = drawn_on_a_sheet(Layout::row(panels.len(), 640, 480), &panels)?;
    Ok(write_folder(folder, &[("force-loops.svg", drawing)])?)
}

/// True if the motion is that of Table 5.
fn is_nominal(motion: &Harmonic) -> bool {
    let nominal = Harmonic::TABLE_5;
    let same = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b;
    same(motion.amplitude_m, nominal.amplitude_m) && same(motion.frequency_hz, nominal.frequency_hz)
}

fn print(out: &mut dyn Write, report: &Report<'_>, rows: &[Row]) -> io::Result<()> {
    writeln!(
        out,
        "{}: harmonic motion of +-{:.3} mm at {} Hz, peak velocity {:.4} m/s; periodic from cycle {}, step {:.2} us\n",
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
            "\npaper: Table 5, same motion. The paper's equations with its Tables 2-4 do not reproduce its Table 5 \
             (docs/validation.md)."
        )?;
    }
    if !report.plots.is_empty() {
        writeln!(out, "\nplots: {}", report.plots.join(", "))?;
    }
    Ok(())
}
