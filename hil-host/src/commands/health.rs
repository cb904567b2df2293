//! `dashpot health`: trends of the dampers of a fleet over its recordings.

use std::path::{Path, PathBuf};

use super::failure::{Failure, Outcome};
use super::recording::MeasurementArguments;
use super::sensors::{self, SensorArguments};
use super::step_size::{self, StepSize};
use super::{DamperArguments, Format, counted, print_report_beside, progress, streams};
use dashpot_files::input::is_standard_stream;
use dashpot_files::output::{cannot_write_rows, write_bytes};
use dashpot_recording::table;
use dashpot_report::fleet;
use dashpot_testbench::health::Noise;
use dashpot_testbench::trend::limits::Limits;
use dashpot_testbench::trend::reading::Estimation;
use dashpot_testbench::trend::recordings::{INDEX, list};
use dashpot_testbench::trend::rows::{TEXTS, csv};
use dashpot_testbench::trend::{Axis, Fleet, Summary, series};

/// Noise for checking the other settings where it is estimated from each recording.
const ANY_NOISE: Noise = Noise {
    displacement_m: 1e-5,
    force_n: 1.0,
};

/// Estimate trends of a fleet's dampers over months of recordings: rates of change, and when limits are reached.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot health --history fleet --damper in-service --page fleet.html
  dashpot health --history fleet --mileage --output readings.parquet --trends trends.csv
  dashpot health --history fleet --limit-clearance-m 2e-3 --format json

The file recordings.csv in the folder lists the recordings: vehicle, damper, date, file; optional columns are
mileage_km, temperature_c, serial_number, kind (vertical, lateral, yaw) and model. Without it, files must be named
VEHICLE/DAMPER/DATE.EXTENSION, such as 401/front-left-secondary/2026-03-14.mf4.
The damper to look at first comes first. Readings in doubt and files that cannot be read are listed with the reason;
the exit code is 1 if a file cannot be read. Method and limits: docs/health.md, docs/out-of-service.md.")]
pub struct HealthArguments {
    /// Folder with the recordings.
    #[arg(long, value_name = "FOLDER")]
    history: PathBuf,
    #[command(flatten)]
    damper: DamperArguments,
    /// Use the mileage instead of the date.
    #[arg(long)]
    mileage: bool,
    /// Page of the fleet, a self-contained HTML file.
    #[arg(long, value_name = "FILE")]
    page: Option<PathBuf>,
    /// Table of the readings, one row per recording: CSV, or Parquet (.parquet) by extension.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Table of the trends, one row per damper and parameter: CSV, or Parquet (.parquet) by extension.
    #[arg(long, value_name = "FILE")]
    trends: Option<PathBuf>,
    /// Lowest damping, relative to nominal [default: 0.87].
    #[arg(long, value_name = "PART", value_parser = positive, allow_negative_numbers = true)]
    limit_damping_factor: Option<f64>,
    /// Lowest effective stiffness, N/m [default: by kind of damper].
    #[arg(long, value_name = "N/M", value_parser = positive, allow_negative_numbers = true)]
    limit_stiffness_n_per_m: Option<f64>,
    /// Highest clearance, m [default: by kind of damper].
    #[arg(long, value_name = "M", value_parser = positive, allow_negative_numbers = true)]
    limit_clearance_m: Option<f64>,
    /// Use readings of which several parameters have changed together: wear, or the wrong scale of a sensor.
    #[arg(long)]
    accept_several_changed: bool,
    /// Step, us.
    #[arg(help = step_size::help("Step", ""), long, default_value = "1000", value_name = "US",
          allow_negative_numbers = true)]
    step_us: StepSize,
    #[command(flatten)]
    recording: MeasurementArguments,
    /// Noise that is not given is estimated from each recording.
    #[command(flatten)]
    sensors: SensorArguments,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

fn positive(text: &str) -> Result<f64, String> {
    let number = text
        .parse()
        .ok()
        .filter(|number: &f64| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| "allowed: a number above 0".into())
}

/// Runs the command.
///
/// # Errors
/// The folder, its index or the damper is invalid, an output cannot be written, or a recording cannot be read.
pub fn run(arguments: &HealthArguments) -> Outcome<()> {
    for (option, path) in [
        ("--history", &*arguments.history),
        ("--damper", Path::new(&arguments.damper.damper)),
    ] {
        if is_standard_stream(path) {
            return Err(Failure::wrong_use(format!(
                "{option} -: not standard input; allowed: a file or folder"
            )));
        }
    }
    let outputs = [
        ("--page", &arguments.page),
        ("--output", &arguments.output),
        ("--trends", &arguments.trends),
    ];
    let outputs = outputs.map(|(option, path)| (option, path.as_deref()));
    streams::refuse_same_output(&outputs)?;
    for (option, path) in outputs.iter().skip(1) {
        let checked = path.map_or(Ok(()), table::check);
        checked.map_err(|reason| Failure::wrong_use(format!("{option} {reason}")))?;
    }
    let estimation = estimation(arguments)?;
    let listed = list(&arguments.history)?;
    let inputs = listed.iter().map(|listed| listed.file.clone());
    for input in inputs.chain([arguments.history.join(INDEX)]) {
        for (option, path) in outputs {
            path.map_or(Ok(()), |path| streams::refuse_input(option, path, &input))?;
        }
    }
    let axis = match arguments.mileage {
        true => Axis::Mileage,
        false => Axis::Date,
    };
    let bar = progress::bar(listed.len() as u64, "recordings");
    let (placed, unplaced) = series::series(listed, axis);
    let threads = dashpot_workers::threads();
    let recorded = series::estimate(&placed, &estimation, threads, |done| bar.inc(done));
    bar.finish_and_clear();
    let limits = Limits {
        damping_factor: arguments.limit_damping_factor,
        stiffness_n_per_m: arguments.limit_stiffness_n_per_m,
        clearance_m: arguments.limit_clearance_m,
    };
    let fleet = Fleet::assess(axis, &placed, recorded, unplaced, &limits);
    let mut report = Summary::new(&fleet);
    if let Some(path) = &arguments.page {
        let title = format!(
            "{}, with the model {}",
            folder_name(&arguments.history),
            arguments.damper.damper
        );
        write_bytes(path, fleet::page(&title, &fleet)?.as_bytes())?;
        report.files.push(path.display().to_string());
    }
    for (path, is_readings) in [(&arguments.output, true), (&arguments.trends, false)] {
        let Some(path) = path else { continue };
        let rows = match is_readings {
            true => csv(&fleet.reading_rows()),
            false => csv(&report.trends),
        };
        let rows = rows.map_err(|error| cannot_write_rows(path, error))?;
        table::write(path, &rows, &TEXTS)?;
        report.files.push(path.display().to_string());
    }
    let data = outputs
        .iter()
        .find_map(|(_, path)| path.filter(|path| is_standard_stream(path)));
    print_report_beside(
        data.unwrap_or(Path::new("")),
        arguments.format,
        &report,
        |out, report| write!(out, "{}", report.text()),
    )?;
    match fleet.unreadable() {
        0 => Ok(()),
        count => Err(Failure::new(format!(
            "{} cannot be read",
            counted(count as u64, "recording")
        ))),
    }
}

/// Name of a folder, also of `.`.
fn folder_name(folder: &Path) -> String {
    let whole = folder.canonicalize();
    let whole = whole.unwrap_or_else(|_| folder.to_owned());
    let name = whole.file_name().unwrap_or(whole.as_os_str());
    name.to_string_lossy().into_owned()
}

/// Checks the settings with the damper of the options; those of single recordings are checked with them.
fn estimation(arguments: &HealthArguments) -> Outcome<Estimation> {
    let sensors = &arguments.sensors;
    let settings = sensors.settings(Noise {
        displacement_m: sensors
            .displacement_noise_m
            .unwrap_or(ANY_NOISE.displacement_m),
        force_n: sensors.force_noise_n.unwrap_or(ANY_NOISE.force_n),
    });
    let step_s = arguments.step_us.step_s();
    let parameters = arguments.damper.load()?;
    sensors::model(&parameters, &settings, step_s)?;
    Ok(Estimation {
        damper: arguments.damper.damper.clone(),
        parameters,
        channels: arguments.recording.channels(),
        step_s,
        settings,
        estimates_displacement_noise: sensors.displacement_noise_m.is_none(),
        estimates_force_noise: sensors.force_noise_n.is_none(),
        accepts_several_changed: arguments.accept_several_changed,
    })
}
