//! `health`: loads the model of a real damper into a slot, feeds a measurement and prints the estimates.

use std::io::{self, Write};
use std::path::PathBuf;

use dashpot_core::health::{HealthReading, HealthStatus};
use dashpot_core::link::MAX_MEASURED;
use serde::Serialize;

use super::LinkArguments;
use super::places::{check, place};
use super::target::Target;
use crate::commands::arguments::damper_help;
use crate::commands::failure::Outcome;
use crate::commands::gap_report::write_gaps;
use crate::commands::health_reading::Told;
use crate::commands::print::{counted, nearest_nanosecond};
use crate::commands::progress;
use crate::commands::recording::MeasurementArguments;
use crate::commands::sensors::{SensorArguments, model};
use crate::commands::step_size::StepSize;
use dashpot_files::{damper, input};
use dashpot_host_link::HealthSample;
use dashpot_recording::tick_grid::MeasuredGrid;
use dashpot_recording::{Gaps, Measurement};
use dashpot_testbench::health::{in_words, whole_in_words};

/// Print the health estimates of one slot, optionally after loading a model and feeding a measurement.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot link --link serial:/dev/ttyACM0 health --place 3
  dashpot link --link serial:/dev/ttyACM0 health --place 3 --damper in-service --displacement-noise-m 60e-6 \\
      --force-noise-n 60
  dashpot link --link serial:/dev/ttyACM0 health --place 3 --input run7.csv --every-s 1
  dashpot link --link qemu health --damper my.toml --displacement-noise-m 60e-6 --force-noise-n 60 \\
      --input run7.csv

--damper loads the model of that damper and restarts the estimate; --input alone continues with the loaded model.
The input has the columns time_s,displacement_m,force_n in any order. It is resampled to the target's ticks, without
the gaps.")]
pub(super) struct HealthArguments {
    /// Slot of the bank, from 0.
    #[arg(long, value_name = "PLACE", value_parser = place(), default_value_t = 0)]
    place: u8,
    /// Damper as designed.
    #[arg(help = damper_help("; the model to load"), long, value_name = "NAME|FILE")]
    damper: Option<String>,
    /// Override a key of the damper: table.key=value, such as mount.clearance_m=1e-3.
    #[arg(long = "set", value_name = "KEY=VALUE", requires = "damper")]
    overrides: Vec<String>,
    #[command(flatten)]
    sensors: SensorArguments,
    /// Measured displacement and force of the real damper, CSV; `-` for standard input.
    #[arg(long, value_name = "FILE")]
    input: Option<PathBuf>,
    /// Print the estimate at this interval of the measurement, s.
    #[arg(long, value_name = "S", value_parser = positive, requires = "input")]
    every_s: Option<f64>,
    /// Clear the status after printing it.
    #[arg(long)]
    clear: bool,
    #[command(flatten)]
    recording: MeasurementArguments,
}

fn positive(text: &str) -> Result<f64, &'static str> {
    let number = text.parse().ok();
    number
        .filter(|number: &f64| *number > 0.0 && number.is_finite())
        .ok_or("allowed: a finite number above 0")
}

/// A reading and its time.
#[derive(Serialize)]
struct Timed {
    /// Time of the last sample before the reading (s); `None` if no sample was fed.
    #[serde(skip_serializing_if = "Option::is_none")]
    time_s: Option<f64>,
    #[serde(flatten)]
    values: Told,
}

impl Timed {
    fn new(time_s: Option<f64>, reading: &HealthReading) -> Self {
        Self {
            time_s,
            values: reading.into(),
        }
    }
}

#[derive(Serialize)]
struct Report {
    place: u8,
    /// Damper whose model was loaded.
    #[serde(skip_serializing_if = "Option::is_none")]
    damper: Option<String>,
    /// Number of samples fed.
    fed: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    gaps: Option<Gaps>,
    /// Readings in chronological order.
    readings: Vec<Timed>,
    cleared: bool,
}

/// Runs `health`.
pub(super) fn run(health: &HealthArguments, link: &LinkArguments) -> Outcome<()> {
    let parameters = match &health.damper {
        None => {
            health.sensors.refuse_without("--damper")?;
            None
        }
        Some(name) => {
            let noise = health.sensors.noise_for("--damper")?;
            let parameters = damper::load(name, &health.overrides)?;
            Some((name, parameters, health.sensors.settings(noise)))
        }
    };
    let measurement = health
        .input
        .as_ref()
        .map(|path| Measurement::open(path, &health.recording.channels()));
    let measurement = measurement.transpose()?;
    let mut target = Target::open(&link.line)?;
    check(health.place, &target)?;
    let step_s = StepSize::of_target(target.greeting.step_s)?.step_s();
    if let Some((_, parameters, settings)) = &parameters {
        let model = model(parameters, settings, step_s)?;
        target.client().load_health(health.place, &model)?;
    }
    let mut report = Report {
        place: health.place,
        damper: parameters.map(|(name, ..)| name.clone()),
        fed: 0,
        gaps: None,
        readings: Vec::new(),
        cleared: health.clear,
    };
    let mut time_s = None;
    if let Some(measurement) = measurement {
        let mut ticks = MeasuredGrid::new(measurement, step_s)?;
        feed(health, &mut target, &mut ticks, step_s, &mut report)?;
        let last = report.fed.saturating_sub(1) as f64 * step_s;
        time_s = Some(nearest_nanosecond(ticks.start_s() + last));
        report.gaps = Some(ticks.measurement().gaps());
    }
    let has_last_reading = report
        .readings
        .last()
        .is_some_and(|reading| reading.time_s == time_s);
    if !has_last_reading {
        let reading = target.client().health(health.place)?;
        report.readings.push(Timed::new(time_s, &reading));
    }
    if health.clear {
        target.client().clear_health(health.place)?;
    }
    link.print(&report, print)
}

/// Feeds all samples, and reads the estimate at the requested interval.
fn feed(
    health: &HealthArguments,
    target: &mut Target,
    ticks: &mut MeasuredGrid,
    step_s: f64,
    report: &mut Report,
) -> Outcome<()> {
    let every = health
        .every_s
        .map(|every_s| (every_s / step_s).round().max(1.0) as u64);
    let length = health.input.as_deref().map_or(0, input::length);
    let bar = progress::bar(length, "feed");
    let mut batch = Vec::with_capacity(MAX_MEASURED);
    while let Some(tick) = ticks.next_tick()? {
        batch.push(HealthSample {
            displacement_m: tick.displacement_m as f32,
            force_n: tick.force_n as f32,
        });
        report.fed += 1;
        let is_due = every.is_some_and(|every| report.fed.is_multiple_of(every));
        if is_due || batch.len() == MAX_MEASURED {
            target.client().measure(health.place, &batch)?;
            batch.clear();
        }
        if is_due {
            let reading = target.client().health(health.place)?;
            let time_s = ticks.start_s() + (report.fed - 1) as f64 * step_s;
            let time_s = Some(nearest_nanosecond(time_s));
            report.readings.push(Timed::new(time_s, &reading));
            bar.set_position(ticks.measurement().position());
        }
    }
    target.client().measure(health.place, &batch)?;
    bar.finish_and_clear();
    Ok(())
}

fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    if let Some(damper) = &report.damper {
        writeln!(
            out,
            "slot {}: health model of {damper} loaded",
            report.place
        )?;
    }
    if report.fed > 0 {
        writeln!(out, "{} fed", counted(report.fed, "sample"))?;
    }
    if let Some(gaps) = &report.gaps {
        write_gaps(out, gaps)?;
    }
    writeln!(
        out,
        "{:>10}  {:>15}  {:>17}  {:>15}  {:>15}  {:>9}  status",
        "time, s", "flow factor", "stiffness, kN/mm", "clearance, mm", "lag, ms", "usable"
    )?;
    for reading in &report.readings {
        let time = reading
            .time_s
            .map_or_else(|| "now".into(), |time_s| format!("{time_s:.3}"));
        let values = &reading.values;
        writeln!(
            out,
            "{time:>10}  {:>15}  {:>17}  {:>15}  {:>15}  {:>9}  {}",
            in_words(values.flow_factor, 1.0),
            values.stiffness_in_words(),
            in_words(values.clearance_m, 1e3),
            in_words(values.lag_s, 1e3),
            values.samples,
            if values.status.is_empty() {
                "none".into()
            } else {
                values.status.join(", ")
            }
        )?;
        if values.has(HealthStatus::FORCE_ZERO) {
            writeln!(
                out,
                "            the force sensor has a zero offset of {} N; the estimates are corrected for it",
                whole_in_words(values.force_zero_n)
            )?;
        }
        for doubt in &values.doubts {
            writeln!(out, "            {doubt}")?;
        }
        if values.rejected > 0 {
            writeln!(
                out,
                "            {} rejected",
                counted(values.rejected.into(), "sample")
            )?;
        }
    }
    if report.cleared {
        writeln!(out, "status cleared")?;
    }
    Ok(())
}
