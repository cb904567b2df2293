//! `dashpot hybrid benchmark`: the published benchmark of real-time hybrid simulation.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::ValueEnum;
use serde::Serialize;

use super::record;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::{Format, print_report};
use dashpot_hybrid::Noise;
use dashpot_hybrid::benchmark::{
    CASES, Control, Criteria, Plant, RunError, Sensors, at_ticks, chirp, earthquake,
    run as run_case,
};
use dashpot_report::verdict::Verdict;

/// Run the published benchmark of real-time hybrid simulation (Silva and others, 2020): a frame whose first storey is
/// moved by an actuator at 4096 Hz. Prints the criteria of the nominal plant and the worst of all plants.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot hybrid benchmark
  dashpot hybrid benchmark --chirp --compensate none
  dashpot hybrid benchmark --record earthquake.csv --scale 0.4 --sensors noisy
  dashpot hybrid benchmark --plants 0 --beta1-per-s 430 --stiffness-n-per-m 1.3e6 --format json")]
pub(super) struct BenchmarkArguments {
    /// Case of the frame, 1 to 4; repeat for several [default: all].
    #[arg(long, value_name = "CASE", value_parser = clap::value_parser!(u64).range(1..=CASES as u64))]
    case: Vec<u64>,
    /// Number of plants beside the first, drawn from the published distributions.
    #[arg(long, default_value_t = 20, value_name = "COUNT", value_parser = clap::value_parser!(u64).range(0..=10_000))]
    plants: u64,
    /// Damping coefficient of the valve of the first plant (1/s).
    #[arg(long, default_value_t = Plant::NOMINAL.beta1_per_s, value_name = "1/S")]
    beta1_per_s: f64,
    /// Squared frequency of the valve of the first plant (1/s^2).
    #[arg(long, default_value_t = Plant::NOMINAL.beta2_per_s2, value_name = "1/S2")]
    beta2_per_s2: f64,
    /// Pole of the actuator of the first plant (1/s).
    #[arg(long, default_value_t = Plant::NOMINAL.a3_per_s, value_name = "1/S", allow_negative_numbers = true)]
    a3_per_s: f64,
    /// Stiffness of the specimen of the first plant (N/m).
    #[arg(long, default_value_t = Plant::NOMINAL.stiffness_n_per_m, value_name = "N/M")]
    stiffness_n_per_m: f64,
    /// Record of ground motion: a text file with the columns time_s,acceleration_m_per_s2; `-` for standard input
    /// [default: a synthetic earthquake].
    #[arg(long, value_name = "FILE", conflicts_with = "chirp")]
    record: Option<PathBuf>,
    /// Factor on the ground motion.
    #[arg(long, default_value_t = 1.0, value_name = "FACTOR")]
    scale: f64,
    /// Chirp from 0.1 to 10 Hz instead of an earthquake.
    #[arg(long)]
    chirp: bool,
    /// Compensator; each knows the nominal plant only.
    #[arg(long, value_enum, default_value_t = Compensation::Ats)]
    compensate: Compensation,
    /// Sensors of displacement and force.
    #[arg(long, value_enum, default_value_t = Precision::Quantised)]
    sensors: Precision,
    /// Seed of the earthquake, the plants and the noise.
    #[arg(long, default_value_t = 1, value_name = "NUMBER")]
    seed: u64,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Compensators by their names on the command line.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Compensation {
    /// The desired displacement is the command.
    None,
    /// Inverse of the nominal plant.
    Inverse,
    /// Adaptive time series.
    Ats,
}

/// Sensors by their names on the command line.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Precision {
    /// Without error.
    Perfect,
    /// 18 bits a volt at 1 V/m.
    Quantised,
    /// The same with noise of 16 um and 2.2 N, as in the benchmark's program.
    Noisy,
}

#[derive(Serialize)]
struct Row {
    case: u64,
    /// Criteria of the first plant; `None` if its run was unstable.
    first: Option<Criteria>,
    /// Runs that were unstable.
    unstable: usize,
    runs: usize,
    /// Worst criteria of the stable runs.
    #[serde(skip_serializing_if = "Option::is_none")]
    worst: Option<Worst>,
}

#[derive(Serialize)]
struct Worst {
    j1_ms: f64,
    j2_percent: f64,
    j4_percent: f64,
    reached_percent: f64,
}

/// Runs the command.
pub(super) fn run(arguments: &BenchmarkArguments) -> Outcome<()> {
    let first = plant(arguments)?;
    let ground = ground(arguments)?;
    let mut noise = Noise::new(arguments.seed);
    let others = (0..arguments.plants).map(|_| Plant::perturbed(&mut noise));
    let plants: Vec<Plant> = std::iter::once(first).chain(others).collect();
    let cases = match arguments.case.is_empty() {
        true => (1..=CASES as u64).collect(),
        false => arguments.case.clone(),
    };
    let rows = cases
        .into_iter()
        .map(|case| row(case, &plants, &ground, arguments));
    let rows = rows.collect::<Outcome<Vec<Row>>>()?;
    print_report(arguments.format, &rows, |out, rows| text(out, rows))
}

/// The first plant.
fn plant(arguments: &BenchmarkArguments) -> Outcome<Plant> {
    for (option, value, range) in [
        ("--beta1-per-s", arguments.beta1_per_s, 10.0..=10_000.0),
        ("--beta2-per-s2", arguments.beta2_per_s2, 1e3..=1e7),
        ("--a3-per-s", arguments.a3_per_s, -100.0..=1000.0),
        (
            "--stiffness-n-per-m",
            arguments.stiffness_n_per_m,
            1e3..=0.9 * 26e6,
        ),
        ("--scale", arguments.scale, 1e-6..=1e3),
    ] {
        if !range.contains(&value) {
            let (least, most) = (range.start(), range.end());
            return Err(Failure::wrong_use(format!(
                "{option} {value} is not allowed: must be {least} to {most}"
            )));
        }
    }
    Ok(Plant {
        beta1_per_s: arguments.beta1_per_s,
        beta2_per_s2: arguments.beta2_per_s2,
        a3_per_s: arguments.a3_per_s,
        stiffness_n_per_m: arguments.stiffness_n_per_m,
    })
}

/// Acceleration of the ground at each tick (m/s^2).
fn ground(arguments: &BenchmarkArguments) -> Outcome<Vec<f64>> {
    let mut ground = match (&arguments.record, arguments.chirp) {
        (Some(path), _) => at_ticks(&record::read(path)?),
        (None, true) => chirp(),
        (None, false) => earthquake(arguments.seed),
    };
    for acceleration in &mut ground {
        *acceleration *= arguments.scale;
    }
    Ok(ground)
}

fn row(
    case: u64,
    plants: &[Plant],
    ground: &[f64],
    arguments: &BenchmarkArguments,
) -> Outcome<Row> {
    let control = match arguments.compensate {
        Compensation::None => Control::None,
        Compensation::Inverse => Control::Inverse,
        Compensation::Ats => Control::Adaptive,
    };
    let sensors = match arguments.sensors {
        Precision::Perfect => Sensors::Perfect,
        Precision::Quantised => Sensors::Quantised,
        Precision::Noisy => Sensors::Noisy,
    };
    let mut row = Row {
        case,
        first: None,
        unstable: 0,
        runs: plants.len(),
        worst: None,
    };
    for (number, plant) in plants.iter().enumerate() {
        let seed = arguments.seed.wrapping_add(number as u64);
        let criteria = match run_case(case as usize, plant, ground, control, sensors, seed) {
            Ok(criteria) => criteria,
            Err(RunError::Unstable { .. }) => {
                row.unstable += 1;
                continue;
            }
            Err(error) => return Err(Failure::new(error.to_string())),
        };
        if number == 0 {
            row.first = Some(criteria);
        }
        let worst = row.worst.get_or_insert(Worst {
            j1_ms: 0.0,
            j2_percent: 0.0,
            j4_percent: 0.0,
            reached_percent: 0.0,
        });
        worst.j1_ms = worst.j1_ms.max(criteria.j1_ms);
        worst.j2_percent = worst.j2_percent.max(criteria.j2_percent);
        worst.j4_percent = worst.j4_percent.max(criteria.j4_percent);
        worst.reached_percent = worst.reached_percent.max(criteria.reached_percent);
    }
    Ok(row)
}

fn text(out: &mut dyn Write, rows: &[Row]) -> io::Result<()> {
    writeln!(
        out,
        "J1: delay, ms. J2, J3: error of the measured displacement, rms and peak, %. J4, J5: first storey against the \
         whole frame, %.\nreached: J2 without the sensor's own error, %."
    )?;
    writeln!(
        out,
        "\n{:>4} {:>7} {:>7} {:>7} {:>7} {:>7} {:>8}   worst of all plants",
        "case", "J1", "J2", "J3", "J4", "J5", "reached"
    )?;
    for row in rows {
        write!(out, "{:>4} ", row.case)?;
        match &row.first {
            Some(first) => write!(
                out,
                "{:7.2} {:7.2} {:7.2} {:7.2} {:7.2} {:8.2}",
                first.j1_ms,
                first.j2_percent,
                first.j3_percent,
                first.j4_percent,
                first.j5_percent,
                first.reached_percent
            )?,
            None => write!(out, "{:>48}", Verdict::Failed.mark("unstable"))?,
        }
        match &row.worst {
            Some(worst) if row.runs > 1 => write!(
                out,
                "   J1 {:.2}, J2 {:.2}, J4 {:.2}, reached {:.2}",
                worst.j1_ms, worst.j2_percent, worst.j4_percent, worst.reached_percent
            )?,
            _ => {}
        }
        match row.unstable {
            0 => writeln!(out)?,
            unstable => writeln!(out, "   {unstable} of {} unstable", row.runs)?,
        }
    }
    Ok(())
}
