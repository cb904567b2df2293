//! `dashpot rig`: the bench test and its indices.

use std::io::{self, Write};

use serde::Serialize;

use super::step_size::StepSize;
use super::{DamperArguments, Format, print_report};
use crate::failure::Outcome;
use crate::published::{NominalIndex, nominal_indices};
use crate::rig::{self, Harmonic};

/// Bench test: a harmonic motion until the force repeats, indices of one settled cycle.
#[derive(Debug, Clone, clap::Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  dashpot rig --damper paper --amplitude-m 24.875e-3 --frequency-hz 0.64
  dashpot rig --damper in-service --set mount.clearance_m=2e-3 --amplitude-m 5e-3 --frequency-hz 2 --format json"
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
    /// Step, us; 1 to 20000, fractions allowed; shortened to a whole number of steps a cycle.
    #[arg(long, default_value = "100", value_name = "US")]
    pub step_us: StepSize,
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

/// An index here, and its row of Table 5.
type Row = (String, NominalIndex);

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
    let cycle = rig::settle(&damper, motion, arguments.step_us.seconds())?;
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
    let rows: Vec<Row> = nominal_indices()?
        .into_iter()
        .map(|published| Ok((published.of(&indices)?, published)))
        .collect::<Outcome<_>>()?;
    let nominal = is_nominal(&motion);
    print_report(arguments.format, &report, |out, report| {
        print(out, report, &rows, nominal)
    })
}

/// Whether the motion is that of Table 5.
fn is_nominal(motion: &Harmonic) -> bool {
    let nominal = Harmonic::TABLE_5;
    let same = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b;
    same(motion.amplitude_m, nominal.amplitude_m) && same(motion.frequency_hz, nominal.frequency_hz)
}

fn print(out: &mut dyn Write, report: &Report<'_>, rows: &[Row], nominal: bool) -> io::Result<()> {
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
    let heading = if nominal {
        format!("{:>17}{:>15}", "paper simulation", "paper test")
    } else {
        String::new()
    };
    writeln!(out, "  {:<27}{:<8}{:>12}{heading}", "index", "unit", "here")?;
    for (here, published) in rows {
        write!(
            out,
            "  {:<27}{:<8}{here:>12}",
            published.index, published.unit
        )?;
        if nominal {
            write!(out, "{:>17}{:>15}", published.simulation, published.test)?;
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
    Ok(())
}
