//! `dashpot replay --health`: what the damper has become whose force was measured on the recorded motion.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use dashpot_core::CheckedParameters;
use dashpot_core::health::{Baseline, Estimate, HealthModel, HealthReading, HealthStatus};
use serde::{Deserialize, Serialize};

use super::ReplayArguments;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::health_reading::Told;
use crate::commands::sensors::{SensorArguments, model};
use crate::commands::streams;
use dashpot_files::input;
use dashpot_recording::Measurement;
use dashpot_recording::tick_grid::MeasuredGrid;
use dashpot_report::health::page;
use dashpot_testbench::health::{
    History, Noise, alarm_in_words, alarm_name, doubts_in_words, in_words, watch, whole_in_words,
};

/// Samples that the noise is found from, where it is not given.
const NOISE_SAMPLES: usize = 20_000;

/// Options of the health.
#[derive(Debug, Clone, Default, clap::Args)]
#[command(next_help_heading = "Health, from the force that was measured")]
pub(super) struct HealthArguments {
    /// Page of the damper's health over time, HTML; its measured force is the recording's channel of the force.
    #[arg(long, value_name = "FILE")]
    health: Option<PathBuf>,
    /// What it is compared with: the report of a healthy run, as --format json prints it; the damper as it is named where not given.
    #[arg(long, value_name = "FILE", requires = "health")]
    health_baseline: Option<PathBuf>,
    /// Noise that is not given is found in the recording.
    #[command(flatten)]
    sensors: SensorArguments,
}

impl HealthArguments {
    /// The file of the baseline.
    pub(super) fn baseline(&self) -> Option<&Path> {
        self.health_baseline.as_deref()
    }
}

#[derive(Serialize)]
struct Alarm {
    parameter: &'static str,
    time_s: f64,
    #[serde(skip)]
    sentence: String,
}

/// What was found.
#[derive(Serialize)]
pub(super) struct HealthReport {
    displacement_noise_m: f64,
    force_noise_n: f64,
    #[serde(flatten)]
    told: Told,
    alarms: Vec<Alarm>,
    page: String,
}

/// The estimates of a baseline, among all else that a report has.
#[derive(Deserialize)]
struct Earlier {
    health: EarlierHealth,
}

#[derive(Deserialize)]
struct EarlierHealth {
    flow_factor: Estimate,
    compliance_m_per_n: Estimate,
    clearance_m: Estimate,
}

/// A recording that was watched, its page not yet written.
pub(super) struct Watched {
    page: PathBuf,
    text: String,
    report: HealthReport,
}

impl Watched {
    /// The health of the damper of which the recording has the force; `None` where none was asked for.
    ///
    /// # Errors
    /// A recording without a force, or that cannot be read twice; a setting out of its range; a baseline that is none.
    pub(super) fn of(
        arguments: &ReplayArguments,
        parameters: &CheckedParameters,
    ) -> Outcome<Option<Self>> {
        let options = &arguments.health;
        let Some(page_path) = &options.health else {
            options.sensors.refuse_without("--health")?;
            return Ok(None);
        };
        if input::is_standard_stream(&arguments.input) {
            return Err(Failure::wrong_use(
                "--health: the recording is read more than once; allowed for --input: a file, not standard input",
            ));
        }
        if input::is_standard_stream(page_path) {
            return Err(Failure::wrong_use("--health -: allowed: a file"));
        }
        for input in arguments.inputs() {
            streams::refuse_input("--health", page_path, input)?;
        }
        streams::refuse_same_output(&[
            ("--output", Some(&arguments.output)),
            ("--health", Some(page_path)),
        ])?;
        let noise = noise(arguments)?;
        let settings = options.sensors.settings(noise);
        let mut model = model(parameters, &settings, arguments.step_us.step_s())?;
        if let Some(path) = &options.health_baseline {
            let set = model.set_baseline(baseline(path)?);
            set.map_err(|error| no_baseline(path, error))?;
        }
        let history = history(arguments, &model)?;
        let Some(last) = history.last() else {
            return Err(Failure::new("nothing was watched"));
        };
        let title = format!(
            "{} on {}",
            arguments.damper.damper,
            input::name(&arguments.input).display()
        );
        Ok(Some(Self {
            text: page(&title, &history)?,
            report: HealthReport::new(last, &history, noise, page_path.display().to_string()),
            page: page_path.clone(),
        }))
    }

    /// The page and its text.
    pub(super) fn page(&self) -> (&Path, &str) {
        (&self.page, &self.text)
    }

    /// The report.
    pub(super) fn report(self) -> HealthReport {
        self.report
    }
}

/// The noise that is given, or that the first samples have.
fn noise(arguments: &ReplayArguments) -> Outcome<Noise> {
    let sensors = &arguments.health.sensors;
    if let Some(noise) = sensors.noise() {
        return Ok(noise);
    }
    let mut measurement = Measurement::open(&arguments.input, &arguments.recording.channels())?;
    let (mut times_s, mut displacements_m, mut forces_n) = (Vec::new(), Vec::new(), Vec::new());
    while times_s.len() < NOISE_SAMPLES {
        let Some(sample) = measurement.next_sample()? else {
            break;
        };
        times_s.push(sample.time_s);
        displacements_m.push(sample.displacement_m);
        forces_n.push(sample.force_n);
    }
    let step_s = arguments.step_us.step_s();
    let found = Noise::estimate(&times_s, &displacements_m, &forces_n, step_s);
    let found = found.filter(|noise| noise.displacement_m > 0.0 && noise.force_n > 0.0);
    let found = found.ok_or_else(|| {
        Failure::new(format!(
            "{}: no noise is found in what does not move, or in less than 100 samples without a gap; \
             give --displacement-noise-m and --force-noise-n",
            input::name(&arguments.input).display()
        ))
    })?;
    Ok(Noise {
        displacement_m: sensors.displacement_noise_m.unwrap_or(found.displacement_m),
        force_n: sensors.force_noise_n.unwrap_or(found.force_n),
    })
}

/// What the report of an earlier run has found.
fn baseline(path: &Path) -> Outcome<Baseline> {
    let earlier: Result<Earlier, _> = serde_json::from_str(&input::read_text(path)?);
    let EarlierHealth {
        flow_factor,
        compliance_m_per_n,
        clearance_m,
    } = earlier.map_err(|error| no_baseline(path, error))?.health;
    Ok(Baseline {
        flow_factor: flow_factor.value,
        compliance_m_per_n: compliance_m_per_n.value,
        clearance_m: clearance_m.value,
        flow_factor_sd: flow_factor.sd,
        compliance_sd_m_per_n: compliance_m_per_n.sd,
        clearance_sd_m: clearance_m.sd,
    })
}

fn no_baseline(path: &Path, reason: impl std::fmt::Display) -> Failure {
    Failure::new(format!(
        "{}: {reason}; allowed: the report of a healthy run, `dashpot replay --health FILE --format json`",
        input::name(path).display()
    ))
}

/// The estimates along the recording.
fn history(arguments: &ReplayArguments, model: &HealthModel) -> Outcome<History> {
    let step_s = arguments.step_us.step_s();
    let measurement = Measurement::open(&arguments.input, &arguments.recording.channels())?;
    let mut ticks = MeasuredGrid::new(measurement, step_s)?;
    let start_s = ticks.start_s();
    let mut failed = None;
    let samples = std::iter::from_fn(|| match ticks.next_tick() {
        Ok(tick) => tick.map(|tick| (tick.displacement_m, tick.force_n)),
        Err(error) => {
            failed = Some(error);
            None
        }
    });
    let mut history = watch(model, samples, step_s);
    for reading in &mut history.readings {
        reading.time_s += start_s;
    }
    for (_, time_s) in &mut history.alarms {
        *time_s += start_s;
    }
    failed.map_or(Ok(history), |error| Err(error.into()))
}

impl HealthReport {
    fn new(last: &HealthReading, history: &History, noise: Noise, page: String) -> Self {
        let alarms = history.alarms.iter().map(|(alarm, time_s)| Alarm {
            parameter: alarm_name(*alarm),
            time_s: *time_s,
            sentence: alarm_in_words(*alarm, last),
        });
        Self {
            displacement_noise_m: noise.displacement_m,
            force_noise_n: noise.force_n,
            told: last.into(),
            alarms: alarms.collect(),
            page,
        }
    }

    /// For people.
    ///
    /// # Errors
    /// The output cannot be written.
    pub(super) fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(
            out,
            "\nhealth at the end, of the force measured (noise {:.3} mm, {:.0} N), with standard deviations",
            self.displacement_noise_m * 1e3,
            self.force_noise_n
        )?;
        for (name, told, unit) in [
            (
                "damping over nominal",
                in_words(self.told.damping_factor, 1.0),
                "",
            ),
            (
                "effective stiffness",
                self.told.stiffness_in_words(),
                " MN/m",
            ),
            ("clearance 2a", in_words(self.told.clearance_m, 1e3), " mm"),
            ("lag of the force", in_words(self.told.lag_s, 1e3), " ms"),
            (
                "zero of the force",
                whole_in_words(self.told.force_zero_n),
                " N",
            ),
            (
                "added friction",
                whole_in_words(self.told.added_friction_n),
                " N",
            ),
        ] {
            writeln!(out, "{name:<22} {told:>20}{unit}")?;
        }
        for alarm in &self.alarms {
            writeln!(
                out,
                "ALARM: {}, since {:.1} s",
                alarm.sentence, alarm.time_s
            )?;
        }
        if self.alarms.is_empty() {
            writeln!(out, "no alarm")?;
        }
        for doubt in doubts_in_words(self.told.bits) {
            writeln!(out, "warning: {doubt}")?;
        }
        if self.told.has(HealthStatus::LITTLE_EXCITATION) {
            writeln!(
                out,
                "note: too little motion in contact at the end for an alarm"
            )?;
        }
        if self.told.has(HealthStatus::RESTARTED) {
            writeln!(
                out,
                "warning: the force contradicted the damper for long and the estimate began anew: is it the force of this damper?"
            )?;
        }
        writeln!(out, "wrote {}", self.page)
    }
}
