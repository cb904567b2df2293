//! `dashpot replay --health`: what the damper has become whose force was measured on the recorded motion.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use dashpot_core::CheckedParameters;
use dashpot_core::health::{
    Baseline, Estimate, HealthModel, HealthReading, HealthSettings, HealthStatus,
};
use serde::{Deserialize, Serialize};

use super::ReplayArguments;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::streams;
use crate::files::input;
use crate::files::recording::Measurement;
use crate::report::health::page;
use crate::study::health::{ALARMS, History, Noise, watch};
use crate::study::tick_grid::MeasuredGrid;

/// Readings of a page, about.
const READINGS: f64 = 2000.0;

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
    /// Noise of the displacement, standard deviation, m; found in the recording where not given.
    #[arg(
        long,
        value_name = "M",
        requires = "health",
        allow_negative_numbers = true
    )]
    displacement_noise_m: Option<f64>,
    /// Noise of the force, standard deviation, N; found in the recording where not given.
    #[arg(
        long,
        value_name = "N",
        requires = "health",
        allow_negative_numbers = true
    )]
    force_noise_n: Option<f64>,
    /// How much later the force is recorded than the displacement, s; estimated where not given.
    #[arg(
        long,
        value_name = "S",
        requires = "health",
        allow_negative_numbers = true
    )]
    force_lag_s: Option<f64>,
}

impl HealthArguments {
    /// The file of the baseline.
    pub(super) fn baseline(&self) -> Option<&Path> {
        self.health_baseline.as_deref()
    }
}

/// A number and its standard deviation.
#[derive(Clone, Copy, Deserialize, Serialize)]
struct Told {
    value: f32,
    standard_deviation: f32,
}

impl From<Estimate> for Told {
    fn from(Estimate { value, sd }: Estimate) -> Self {
        Self {
            value,
            standard_deviation: sd,
        }
    }
}

#[derive(Serialize)]
struct Alarm {
    parameter: &'static str,
    time_s: f64,
}

/// What was found.
#[derive(Serialize)]
pub(super) struct HealthReport {
    displacement_noise_m: f64,
    force_noise_n: f64,
    flow_factor: Told,
    damping_factor: Told,
    stiffness_n_per_m: Told,
    compliance_m_per_n: Told,
    clearance_m: Told,
    force_lag_s: Told,
    samples: u32,
    rejected: u32,
    little_excitation: bool,
    restarted: bool,
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
    flow_factor: Told,
    compliance_m_per_n: Told,
    clearance_m: Told,
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
        let model = model(arguments, parameters, noise)?;
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

fn measured(arguments: &ReplayArguments) -> Outcome<MeasuredGrid> {
    let measurement = Measurement::open(&arguments.input, &arguments.recording.channels())?;
    Ok(MeasuredGrid::new(measurement, arguments.step_us.step_s())?)
}

/// The noise that is given, or that the first samples have.
fn noise(arguments: &ReplayArguments) -> Outcome<Noise> {
    let options = &arguments.health;
    let given = (options.displacement_noise_m, options.force_noise_n);
    if let (Some(displacement_m), Some(force_n)) = given {
        return Ok(Noise {
            displacement_m,
            force_n,
        });
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
    let found = Noise::found_in(&times_s, &displacements_m, &forces_n, step_s);
    let found = found.filter(|noise| noise.displacement_m > 0.0 && noise.force_n > 0.0);
    let found = found.ok_or_else(|| {
        Failure::new(format!(
            "{}: no noise is found in what does not move, or in less than 100 samples without a gap; \
             give --displacement-noise-m and --force-noise-n",
            input::name(&arguments.input).display()
        ))
    })?;
    Ok(Noise {
        displacement_m: options.displacement_noise_m.unwrap_or(found.displacement_m),
        force_n: options.force_noise_n.unwrap_or(found.force_n),
    })
}

fn model(
    arguments: &ReplayArguments,
    parameters: &CheckedParameters,
    noise: Noise,
) -> Outcome<HealthModel> {
    let mut settings = HealthSettings::new(noise.displacement_m, noise.force_n);
    if let Some(lag_s) = arguments.health.force_lag_s {
        settings.lag_s = lag_s;
        settings.lag_sd_s = 0.0;
    }
    let mut model = parameters.health_model(&settings, arguments.step_us.step_s())?;
    if let Some(path) = &arguments.health.health_baseline {
        let refuse = |reason: String| {
            let name = input::name(path);
            Failure::new(format!(
                "{}: {reason}; allowed: the report of a healthy run, `dashpot replay --health FILE --format json`",
                name.display()
            ))
        };
        let earlier: Earlier = serde_json::from_str(&input::read_text(path)?)
            .map_err(|error| refuse(error.to_string()))?;
        let EarlierHealth {
            flow_factor,
            compliance_m_per_n,
            clearance_m,
        } = earlier.health;
        let baseline = Baseline {
            flow_factor: flow_factor.value,
            compliance_m_per_n: compliance_m_per_n.value,
            clearance_m: clearance_m.value,
            flow_factor_sd: flow_factor.standard_deviation,
            compliance_sd_m_per_n: compliance_m_per_n.standard_deviation,
            clearance_sd_m: clearance_m.standard_deviation,
        };
        model
            .set_baseline(baseline)
            .map_err(|error| refuse(error.to_string()))?;
    }
    Ok(model)
}

/// The estimates along the recording, some thousand of them.
fn history(arguments: &ReplayArguments, model: &HealthModel) -> Outcome<History> {
    let step_s = arguments.step_us.step_s();
    let mut count = 0_u64;
    let mut ticks = measured(arguments)?;
    while ticks.next_tick()?.is_some() {
        count += 1;
    }
    let every_s = (count as f64 * step_s / READINGS).max(step_s);
    let mut ticks = measured(arguments)?;
    let start_s = ticks.start_s();
    let mut failed = None;
    let samples = std::iter::from_fn(|| match ticks.next_tick() {
        Ok(tick) => tick.map(|tick| (tick.displacement_m, tick.force_n)),
        Err(error) => {
            failed = Some(error);
            None
        }
    });
    let mut history = watch(model, samples, every_s);
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
        let name = |alarm: HealthStatus| {
            let known = ALARMS.iter().find(|(known, _)| *known == alarm);
            known.map_or("", |(_, name)| name)
        };
        let alarms = history.alarms.iter().map(|(alarm, time_s)| Alarm {
            parameter: name(*alarm),
            time_s: *time_s,
        });
        Self {
            displacement_noise_m: noise.displacement_m,
            force_noise_n: noise.force_n,
            flow_factor: last.flow_factor.into(),
            damping_factor: last.damping_factor().into(),
            stiffness_n_per_m: last.stiffness_n_per_m.into(),
            compliance_m_per_n: last.compliance_m_per_n.into(),
            clearance_m: last.clearance_m.into(),
            force_lag_s: last.lag_s.into(),
            samples: last.samples,
            rejected: last.rejected,
            little_excitation: last.status.contains(HealthStatus::LITTLE_EXCITATION),
            restarted: last.status.contains(HealthStatus::RESTARTED),
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
        for (name, told, scale, unit) in [
            ("damping over nominal", self.damping_factor, 1.0, ""),
            ("effective stiffness", self.stiffness_n_per_m, 1e-6, " MN/m"),
            ("clearance 2a", self.clearance_m, 1e3, " mm"),
            ("lag of the force", self.force_lag_s, 1e3, " ms"),
        ] {
            writeln!(
                out,
                "{name:<22} {:>12.3} +- {:.3}{unit}",
                told.value * scale,
                told.standard_deviation * scale
            )?;
        }
        for alarm in &self.alarms {
            writeln!(
                out,
                "ALARM: {} differs from the baseline, since {:.1} s",
                alarm.parameter, alarm.time_s
            )?;
        }
        if self.alarms.is_empty() {
            writeln!(out, "no alarm")?;
        }
        if self.little_excitation {
            writeln!(
                out,
                "note: too little motion in contact at the end for an alarm"
            )?;
        }
        if self.restarted {
            writeln!(
                out,
                "warning: the force contradicted the damper for long and the estimate began anew: is it the force of this damper?"
            )?;
        }
        writeln!(out, "wrote {}", self.page)
    }
}
