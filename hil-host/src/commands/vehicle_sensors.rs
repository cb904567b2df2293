//! `dashpot vehicle-sensors`: condition of lateral dampers from accelerometers on body and bogies.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::failure::{Failure, Outcome};
use super::{Format, print_report, streams};
use dashpot_calibration::vehicle_sensors::{
    Assessment, Axis, Baseline, Condition, Factors, Layout, Readings, SensorsError, evaluate,
};
use dashpot_files::input::{self, is_standard_stream};
use dashpot_files::output::write_bytes;
use dashpot_files::vehicle::{self, Replacement};
use dashpot_rail::vehicle::VehicleParameters;
use dashpot_recording::Signals;
use dashpot_vehicle_run::signals::ride;

/// Unit of all readings.
const UNIT: &str = "m/s^2";

/// Find worn lateral dampers of a vehicle from accelerometers on its body and bogies alone.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot vehicle-sensors --vehicle my.toml --input new1.mf4 --input new2.mf4 --new-baseline baseline.json
  dashpot vehicle-sensors --vehicle my.toml --input today.mf4 --baseline baseline.json

The vehicle file names the accelerometers as [[ride_point]]: on the body and on each bogie at least two lateral ones at
different x, and two vertical ones at the same x and different y. The recording has their readings in m/s^2 in columns
such as NAME_lateral_acceleration_m_per_s2, positive to the right, and NAME_vertical_acceleration_m_per_s2, positive
downward, with equal steps and at least 100 rows per second. Method and limits: docs/vehicle-sensors.md.")]
pub struct VehicleSensorsArguments {
    /// Vehicle file with the accelerometers as ride points.
    #[arg(long, value_name = "FILE")]
    vehicle: String,
    /// Recording of a ride. May be repeated: all recordings are evaluated together.
    #[arg(long, value_name = "FILE", required = true)]
    input: Vec<PathBuf>,
    /// Baseline with which the ride is compared: the same vehicle as new.
    #[arg(long, value_name = "FILE", required_unless_present = "new_baseline")]
    baseline: Option<PathBuf>,
    /// Write the factors of this ride, of the vehicle as new, as a baseline.
    #[arg(long, value_name = "FILE", conflicts_with = "baseline")]
    new_baseline: Option<PathBuf>,
    /// Column of a reading, if it has another name in the recording. May be repeated.
    #[arg(long = "signal", value_name = "READING=COLUMN", value_parser = pair)]
    signals: Vec<(String, String)>,
    /// Lateral readings have no gravity by the roll of their body, as in a history of `dashpot vehicle`. A real
    /// accelerometer reads it.
    #[arg(long)]
    without_gravity: bool,
    /// Replace dampers by a preset or file, such as lateral=in-service. May be repeated.
    #[arg(long = "damper", value_name = "WHICH=DAMPER")]
    dampers: Vec<Replacement>,
    /// Override a value of the vehicle file: part.key=value, such as body.mass_kg=70e3. May be repeated.
    #[arg(long = "set", value_name = "PART.KEY=VALUE")]
    overrides: Vec<String>,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

fn pair(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((reading, column)) if !reading.is_empty() && !column.is_empty() => {
            Ok((reading.to_owned(), column.to_owned()))
        }
        _ => Err("allowed: READING=COLUMN".into()),
    }
}

/// Runs the command.
///
/// # Errors
/// The vehicle, a recording or the baseline is invalid, or the ride does not determine the factors.
pub fn run(arguments: &VehicleSensorsArguments) -> Outcome<()> {
    streams::refuse_twice("--input", &arguments.input)?;
    let mut read: Vec<(&str, &Path)> = arguments
        .input
        .iter()
        .map(|path| ("--input", &**path))
        .collect();
    read.push(("--vehicle", Path::new(&arguments.vehicle)));
    read.extend(
        arguments
            .baseline
            .as_deref()
            .map(|path| ("--baseline", path)),
    );
    streams::refuse_second_standard_input(&read)?;
    if let Some(output) = &arguments.new_baseline {
        for (_, path) in &read {
            streams::refuse_input("--new-baseline", output, path)?;
        }
    }
    let baseline = arguments
        .baseline
        .as_deref()
        .map(read_baseline)
        .transpose()?;
    let vehicle = vehicle::load_with(&arguments.vehicle, &arguments.dampers, &arguments.overrides)?;
    let in_vehicle = |error: SensorsError| Failure::new(format!("{}: {error}", arguments.vehicle));
    let layout = Layout::new(&vehicle).map_err(in_vehicle)?;
    let readings = arguments
        .input
        .iter()
        .map(|path| arguments.readings(path, &vehicle));
    let readings: Vec<Readings> = readings.collect::<Outcome<_>>()?;
    let factors = evaluate(&layout, &readings).map_err(|error| Failure::new(error.to_string()))?;
    match (&baseline, &arguments.new_baseline) {
        (Some((path, baseline)), _) => {
            let checked = baseline.check_for(&layout, &factors.sensors);
            checked.map_err(|error| Failure::new(format!("{}: {error}", path.display())))?;
            let report = Report {
                vehicle: &layout.vehicle,
                left_out: &layout.left_out,
                baseline,
                assessment: Assessment::new(&layout, &factors, baseline),
            };
            print_report(arguments.format, &report, |out, report| report.print(out))
        }
        (None, output) => {
            let output = output.as_deref().unwrap_or(Path::new("-"));
            new_baseline(arguments, &layout, factors, output)
        }
    }
}

fn read_baseline(path: &Path) -> Outcome<(&Path, Baseline)> {
    let text = input::read_text(path)?;
    let baseline = serde_json::from_str(&text).map_err(|error| {
        let allowed = "allowed: a file that --new-baseline has written";
        Failure::new(format!(
            "{}: {error}; {allowed}",
            input::name(path).display()
        ))
    })?;
    Ok((path, baseline))
}

/// Writes a baseline, and prints its factors.
fn new_baseline(
    arguments: &VehicleSensorsArguments,
    layout: &Layout,
    factors: Factors,
    output: &Path,
) -> Outcome<()> {
    let baseline =
        Baseline::new(layout, factors).map_err(|error| Failure::new(error.to_string()))?;
    let mut text =
        serde_json::to_string_pretty(&baseline).map_err(|error| Failure::new(error.to_string()))?;
    text.push('\n');
    write_bytes(output, text.as_bytes())?;
    if is_standard_stream(output) {
        return Ok(());
    }
    print_report(arguments.format, &baseline, |out, baseline| {
        let sensors = baseline.sensors.len();
        writeln!(
            out,
            "{}: baseline from {sensors} accelerometers, {} s of ride",
            baseline.vehicle, baseline.seconds
        )?;
        let values = baseline.names.iter().zip(&baseline.factors).enumerate();
        let rows = values.map(|(row, (name, value))| {
            [
                name.clone(),
                format!("{value:.3}"),
                format!("{:.3}", baseline.covariance[row][row].sqrt()),
            ]
        });
        print_rows(out, ["force", "factor", "deviation"], rows)?;
        writeln!(out, "unexplained {:.1} %", 100.0 * baseline.unexplained)?;
        print_left_out(out, &layout.left_out)?;
        writeln!(out, "wrote {}", output.display())
    })
}

impl VehicleSensorsArguments {
    /// Reads the accelerometers of a recording.
    fn readings(&self, path: &Path, vehicle: &VehicleParameters) -> Outcome<Readings> {
        let mut known = Vec::new();
        for point in &vehicle.ride_points {
            known.extend([Axis::Lateral, Axis::Vertical].map(|axis| (point.name.clone(), axis)));
        }
        if known.is_empty() {
            let what = "no accelerometers; allowed: a [[ride_point]] for each, on the body and on both bogies";
            return Err(Failure::new(format!("{}: {what}", self.vehicle)));
        }
        let names: Vec<String> = ride(vehicle)
            .iter()
            .map(|signal| signal.name().to_owned())
            .collect();
        if let Some((reading, _)) = self
            .signals
            .iter()
            .find(|(reading, _)| !names.contains(reading))
        {
            let near = dashpot_files::did_you_mean(reading, names.iter().map(String::as_str));
            return Err(Failure::wrong_use(format!(
                "--signal: unknown reading {reading}{near}"
            )));
        }
        let column = |name: &String| {
            let renamed = self.signals.iter().find(|(reading, _)| reading == name);
            renamed.map_or(name, |(_, column)| column).clone()
        };
        let columns: Vec<String> = names.iter().map(column).collect();
        let wanted: Vec<(&str, &str)> = columns.iter().map(|name| (&**name, UNIT)).collect();
        let signals = Signals::read(path, &wanted)?;
        let has: Vec<bool> = signals.has().collect();
        let missing = self.signals.iter().find(|(_, column)| {
            columns
                .iter()
                .zip(&has)
                .any(|(name, has)| name == column && !has)
        });
        if let Some((_, column)) = missing {
            return Err(Failure::new(format!(
                "{}: no column {column}",
                input::name(path).display()
            )));
        }
        let mut values = vec![Vec::new(); names.len()];
        let mut row = Vec::new();
        for number in 0..signals.times_s().len() {
            signals.row(number, &mut row);
            for (values, value) in values.iter_mut().zip(&row) {
                values.push(f64::from(*value));
            }
        }
        let sensors = known
            .into_iter()
            .zip(values)
            .zip(has)
            .filter(|(_, has)| *has);
        let sensors = sensors
            .map(|(((point, axis), values), _)| (point, axis, values))
            .collect();
        let name = input::name(path).display().to_string();
        let readings = Readings::new(&name, signals.times_s(), sensors)
            .map_err(|error| Failure::new(error.to_string()))?;
        Ok(match self.without_gravity {
            true => readings.without_gravity(),
            false => readings,
        })
    }
}

/// Condition of a vehicle, and what it rests on.
#[derive(Serialize)]
struct Report<'a> {
    vehicle: &'a str,
    #[serde(flatten)]
    assessment: Assessment,
    baseline: &'a Baseline,
    left_out: &'a [String],
}

impl Report<'_> {
    fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        let found = &self.assessment;
        let sensors = self.baseline.sensors.len();
        writeln!(
            out,
            "{}: lateral dampers from {sensors} accelerometers, {} s of ride",
            self.vehicle, found.seconds
        )?;
        let bogies = found.bogies.iter().map(|bogie| {
            let verdict = match (bogie.condition, &bogie.damper) {
                (Condition::AsNew, _) => "as new".to_owned(),
                (Condition::Undecided, _) => "undecided".to_owned(),
                (Condition::Worn, None) => "worn".to_owned(),
                (Condition::Worn, Some(damper)) => format!("worn: {damper}"),
            };
            [
                bogie.bogie.clone(),
                format!("{:.2}", bogie.ratio),
                format!("{:.2}", bogie.deviation),
                verdict,
            ]
        });
        print_rows(out, ["bogie", "force left", "deviation", "verdict"], bogies)?;
        let dampers = found.dampers.iter().map(|damper| {
            [
                damper.damper.clone(),
                format!("{:.2}", damper.ratio),
                format!("{:.2}", damper.deviation),
            ]
        });
        print_rows(out, ["damper", "force left", "deviation"], dampers)?;
        let others = found
            .others
            .iter()
            .map(|other| [other.name.clone(), format!("{:.2}", other.ratio)]);
        print_rows(out, ["other forces", "ratio"], others)?;
        writeln!(
            out,
            "unexplained {:.1} % ({:.1} % in the baseline)",
            100.0 * found.unexplained,
            100.0 * self.baseline.unexplained
        )?;
        if found.seconds_at_stop > 0 {
            writeln!(
                out,
                "{} s left out: the body reached a lateral stop",
                found.seconds_at_stop
            )?;
        }
        if found.in_doubt {
            let what = "no verdict: the balance of forces does not explain this ride";
            writeln!(
                out,
                "{what}; check the sensors, their signs and their times"
            )?;
        } else if found
            .bogies
            .iter()
            .any(|bogie| bogie.condition == Condition::Undecided)
        {
            writeln!(
                out,
                "undecided: neither certainly worn (below 0.85) nor certainly as new; add recordings"
            )?;
        }
        print_left_out(out, self.left_out)
    }
}

/// Prints a table: names and verdicts to the left, numbers to the right.
fn print_rows<const N: usize>(
    out: &mut dyn Write,
    heads: [&str; N],
    rows: impl Iterator<Item = [String; N]>,
) -> io::Result<()> {
    let rows: Vec<_> = std::iter::once(heads.map(String::from))
        .chain(rows)
        .collect();
    let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
    for row in &rows {
        let cell = |(column, text): (usize, &String)| match column {
            0 | 3 => format!("{text:0$}", width(column)),
            _ => format!("{text:>0$}", width(column)),
        };
        let cells: Vec<String> = row.iter().enumerate().map(cell).collect();
        writeln!(out, "{}", cells.join("  ").trim_end())?;
    }
    writeln!(out)
}

fn print_left_out(out: &mut dyn Write, left_out: &[String]) -> io::Result<()> {
    match left_out {
        [] => Ok(()),
        names => writeln!(
            out,
            "forces that the balance leaves out: {}",
            names.join(", ")
        ),
    }
}
