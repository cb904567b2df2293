//! Report of a bench sheet: values, limits and the verdict, from the model of a damper or from recordings.

mod figures;
mod limit;
mod measured;
mod page;
mod text;

use std::collections::BTreeMap;

use dashpot_files::sheet::{Index, SheetParameters, Test};
use dashpot_testbench::bench_sheet::Tested;
use dashpot_testbench::bench_test::Cycle;
use dashpot_testbench::measured_sheet::{Assigned, RecordedMotion};
use dashpot_testbench::steady::{Estimate, SensorUncertainty, UnusedCycles};
use serde::Serialize;

pub use limit::{Judged, Limited};
pub use measured::{SheetInput, measured};

/// Forces that change by more than this share from the first to the last cycles are named.
const NAMED_CHANGE: f64 = 0.03;

/// Motions whose rms difference from a sine exceeds this share are named.
const NAMED_DISTORTION: f64 = 0.03;

/// A line of the header.
#[derive(Clone, Debug, Serialize)]
pub struct Line {
    /// Name.
    pub name: String,
    /// Text.
    pub text: String,
}

/// Where the values come from.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Origin {
    /// The model of a damper.
    Model {
        /// Name of the damper.
        damper: String,
        /// Changed parameters.
        overrides: Vec<String>,
    },
    /// Recordings of a bench.
    Recordings {
        /// The recordings.
        recordings: Vec<RecordingLine>,
        /// Names of tests that no recording contains.
        missing: Vec<String>,
        /// Motions that belong to no test.
        other_motions: Vec<OtherMotion>,
        /// Cycles that belong to no steady motion, with the name of the recording.
        unused_cycles: Vec<(String, UnusedCycles)>,
    },
}

/// A recording, as a sheet names it.
#[derive(Clone, Debug, Serialize)]
pub struct RecordingLine {
    /// Name of the file.
    pub name: String,
    /// SHA-256 of the file, in hexadecimal digits.
    pub sha256: String,
    /// Number of samples.
    pub samples: usize,
    /// Duration (s).
    pub duration_s: f64,
    /// Oil temperature (degC); `None` if unknown.
    pub temperature_c: Option<f64>,
}

/// A measured motion that belongs to no test.
#[derive(Clone, Debug, Serialize)]
pub struct OtherMotion {
    /// Name of the recording.
    pub recording: String,
    /// Start (s).
    pub start_s: f64,
    /// Amplitude (m).
    pub amplitude_m: f64,
    /// Frequency (Hz).
    pub frequency_hz: f64,
}

/// Where a test was measured.
#[derive(Clone, Debug, Serialize)]
pub struct Measured {
    /// Name of the recording.
    pub recording: String,
    /// Start of the first cycle (s).
    pub start_s: f64,
    /// End of the last cycle (s).
    pub end_s: f64,
    /// Cycles left out because their displacement or force differs.
    pub unsteady_cycles: usize,
    /// Root mean square of the displacement about a sine, as a share of the sine's.
    pub distortion: f64,
    /// Change of the force from the first to the last third of the cycles, as a share.
    pub force_change: f64,
    /// Half of the 95 % interval of each index, in the unit of its key.
    pub half_widths: BTreeMap<Index, Option<f64>>,
}

/// A test and its values.
#[derive(Clone, Debug, Serialize)]
pub struct TestReport {
    /// Name.
    pub name: String,
    /// Amplitude (m).
    pub amplitude_m: f64,
    /// Frequency (Hz).
    pub frequency_hz: f64,
    /// Peak velocity (m/s).
    pub peak_velocity_m_per_s: f64,
    /// Oil temperature (degC); `None` if unknown, or for a damper without oil.
    pub temperature_c: Option<f64>,
    /// Interval between the samples of the loop (s).
    pub step_s: f64,
    /// Cycles until the computed force was periodic, or measured cycles in the mean loop.
    pub cycles: usize,
    /// Value of each index, in the unit of its key.
    pub indices: BTreeMap<Index, Option<f64>>,
    /// Limits with verdicts.
    pub limits: Vec<Limited>,
    /// Where the test was measured; `None` for a computed one.
    #[serde(flatten)]
    pub measured: Option<Measured>,
    /// The loop.
    #[serde(skip)]
    pub cycle: Cycle,
}

/// Verdict on a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SheetVerdict {
    /// The sheet has no limits.
    NoLimits,
    /// Every limit is met.
    Passed,
    /// A limit is within the uncertainty of its value.
    Undecided,
    /// A test was not measured.
    Incomplete,
    /// A limit is violated.
    Failed,
}

impl SheetVerdict {
    /// Returns the verdict in a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::NoLimits => "NO LIMITS",
            Self::Passed => "PASSED",
            Self::Undecided => "UNDECIDED",
            Self::Incomplete => "INCOMPLETE",
            Self::Failed => "FAILED",
        }
    }

    /// True if nothing speaks against the damper.
    pub fn is_good(self) -> bool {
        matches!(self, Self::NoLimits | Self::Passed)
    }
}

/// A sheet with its values.
#[derive(Debug, Serialize)]
pub struct SheetReport {
    /// Title.
    pub title: String,
    /// Lines of the header.
    pub fields: Vec<Line>,
    /// Where the values come from.
    #[serde(flatten)]
    pub origin: Origin,
    /// Name of the sheet.
    pub sheet: String,
    /// Number of limits.
    pub limits: usize,
    /// Number of limits that are violated or undecided.
    pub limits_not_kept: usize,
    /// Verdict.
    pub verdict: SheetVerdict,
    /// What a reader has to know.
    pub warnings: Vec<String>,
    /// Tests, in order.
    pub tests: Vec<TestReport>,
    /// File of the page.
    pub page: Option<String>,
}

impl TestReport {
    fn new(test: &Test, cycle: &Cycle, temperature_c: Option<f64>) -> Self {
        let motion = &cycle.motion;
        Self {
            name: test.name.clone(),
            amplitude_m: motion.amplitude_m,
            frequency_hz: motion.frequency_hz,
            peak_velocity_m_per_s: motion.peak_velocity_m_per_s(),
            temperature_c,
            step_s: cycle.step_s,
            cycles: cycle.cycles,
            indices: BTreeMap::new(),
            limits: Vec::new(),
            measured: None,
            cycle: cycle.clone(),
        }
    }

    fn computed(tested: &Tested<'_>) -> Self {
        let mut report = Self::new(tested.test, &tested.cycle, tested.temperature_c);
        report.indices = tested.values().collect();
        report.judge(tested.test);
        report
    }

    fn measured(test: &Test, recorded: &RecordedMotion<'_>, sensors: SensorUncertainty) -> Self {
        let RecordedMotion { recording, motion } = recorded;
        let mut report = Self::new(test, &motion.mean, recording.temperature_c);
        let estimates = motion.indices().map(|(index, estimate)| {
            let estimate = estimate.map(|estimate| sensors.widened(index, estimate));
            (index, estimate)
        });
        let of = |part: fn(Estimate) -> f64| {
            let parts = estimates.iter();
            parts
                .map(|(index, estimate)| (*index, estimate.map(part)))
                .collect()
        };
        report.indices = of(|estimate| estimate.value);
        report.measured = Some(Measured {
            recording: recording.name.clone(),
            start_s: motion.start_s,
            end_s: motion.end_s,
            unsteady_cycles: motion.unsteady_cycles,
            distortion: motion.distortion,
            force_change: motion.force_change(),
            half_widths: of(|estimate| estimate.half_width),
        });
        report.judge(test);
        report
    }

    fn judge(&mut self, test: &Test) {
        let limits = test.limits.iter().map(|limit| {
            let of =
                |values: &BTreeMap<Index, Option<f64>>| values.get(&limit.index).copied().flatten();
            let half_width = self.measured.as_ref();
            let half_width = half_width.and_then(|measured| of(&measured.half_widths));
            Limited::new(limit, of(&self.indices), half_width)
        });
        self.limits = limits.collect();
    }

    fn warnings(&self) -> Vec<String> {
        let Some(measured) = &self.measured else {
            return Vec::new();
        };
        let mut warnings = Vec::new();
        let percent = |share: f64| format!("{:.1} %", 100.0 * share);
        if measured.force_change.abs() > NAMED_CHANGE {
            let change = percent(measured.force_change);
            warnings.push(format!(
                "the force changes by {change} from the first cycles to the last"
            ));
        }
        if measured.distortion > NAMED_DISTORTION {
            let distortion = percent(measured.distortion);
            warnings.push(format!(
                "the displacement differs from a sine by {distortion} (rms)"
            ));
        }
        let named = |warning| format!("{}: {warning}", self.name);
        warnings.into_iter().map(named).collect()
    }
}

impl SheetReport {
    /// Returns the report of a sheet that was computed from the model of a damper.
    pub fn computed(
        sheet: &SheetParameters,
        damper: &str,
        overrides: &[String],
        tested: &[Tested<'_>],
    ) -> Self {
        let origin = Origin::Model {
            damper: damper.to_owned(),
            overrides: overrides.to_vec(),
        };
        Self::new(
            sheet,
            origin,
            tested.iter().map(TestReport::computed).collect(),
        )
    }

    /// Returns the report of a sheet that was measured. `sensors` is the uncertainty that all cycles share.
    pub fn measured(
        sheet: &SheetParameters,
        recordings: Vec<RecordingLine>,
        assigned: &Assigned<'_>,
        unused_cycles: Vec<(String, UnusedCycles)>,
        sensors: SensorUncertainty,
    ) -> Self {
        let tests = assigned.measured.iter();
        let tests = tests.map(|(test, recorded)| TestReport::measured(test, recorded, sensors));
        let other = |recorded: &RecordedMotion<'_>| OtherMotion {
            recording: recorded.recording.name.clone(),
            start_s: recorded.motion.start_s,
            amplitude_m: recorded.motion.mean.motion.amplitude_m,
            frequency_hz: recorded.motion.mean.motion.frequency_hz,
        };
        let origin = Origin::Recordings {
            recordings,
            missing: assigned
                .missing
                .iter()
                .map(|test| test.name.clone())
                .collect(),
            other_motions: assigned.others.iter().map(other).collect(),
            unused_cycles,
        };
        Self::new(sheet, origin, tests.collect())
    }

    fn new(sheet: &SheetParameters, origin: Origin, tests: Vec<TestReport>) -> Self {
        let limits = || tests.iter().flat_map(|test| &test.limits);
        let any = |judged: Judged| limits().any(|limit| limit.verdict == judged);
        let is_incomplete = match &origin {
            Origin::Model { .. } => false,
            Origin::Recordings { missing, .. } => !missing.is_empty(),
        };
        let verdict = if any(Judged::Outside) {
            SheetVerdict::Failed
        } else if is_incomplete {
            SheetVerdict::Incomplete
        } else if any(Judged::Undecided) {
            SheetVerdict::Undecided
        } else if limits().next().is_none() {
            SheetVerdict::NoLimits
        } else {
            SheetVerdict::Passed
        };
        let line = |field: &dashpot_files::sheet::Field| Line {
            name: field.name.clone(),
            text: field.text.clone(),
        };
        Self {
            title: sheet.title.clone(),
            fields: sheet.fields.iter().map(line).collect(),
            sheet: sheet.file.clone(),
            limits: limits().count(),
            limits_not_kept: limits().filter(|limit| !limit.kept).count(),
            verdict,
            warnings: tests.iter().flat_map(TestReport::warnings).collect(),
            page: None,
            origin,
            tests,
        }
    }
}
