//! `dashpot replay --health`: estimates the health of a damper from its recorded motion and measured force.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use dashpot_core::CheckedParameters;
use dashpot_core::health::{Baseline, Estimate, HealthReading, HealthStatus};
use serde::{Deserialize, Serialize};

use super::ReplayArguments;
use super::causes::{causes, likely};
use crate::commands::failure::{Failure, Outcome};
use crate::commands::gap_report::interpolated;
use crate::commands::health_reading::Told;
use crate::commands::sensors::{SensorArguments, model};
use crate::commands::streams;
use dashpot_calibration::cause::Causes;
use dashpot_files::input;
use dashpot_recording::{Interpolation, Measurement};
use dashpot_report::health::{LikelyCauses, page};
use dashpot_testbench::health::{
    History, Noise, alarm_in_words, alarm_name, in_words, whole_in_words,
};
use dashpot_testbench::recorded_health::{self, NOISE_NEEDS};

/// Options of the health estimate.
#[derive(Debug, Clone, Default, clap::Args)]
pub(super) struct HealthArguments {
    /// HTML page with the damper's health over time. The recording must contain the measured force.
    #[arg(long, value_name = "FILE")]
    health: Option<PathBuf>,
    /// Baseline: report of a healthy run, printed by --format json [default: the damper given by --damper].
    #[arg(long, value_name = "FILE", requires = "health")]
    health_baseline: Option<PathBuf>,
    /// Noise that is not given is estimated from the recording.
    #[command(flatten)]
    sensors: SensorArguments,
}

impl HealthArguments {
    /// True if the health page is asked for.
    pub(super) fn is_wanted(&self) -> bool {
        self.health.is_some()
    }

    /// Returns the path of the baseline.
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

/// Report of the health estimate.
#[derive(Serialize)]
pub(super) struct HealthReport {
    displacement_noise_m: f64,
    force_noise_n: f64,
    #[serde(flatten)]
    values: Told,
    alarms: Vec<Alarm>,
    /// Likely causes of a change; `None` with a baseline, to which the bank of causes knows no way.
    causes: Option<Causes>,
    page: String,
    /// How the force was brought to the times of the displacement, if it is in another group.
    #[serde(skip_serializing_if = "Option::is_none")]
    interpolation: Option<Interpolation>,
}

/// The part of an earlier report that is used as the baseline.
#[derive(Deserialize)]
struct Earlier {
    health: EarlierHealth,
}

#[derive(Deserialize)]
struct EarlierHealth {
    flow_factor: Estimate,
    compliance_m_per_n: Estimate,
    clearance_m: Estimate,
    samples: u32,
    rejected: u32,
}

/// A finished health estimate whose page is not yet written.
pub(super) struct Watched {
    page: PathBuf,
    text: String,
    report: HealthReport,
}

impl Watched {
    /// Estimates the health of the recorded damper; `None` without `--health`.
    ///
    /// # Errors
    /// The recording has no force or cannot be read twice, a setting is out of range, or the baseline is invalid.
    pub(super) fn estimate(
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
                "--health: the recording is read more than once; --input must be a file, not standard input",
            ));
        }
        if input::is_standard_stream(page_path) {
            return Err(Failure::wrong_use(
                "--health -: give a file; the page cannot go to standard output",
            ));
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
        let step_s = arguments.step_us.step_s();
        let channels = arguments.recording.channels();
        let measurement = Measurement::open(&arguments.input, &channels)?;
        let (history, interpolation) =
            recorded_health::history(measurement, &model, step_s, step_s)?;
        let Some(last) = history.last() else {
            return Err(Failure::new(
                "the recording has no samples to estimate from",
            ));
        };
        let title = format!(
            "{} on {}",
            arguments.damper.damper,
            input::name(&arguments.input).display()
        );
        let causes = match options.health_baseline {
            Some(_) => None,
            None => causes(arguments, parameters)?,
        };
        let told = causes.as_ref().map(likely);
        let mut report = HealthReport::new(last, &history, noise, page_path.display().to_string());
        report.causes = causes;
        report.interpolation = interpolation;
        Ok(Some(Self {
            text: page(&title, &history, told.as_ref())?,
            report,
            page: page_path.clone(),
        }))
    }

    /// Returns the path and the text of the page.
    pub(super) fn page(&self) -> (&Path, &str) {
        (&self.page, &self.text)
    }

    /// Returns the report.
    pub(super) fn report(self) -> HealthReport {
        self.report
    }
}

/// Returns the given noise, or estimates it from the first samples.
fn noise(arguments: &ReplayArguments) -> Outcome<Noise> {
    let sensors = &arguments.health.sensors;
    if let Some(noise) = sensors.noise() {
        return Ok(noise);
    }
    let channels = arguments.recording.channels();
    let measurement = Measurement::open(&arguments.input, &channels)?;
    let found = recorded_health::noise(measurement, arguments.step_us.step_s())?;
    let found = found.ok_or_else(|| {
        Failure::new(format!(
            "{}: {NOISE_NEEDS}; give --displacement-noise-m and --force-noise-n",
            input::name(&arguments.input).display()
        ))
    })?;
    Ok(Noise {
        displacement_m: sensors.displacement_noise_m.unwrap_or(found.displacement_m),
        force_n: sensors.force_noise_n.unwrap_or(found.force_n),
    })
}

/// Reads the baseline from the report of an earlier run.
fn baseline(path: &Path) -> Outcome<Baseline> {
    let earlier: Result<Earlier, _> = serde_json::from_str(&input::read_text(path)?);
    let EarlierHealth {
        flow_factor,
        compliance_m_per_n,
        clearance_m,
        samples,
        rejected,
    } = earlier.map_err(|error| no_baseline(path, error))?.health;
    let estimates = [flow_factor, compliance_m_per_n, clearance_m];
    recorded_health::baseline(estimates, samples, rejected)
        .map_err(|reason| no_baseline(path, reason))
}

fn no_baseline(path: &Path, reason: impl std::fmt::Display) -> Failure {
    Failure::new(format!(
        "{}: {reason}; allowed: the report of a healthy run, from `dashpot replay --health FILE --format json`",
        input::name(path).display()
    ))
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
            values: last.into(),
            alarms: alarms.collect(),
            causes: None,
            page,
            interpolation: None,
        }
    }

    /// Prints the report as text.
    ///
    /// # Errors
    /// The output cannot be written.
    pub(super) fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(
            out,
            "\nhealth at the end of the recording (noise {:.3} mm, {:.0} N), with standard deviations",
            self.displacement_noise_m * 1e3,
            self.force_noise_n
        )?;
        for (name, value, unit) in [
            (
                "damping over nominal",
                in_words(self.values.damping_factor, 1.0),
                "",
            ),
            (
                "effective stiffness",
                self.values.stiffness_in_words(),
                " MN/m",
            ),
            (
                "clearance 2a",
                in_words(self.values.clearance_m, 1e3),
                " mm",
            ),
            ("force lag", in_words(self.values.lag_s, 1e3), " ms"),
            (
                "force sensor zero",
                whole_in_words(self.values.force_zero_n),
                " N",
            ),
            (
                "added friction",
                whole_in_words(self.values.added_friction_n),
                " N",
            ),
        ] {
            writeln!(out, "{name:<22} {value:>20}{unit}")?;
        }
        if let Some(interpolation) = &self.interpolation {
            writeln!(out, "warning: {}", interpolated(interpolation))?;
        }
        for alarm in &self.alarms {
            writeln!(
                out,
                "ALARM: {}, since {:.1} s",
                alarm.sentence, alarm.time_s
            )?;
        }
        if let Some(causes) = &self.causes {
            let LikelyCauses { causes, remarks } = likely(causes);
            for (cause, probability) in causes {
                writeln!(out, "likely cause: {cause} ({:.0} %)", 100.0 * probability)?;
            }
            for remark in remarks {
                writeln!(out, "note: {remark}")?;
            }
        }
        if self.alarms.is_empty() {
            let but = if self.values.trusted {
                ""
            } else {
                ", but do not trust it"
            };
            writeln!(out, "no alarm{but}")?;
        }
        for doubt in &self.values.doubts {
            writeln!(out, "warning: {doubt}")?;
        }
        if self.values.has(HealthStatus::LITTLE_EXCITATION)
            && self.values.rejected <= self.values.samples
        {
            writeln!(
                out,
                "note: at the end of the recording there is too little motion in contact to raise an alarm"
            )?;
        }
        if self.values.has(HealthStatus::RESTARTED) {
            writeln!(
                out,
                "warning: the force contradicted the damper model for a long time and the estimate was restarted: \
                 check that the force belongs to this damper"
            )?;
        }
        writeln!(out, "wrote {}", self.page)
    }
}
