//! Report on a rig.

use dashpot_core::hybrid::wire::InboxCounts;
use serde::Serialize;

use super::RigLine;
use super::options::Compensate;
use super::reasons::reasons;
use super::samples::Sample;

/// Difference between the clocks of vehicle and rig that is told.
const CLOCK_ERROR: f64 = 0.01;

/// What happened on a rig.
#[derive(Debug, Clone, Serialize)]
pub(in crate::commands) struct RigReport {
    pub(in crate::commands::vehicle) damper: String,
    pub(in crate::commands::vehicle) actuator: String,
    compensation: &'static str,
    /// Time by which the measured displacement is late at the end, s.
    delay_s: f64,
    /// Amplitude of the measured displacement relative to the desired one, at the end.
    amplitude: f64,
    /// Root mean square of measured minus desired displacement, relative to that of the desired one about its mean.
    relative_error: f64,
    largest_error_m: f64,
    added_energy_j: f64,
    largest_command_m: f64,
    largest_command_rate_m_per_s: f64,
    largest_force_n: f64,
    missing_readings: u64,
    saturated_ticks: u64,
    /// Seconds of the rig for each second of the vehicle; `None` in this process.
    #[serde(skip_serializing_if = "Option::is_none")]
    clock_ratio: Option<f64>,
    /// Datagrams of the rig; `None` for a rig in this process.
    #[serde(skip_serializing_if = "Option::is_none")]
    datagrams: Option<Datagrams>,
    ticks: u64,
    /// Ticks that all figures and hybrid.csv contain: those of the first ten minutes at 1 ms.
    recorded_ticks: u64,
    is_guarded: bool,
    /// Time at which the guard acted, s; `None` if it did not.
    guarded_s: Option<f64>,
    /// What the guard saw.
    status: Vec<&'static str>,
}

/// Counts of datagrams.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub(in crate::commands) struct Datagrams {
    fresh: u32,
    lost: u32,
    late: u32,
    repeated: u32,
    foreign: u32,
}

impl From<InboxCounts> for Datagrams {
    fn from(counts: InboxCounts) -> Self {
        let InboxCounts {
            fresh,
            lost,
            late,
            repeated,
            foreign,
        } = counts;
        Self {
            fresh,
            lost,
            late,
            repeated,
            foreign,
        }
    }
}

impl Datagrams {
    /// Describes the counts in one line.
    pub(in crate::commands) fn text(&self) -> String {
        format!(
            "{} in order, {} lost, {} late, {} repeated, {} foreign",
            self.fresh, self.lost, self.late, self.repeated, self.foreign
        )
    }
}

impl RigReport {
    pub(super) fn new(line: &RigLine) -> Self {
        let rows = &line.samples.rows;
        // While the guard brings the command to rest, the rig does not follow the vehicle.
        let end_s = line.guarded_s.unwrap_or(f64::INFINITY);
        let largest = |value: &dyn Fn(&Sample) -> f32| {
            rows.iter()
                .map(|row| f64::from(value(row).abs()))
                .fold(0.0, f64::max)
        };
        let rates = rows.windows(2).map(|pair| {
            f64::from(pair[1].command_m - pair[0].command_m).abs()
                / (pair[1].time_s - pair[0].time_s)
        });
        let read = rows
            .iter()
            .filter(|row| !row.measured_m.is_nan() && row.time_s < end_s);
        let errors = read
            .clone()
            .map(|row| f64::from(row.measured_m - row.desired_m));
        let desired = read.clone().map(|row| f64::from(row.desired_m));
        let last = rows.last();
        let of_last =
            |value: &dyn Fn(&Sample) -> f32| last.map_or(0.0, |row| f64::from(value(row)));
        let status = line.status;
        let mean = |values: &dyn Fn() -> f64, count: usize| values() / count.max(1) as f64;
        let count = read.count();
        let middle = mean(&|| desired.clone().sum(), count);
        let spread = mean(
            &|| desired.clone().map(|x| (x - middle) * (x - middle)).sum(),
            count,
        );
        let square = mean(&|| errors.clone().map(|error| error * error).sum(), count);
        Self {
            damper: line.name.clone(),
            actuator: line.options.actuator.name.clone(),
            compensation: match line.options.compensate {
                Compensate::None => "none",
                Compensate::Polynomial => "polynomial",
                Compensate::Inverse => "inverse",
                Compensate::Ats => "adaptive time series",
            },
            delay_s: of_last(&|row| row.delay_s),
            amplitude: of_last(&|row| row.amplitude),
            relative_error: if spread > 0.0 {
                (square / spread).sqrt()
            } else {
                0.0
            },
            largest_error_m: errors.map(f64::abs).fold(0.0, f64::max),
            added_energy_j: of_last(&|row| row.added_j),
            largest_command_m: largest(&|row| row.command_m),
            largest_command_rate_m_per_s: rates.fold(0.0, f64::max),
            largest_force_n: largest(&|row| row.force_n),
            missing_readings: rows.iter().filter(|row| row.measured_m.is_nan()).count() as u64,
            saturated_ticks: line.rig.saturated_ticks(),
            clock_ratio: line.rig.clock_ratio(),
            datagrams: line.rig.counts().map(Datagrams::from),
            ticks: line.ticks,
            recorded_ticks: rows.len() as u64,
            is_guarded: !line.options.without_guard,
            guarded_s: line.guarded_s,
            status: reasons(status),
        }
    }

    /// Returns the lines of the report as pairs of label and text.
    pub(in crate::commands::vehicle) fn lines(&self) -> Vec<(String, String)> {
        let guard = match (self.is_guarded, self.guarded_s) {
            (false, _) => "without guard".to_owned(),
            (true, None) => "no limit exceeded".to_owned(),
            (true, Some(time_s)) => format!("ended the test at {time_s:.3} s"),
        };
        let seen = match &self.status[..] {
            [] => String::new(),
            some => format!("; {}", some.join("; ")),
        };
        let place = match self.datagrams {
            None => "a virtual rig",
            Some(_) => "a rig behind UDP",
        };
        let at_limit = format!(
            "; {} ticks of {} at a limit of the actuator",
            self.saturated_ticks, self.ticks
        );
        let mut lines = vec![
            (
                self.damper.clone(),
                format!(
                    "on {place}: {}, compensation: {}",
                    self.actuator, self.compensation
                ),
            ),
            (
                "  tracking".into(),
                format!(
                    "at the end {:.2} ms late, amplitude {:.3}; error {:.2} % rms over the run, at most {:.3} mm",
                    1e3 * self.delay_s,
                    self.amplitude,
                    1e2 * self.relative_error,
                    1e3 * self.largest_error_m
                ),
            ),
            (
                "  command".into(),
                format!(
                    "at most {:.2} mm and {:.3} m/s; force at most {:.2} kN{at_limit}",
                    1e3 * self.largest_command_m,
                    self.largest_command_rate_m_per_s,
                    1e-3 * self.largest_force_n
                ),
            ),
            (
                "  energy".into(),
                format!("{:.2} J added by the actuator", self.added_energy_j),
            ),
            ("  guard".into(), format!("{guard}{seen}")),
        ];
        if self.recorded_ticks < self.ticks {
            let text = format!(
                "all but the guard is of the first {} ticks of {}",
                self.recorded_ticks, self.ticks
            );
            lines.push(("  record".into(), text));
        }
        if let Some(ratio) = self
            .clock_ratio
            .filter(|ratio| (ratio - 1.0).abs() > CLOCK_ERROR)
        {
            let text = format!(
                "WRONG: {ratio:.3} s of the rig passed for each second of the vehicle, so the damper moved at another \
                 speed than it should"
            );
            lines.push(("  clock".into(), text));
        }
        if let Some(datagrams) = &self.datagrams {
            let text = format!(
                "{}; no reading in {} ticks of {}",
                datagrams.text(),
                self.missing_readings,
                self.ticks
            );
            lines.push(("  answers".into(), text));
        }
        lines
    }
}
