//! `dashpot rig`: the bench test and its indices.

use std::io::Write;

use serde::{Deserialize, Serialize};

use super::{DamperArguments, Format};
use crate::failure::{Failure, Outcome};
use crate::rig::{self, Harmonic};

const TABLE_5: &str = include_str!("../../../data/published/table5_nominal_characteristic.csv");

/// Bench test: a harmonic motion until the force repeats, indices of one settled cycle.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot rig --damper paper --amplitude-m 24.875e-3 --frequency-hz 0.64
  dashpot rig --damper in-service --set mount.clearance_m=2e-3 --amplitude-m 5e-3 --frequency-hz 2 --format json")]
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
    /// Step, microseconds; shortened to a whole number of steps a cycle.
    #[arg(long, default_value_t = 100.0, value_name = "US")]
    pub step_us: f64,
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
    max_extension_force_n: f64,
    max_compression_force_n: f64,
    asymmetry_rate: Option<f64>,
    energy_per_cycle_j: f64,
    damping_coefficient_n_s_per_m: f64,
}

/// A row of Table 5.
#[derive(Deserialize)]
struct Published {
    index: String,
    simulation: f64,
    test: f64,
}

/// Runs the bench test and prints its indices.
///
/// # Errors
/// A damper or a motion that is refused, or a force that does not repeat.
pub fn run(arguments: &RigArguments) -> Outcome<()> {
    let damper = arguments.damper.load()?;
    let motion = Harmonic {
        amplitude_m: arguments.amplitude_m,
        frequency_hz: arguments.frequency_hz,
    };
    let cycle = rig::settle(&damper, motion, arguments.step_us * 1e-6)?;
    let indices = cycle.indices();
    let report = Report {
        damper: &arguments.damper.damper,
        amplitude_m: motion.amplitude_m,
        frequency_hz: motion.frequency_hz,
        peak_velocity_m_per_s: motion.peak_velocity_m_per_s(),
        step_s: cycle.step_s,
        cycles: cycle.cycles,
        max_extension_force_n: indices.max_extension_force_n,
        max_compression_force_n: indices.max_compression_force_n,
        asymmetry_rate: indices.asymmetry_rate,
        energy_per_cycle_j: indices.energy_per_cycle_j,
        damping_coefficient_n_s_per_m: indices.damping_coefficient_n_s_per_m,
    };
    let published = published(&motion)?;
    let mut out = std::io::stdout().lock();
    let printed = match arguments.format {
        Format::Text => print(&mut out, &report, &published),
        Format::Json => serde_json::to_writer_pretty(&mut out, &report)
            .map_err(std::io::Error::from)
            .and_then(|()| writeln!(out)),
    };
    printed.map_err(|error| Failure::new(format!("cannot print: {error}")))
}

/// Table 5, for its motion only.
fn published(motion: &Harmonic) -> Outcome<Vec<Published>> {
    let nominal = Harmonic::TABLE_5;
    let same = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b;
    if !(same(motion.amplitude_m, nominal.amplitude_m)
        && same(motion.frequency_hz, nominal.frequency_hz))
    {
        return Ok(Vec::new());
    }
    csv::Reader::from_reader(TABLE_5.as_bytes())
        .deserialize()
        .collect::<Result<_, _>>()
        .map_err(|error| Failure::new(format!("Table 5: {error}")))
}

fn print(
    out: &mut impl Write,
    report: &Report<'_>,
    published: &[Published],
) -> std::io::Result<()> {
    writeln!(
        out,
        "{}: +-{:.3} mm at {} Hz, peak velocity {:.4} m/s; cycle {} repeats, step {:.2} us\n",
        report.damper,
        report.amplitude_m * 1e3,
        report.frequency_hz,
        report.peak_velocity_m_per_s,
        report.cycles,
        report.step_s * 1e6
    )?;
    let asymmetry = report.asymmetry_rate.map_or_else(
        || "no force".to_owned(),
        |rate| format!("{:.2}", rate * 1e2),
    );
    let rows = [
        (
            "damping coefficient",
            "kN s/m",
            format!("{:.2}", report.damping_coefficient_n_s_per_m * 1e-3),
        ),
        (
            "maximum extension force",
            "N",
            format!("{:.0}", report.max_extension_force_n),
        ),
        (
            "maximum compression force",
            "N",
            format!("{:.0}", report.max_compression_force_n),
        ),
        ("asymmetry rate", "%", asymmetry),
        (
            "energy per cycle",
            "N m",
            format!("{:.2}", report.energy_per_cycle_j),
        ),
    ];
    let heading = if published.is_empty() {
        String::new()
    } else {
        format!("{:>17}{:>15}", "paper simulation", "paper test")
    };
    writeln!(out, "  {:<27}{:<8}{:>12}{heading}", "index", "unit", "here")?;
    for (name, unit, value) in rows {
        write!(out, "  {name:<27}{unit:<8}{value:>12}")?;
        if let Some(row) = published.iter().find(|row| row.index == name) {
            write!(out, "{:>17}{:>15}", row.simulation, row.test)?;
        }
        writeln!(out)?;
    }
    if !published.is_empty() {
        writeln!(
            out,
            "\npaper: Table 5, same motion. Its equations with its Tables 2-4 do not give its Table 5 \
             (docs/validation.md)."
        )?;
    }
    Ok(())
}
