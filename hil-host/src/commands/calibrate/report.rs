//! The report of `dashpot calibrate`.

use std::io::{self, Write};

use serde::Serialize;

use super::digits::digits;
use super::further::Further;
use super::index_rows::{self, IndexRow};
use super::{CalibrateArguments, words};
use crate::commands::counted;
use crate::commands::failure::Outcome;
use crate::commands::gap_report::{interpolated, unended, unfinished};
use dashpot_calibration::{
    Calibrated, Calibration, HeldRig, Influence, Prior, RIG, Recorded, Warning,
};
use dashpot_files::output;
use dashpot_recording::{Gaps, Interpolation, UnfinishedEnd};

/// Half the width of the 95 % interval for the middle of a motion, in standard deviations of the noise.
///
/// It is 1.96 / sqrt(2) because the middle is the mean of two ends, and smoothing makes neither end noisier than a
/// sample.
const OFFSET_DEVIATIONS: f64 = 1.386;

/// An identified parameter.
#[derive(Serialize)]
pub(super) struct Number {
    pub(super) key: String,
    pub(super) before: f64,
    pub(super) found: f64,
    /// Ends of the 95 % interval from the profile likelihood and the uncertainty of the assumed parameters; `None` if
    /// a bound is reached first.
    pub(super) least: Option<f64>,
    pub(super) greatest: Option<f64>,
    /// Ends of the interval from the profile alone, with the assumed parameters exact.
    least_by_noise: Option<f64>,
    greatest_by_noise: Option<f64>,
    pub(super) bounds: [f64; 2],
    pub(super) prior: Option<Prior>,
    /// True if the tests rather than the prior determine it.
    pub(super) by_tests: bool,
    /// Standard deviation from linear theory, including priors.
    standard_deviation: f64,
    /// Correlation with each of the other parameters.
    correlation: Vec<(String, f64)>,
}

/// Smallest shift that the report mentions, as a fraction of half the interval from noise alone.
const PART_OF_NOISE: f64 = 0.2;

impl Number {
    /// Returns half of the interval from noise alone.
    fn noise(&self) -> f64 {
        let [least, greatest] = self.bounds;
        0.5 * (self.greatest_by_noise.unwrap_or(greatest) - self.least_by_noise.unwrap_or(least))
    }
}

/// Effect of an assumed parameter on the identified ones.
#[derive(Serialize)]
pub(super) struct AssumedNumber {
    pub(super) key: String,
    pub(super) value: f64,
    /// Half of its 95 % interval.
    pub(super) uncertainty: f64,
    /// Option that sets the uncertainty.
    option: &'static str,
    /// Each identified parameter with its shift at the lower and at the upper end of that interval.
    pub(super) shifts: Vec<(String, [f64; 2])>,
}

impl AssumedNumber {
    fn new(influence: &Influence, calibration: &Calibration) -> Self {
        let shifts = calibration.varied.iter().zip(&influence.shifts);
        Self {
            key: influence.key.clone(),
            value: influence.value,
            uncertainty: influence.uncertainty,
            option: words::uncertainty_option(&influence.key),
            shifts: shifts
                .map(|(varied, shifts)| (varied.key.clone(), *shifts))
                .collect(),
        }
    }

    /// Describes the assumption and how much it shifts each of `numbers`.
    pub(super) fn words(&self, numbers: &[Number]) -> String {
        let moved = self.shifts.iter().zip(numbers);
        let moved: Vec<String> = moved
            .filter(|((_, shifts), number)| {
                let noise = number.noise();
                shifts
                    .iter()
                    .any(|shift| shift.abs() > PART_OF_NOISE * noise)
            })
            .map(|((key, [low, high]), number)| {
                if number.found == 0.0 || RIG.contains(&key.as_str()) {
                    format!("{key} by {} to {}", digits(*low), digits(*high))
                } else {
                    let percent = |shift: &f64| 100.0 * shift / number.found.abs();
                    format!("{key} by {:+.2} to {:+.2} %", percent(low), percent(high))
                }
            })
            .collect();
        let moves = if moved.is_empty() {
            "which shifts every parameter by less than a fifth of its noise".into()
        } else {
            format!("which shifts {}", moved.join(", "))
        };
        format!(
            "{} {} +- {} (95 %, {}), {moves}",
            self.key, self.value, self.uncertainty, self.option
        )
    }
}

/// A warning with its text.
#[derive(Serialize)]
pub(super) struct Warned {
    #[serde(flatten)]
    pub(super) warning: Warning,
    pub(super) words: String,
}

/// Number of tests found in a file of recorded loops, and what was omitted.
#[derive(Serialize)]
pub(super) struct Recording {
    file: String,
    tests: usize,
    /// Number of segments between gaps that have too few samples for a test.
    too_short: usize,
    /// Number of rows with a missing value.
    rows_left_out: u64,
    /// Number of the last line, if it has no line end.
    #[serde(skip_serializing_if = "Option::is_none")]
    unended_line: Option<u64>,
    /// End of the rows, if it is an unfinished MDF4 file.
    #[serde(skip_serializing_if = "Option::is_none")]
    unfinished: Option<UnfinishedEnd>,
    /// How the force was brought to the times of the displacement, if it is in another group.
    #[serde(skip_serializing_if = "Option::is_none")]
    interpolation: Option<Interpolation>,
}

impl Recording {
    pub(super) fn new(recorded: &Recorded, gaps: &Gaps, tests: usize) -> Self {
        Self {
            file: recorded.name.clone(),
            tests,
            too_short: recorded.too_short(),
            rows_left_out: gaps.left_out.rows,
            unended_line: gaps.unended_line,
            unfinished: gaps.unfinished,
            interpolation: gaps.interpolation,
        }
    }

    /// Describes the omitted rows and segments.
    fn left_out(&self) -> Option<String> {
        let rows = (self.rows_left_out > 0).then(|| {
            format!(
                "{} with a missing value",
                counted(self.rows_left_out, "row")
            )
        });
        let short = (self.too_short > 0).then(|| {
            let parts = counted(self.too_short as u64, "segment");
            format!("{parts} between gaps, too short for a test")
        });
        let parts: Vec<String> = [rows, short].into_iter().flatten().collect();
        (!parts.is_empty()).then(|| parts.join("; "))
    }
}

/// Results for one loop before and after calibration.
#[derive(Serialize)]
pub(super) struct Loop {
    pub(super) test: String,
    pub(super) samples: usize,
    pub(super) amplitude_m: f64,
    pub(super) peak_velocity_m_per_s: f64,
    pub(super) peak_force_n: f64,
    pub(super) displacement_noise_m: f64,
    /// Middle of the recorded motion, with its 95 % interval. It is the sensor's offset if the rig moves about the
    /// damper's middle.
    pub(super) displacement_offset_m: f64,
    displacement_offset_least_m: f64,
    displacement_offset_greatest_m: f64,
    pub(super) force_noise_n: f64,
    pub(super) missed_before_n: f64,
    pub(super) missed_after_n: f64,
    correlation_samples: f64,
    /// True if the residual is larger than the noise explains.
    pub(super) misses: bool,
}

/// The whole report.
#[derive(Serialize)]
pub(super) struct Report {
    pub(super) damper: String,
    overrides: Vec<String>,
    step_s: f64,
    pub(super) numbers: Vec<Number>,
    recordings: Vec<Recording>,
    pub(super) loops: Vec<Loop>,
    pub(super) indices: Vec<IndexRow>,
    #[serde(flatten)]
    pub(super) further: Further,
    /// Values of the rig's fixed parameters.
    held: HeldRig,
    /// Assumed properties of the oil and their effect on the parameters.
    #[serde(rename = "assumed")]
    pub(super) influences: Vec<AssumedNumber>,
    pub(super) warnings: Vec<Warned>,
    starts: usize,
    starts_at_this_minimum: usize,
    pub(super) output: String,
    page: Option<String>,
}

impl Report {
    /// Builds the report.
    ///
    /// # Errors
    /// The force of the damper does not become periodic.
    pub(super) fn new(
        arguments: &CalibrateArguments,
        calibration: &Calibration,
        inputs: &[Recorded],
        recordings: Vec<Recording>,
        found: &Calibrated,
        further: Further,
    ) -> Outcome<Self> {
        let determination = &found.determination;
        let varied = calibration.varied.iter().enumerate();
        let numbers = varied.map(|(number, varied)| {
            let others = calibration
                .varied
                .iter()
                .zip(&determination.correlation[number]);
            let others = others.filter(|(other, _)| other.key != varied.key);
            Number {
                key: varied.key.clone(),
                before: varied.start,
                found: found.values[number],
                least: found.intervals[number][0],
                greatest: found.intervals[number][1],
                least_by_noise: found.profiles[number].lower,
                greatest_by_noise: found.profiles[number].upper,
                bounds: varied.bounds,
                prior: varied.prior,
                by_tests: found.profiles[number].is_determined_by_tests(varied),
                standard_deviation: determination.parameters[number].standard_deviation,
                correlation: others
                    .map(|(other, value)| (other.key.clone(), *value))
                    .collect(),
            }
        });
        let loops = calibration.loops.iter().zip(&found.loops);
        let loops = loops.map(|(test, fit)| Loop {
            test: test.name.clone(),
            samples: fit.after_n.len(),
            amplitude_m: test.amplitude_m,
            peak_velocity_m_per_s: test.peak_velocity_m_per_s,
            peak_force_n: test.peak_force_n,
            displacement_noise_m: test.displacement_noise_m,
            displacement_offset_m: test.displacement_offset_m,
            displacement_offset_least_m: test.displacement_offset_m
                - OFFSET_DEVIATIONS * test.displacement_noise_m,
            displacement_offset_greatest_m: test.displacement_offset_m
                + OFFSET_DEVIATIONS * test.displacement_noise_m,
            force_noise_n: test.force_noise_n,
            missed_before_n: fit.missed_before_n,
            missed_after_n: fit.missed_after_n,
            correlation_samples: fit.correlation_samples,
            misses: fit.misses(test),
        });
        let before = arguments.damper.load()?;
        let indices = index_rows::rows(
            arguments,
            calibration,
            inputs,
            [&before, &found.damper],
            found,
        )?;
        Ok(Self {
            damper: arguments.damper.damper.clone(),
            overrides: arguments.damper.overrides.clone(),
            step_s: calibration.step_s,
            numbers: numbers.collect(),
            recordings,
            loops: loops.collect(),
            indices,
            further,
            held: calibration.rig,
            influences: found
                .influences
                .iter()
                .map(|influence| AssumedNumber::new(influence, calibration))
                .collect(),
            warnings: found
                .warnings
                .iter()
                .map(|warning| Warned {
                    warning: warning.clone(),
                    words: words::line(warning),
                })
                .collect(),
            starts: found.searches.converged,
            starts_at_this_minimum: found.searches.at_best_minimum,
            output: output::name(&arguments.output).display().to_string(),
            page: arguments
                .page
                .as_ref()
                .map(|page| page.display().to_string()),
        })
    }

    /// Returns the initial damper with its overrides, as options.
    pub(super) fn before(&self) -> String {
        let set = self.overrides.iter().map(|set| format!(" --set {set}"));
        [self.damper.clone()].into_iter().chain(set).collect()
    }

    /// Prints the report as text.
    ///
    /// # Errors
    /// The output cannot be written.
    pub(super) fn print(out: &mut dyn Write, report: &Self) -> io::Result<()> {
        let tabled = report.indices.iter().filter(|row| row.recording.is_none());
        let tests = counted((report.loops.len() + tabled.count()) as u64, "test");
        writeln!(out, "{} calibrated from {tests}", report.before())?;
        for recording in &report.recordings {
            if let Some(left_out) = recording.left_out() {
                writeln!(out, "note: {}: omitted {left_out}", recording.file)?;
            }
            if let Some(line) = recording.unended_line {
                writeln!(out, "{}: warning: {}", recording.file, unended(line))?;
            }
            if let Some(end) = recording.unfinished {
                writeln!(out, "{}: warning: {}", recording.file, unfinished(end))?;
            }
            if let Some(interpolation) = &recording.interpolation {
                writeln!(
                    out,
                    "{}: warning: {}",
                    recording.file,
                    interpolated(interpolation)
                )?;
            }
        }
        writeln!(out)?;
        report.print_loops(out)?;
        report.print_indices(out)?;
        report.further.print(out)?;
        let width = report
            .numbers
            .iter()
            .map(|number| number.key.len())
            .max()
            .unwrap_or(0);
        writeln!(
            out,
            "  {:<width$}  {:>11}  {:>11}  {:^25}  by",
            "parameter", "before", "found", "95 % interval"
        )?;
        for number in &report.numbers {
            writeln!(
                out,
                "  {:<width$}  {:>11}  {:>11}  {:>11} to {:<10}  {}",
                number.key,
                digits(number.before),
                digits(number.found),
                number.least.map_or_else(|| "bound".into(), digits),
                number.greatest.map_or_else(|| "bound".into(), digits),
                if number.by_tests {
                    "tests"
                } else {
                    "tests and prior"
                }
            )?;
        }
        writeln!(out)?;
        for influence in &report.influences {
            writeln!(out, "assumed: {}", influence.words(&report.numbers))?;
        }
        for warning in &report.warnings {
            writeln!(out, "{}", warning.words)?;
        }
        writeln!(
            out,
            "{} of {} led to these values",
            report.starts_at_this_minimum,
            counted(report.starts as u64, "start")
        )?;
        let page = report.page.iter().map(|page| format!(", {page}"));
        writeln!(out, "wrote {}{}", report.output, page.collect::<String>())
    }

    fn print_loops(&self, out: &mut dyn Write) -> io::Result<()> {
        if self.loops.is_empty() {
            return Ok(());
        }
        let width = self
            .loops
            .iter()
            .map(|row| row.test.len())
            .max()
            .unwrap_or(0)
            .max(4);
        writeln!(
            out,
            "  {:<width$}  {:>13}  {:>10}  {:>13}  {:>10}  {:>9}  {:>13}  {:>12}",
            "test",
            "amplitude, mm",
            "middle, mm",
            "velocity, m/s",
            "force, kN",
            "noise, N",
            "misfit before",
            "and after, N"
        )?;
        for row in &self.loops {
            writeln!(
                out,
                "  {:<width$}  {:>13.2}  {:>10.2}  {:>13.3}  {:>10.2}  {:>9.0}  {:>13.0}  {:>12.0}",
                row.test,
                row.amplitude_m * 1e3,
                row.displacement_offset_m * 1e3,
                row.peak_velocity_m_per_s,
                row.peak_force_n * 1e-3,
                row.force_noise_n,
                row.missed_before_n,
                row.missed_after_n
            )?;
        }
        writeln!(out)
    }

    fn print_indices(&self, out: &mut dyn Write) -> io::Result<()> {
        for row in &self.indices {
            writeln!(
                out,
                "  {:<36} {:>11} {:>11} {:>11}",
                row.motion("+-"),
                "test",
                "before",
                "found"
            )?;
            for (name, measured, before, after) in row.lines() {
                writeln!(
                    out,
                    "    {name:<33} {measured:>11} {before:>11.1} {after:>11.1}"
                )?;
            }
            writeln!(out)?;
        }
        Ok(())
    }
}
