//! Tests that were held back and predicted, and tests that would narrow the parameters.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use maud::{Markup, html};
use serde::Serialize;

use super::{CalibrateArguments, recorded_tests};
use crate::commands::failure::Outcome;
use dashpot_calibration::{
    Calibrated, Calibration, CalibrationError, PlannedTest, Predicted, Promise,
};
use dashpot_files::sheet::SheetParameters;

/// Options about tests that are not fitted.
#[derive(Debug, Clone, Default, clap::Args)]
pub(super) struct FurtherArguments {
    /// Recording that is held back: it is not fitted but predicted with the calibrated damper, and the error reported.
    #[arg(long, value_name = "FILE")]
    pub(super) validate: Vec<PathBuf>,
    /// Sheet of tests to choose the next one from: reports how much each would narrow each interval.
    #[arg(long, value_name = "NAME|FILE")]
    plan: Option<String>,
}

/// Results about tests that were not fitted.
#[derive(Debug, Serialize)]
pub(super) struct Further {
    /// Tests that were held back.
    #[serde(rename = "validation")]
    predicted: Vec<Predicted>,
    /// Tests that may be done.
    #[serde(rename = "plan")]
    promises: Vec<Promise>,
}

impl FurtherArguments {
    /// Returns the tests of the sheet; none without `--plan`.
    ///
    /// # Errors
    /// There is no such sheet.
    pub(super) fn planned(&self) -> Outcome<Vec<PlannedTest>> {
        let Some(name) = &self.plan else {
            return Ok(Vec::new());
        };
        let tests = SheetParameters::load(name)?.tests.into_iter();
        Ok(tests.map(PlannedTest::from).collect())
    }

    /// Returns the paths of the recordings that are held back.
    pub(super) fn held_back(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        self.validate
            .iter()
            .map(|path| ("--validate", path.as_path()))
    }
}

impl Further {
    /// Predicts the held-back tests, and computes how much each of the `planned` tests would narrow the parameters.
    ///
    /// # Errors
    /// A recording cannot be read, or a damper cannot be built.
    pub(super) fn new(
        arguments: &CalibrateArguments,
        planned: &[PlannedTest],
        calibration: &Calibration,
        found: &Calibrated,
        in_words: impl Fn(CalibrationError) -> crate::commands::failure::Failure,
    ) -> Outcome<Self> {
        let mut tests = Vec::new();
        let temperatures_c = arguments.temperatures_c()?;
        let temperatures_c = temperatures_c.into_iter().skip(arguments.input.len());
        for (path, temperature_c) in arguments.further.validate.iter().zip(temperatures_c) {
            tests.extend(recorded_tests(arguments, path, temperature_c, &in_words)?.tests);
        }
        let predicted = calibration.predicted(found, tests).map_err(&in_words)?;
        let promises = match planned {
            [] => Vec::new(),
            planned => calibration.promises(found, planned).map_err(&in_words)?,
        };
        Ok(Self {
            predicted,
            promises,
        })
    }

    /// Prints both as text.
    ///
    /// # Errors
    /// The output cannot be written.
    pub(super) fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        let width =
            |names: &mut dyn Iterator<Item = &str>| names.map(str::len).max().unwrap_or(0).max(12);
        if !self.predicted.is_empty() {
            let width = width(&mut self.predicted.iter().map(|test| test.test.as_str()));
            writeln!(
                out,
                "  {:<width$}  {:>12}  {:>15}  systematic difference",
                "held back", "error, N rms", "of the force, %"
            )?;
            for test in &self.predicted {
                writeln!(
                    out,
                    "  {:<width$}  {:>12.0}  {:>15.1}  {}",
                    test.test,
                    test.error_n,
                    100.0 * test.error_share,
                    systematic(test)
                )?;
            }
            writeln!(out)?;
        }
        if !self.promises.is_empty() {
            let width = width(&mut self.promises.iter().map(|promise| promise.test.as_str()));
            writeln!(
                out,
                "  what would remain of each interval after one more test"
            )?;
            for promise in &self.promises {
                let shares = promise.shares.iter();
                let shares: Vec<String> = shares
                    .map(|(key, share)| format!("{key} {:.0} %", 100.0 * share))
                    .collect();
                writeln!(out, "  {:<width$}  {}", promise.test, shares.join(", "))?;
            }
            writeln!(out)?;
        }
        Ok(())
    }

    /// Returns both as tables of a page.
    pub(super) fn tables(&self) -> Markup {
        html! {
            @if !self.predicted.is_empty() {
                h2 { "Held back and predicted" }
                div.wide.worded {
                    table {
                        tr {
                            th { "test" } th { "error, N rms" } th { "of the force, %" }
                            th.text { "systematic difference" }
                        }
                        @for test in &self.predicted {
                            tr {
                                td { (test.test) }
                                td { (format!("{:.0}", test.error_n)) }
                                td { (format!("{:.1}", 100.0 * test.error_share)) }
                                td.text { (systematic(test)) }
                            }
                        }
                    }
                }
            }
            @if let Some(first) = self.promises.first() {
                h2 { "The next test" }
                p { "What would remain of each interval after one more test, by linear theory." }
                div.wide.worded {
                    table {
                        tr { th { "test" } @for (key, _) in &first.shares { th { (key) } } }
                        @for promise in &self.promises {
                            tr {
                                td { (promise.test) }
                                @for (_, share) in &promise.shares { td { (format!("{:.0} %", 100.0 * share)) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Describes the greatest systematic difference of a test.
fn systematic(test: &Predicted) -> String {
    test.systematic.map_or_else(
        || "none seen".into(),
        |at| {
            format!(
                "{:+.0} ± {:.0} N at {:+.3} m/s",
                at.difference_n, at.standard_error_n, at.velocity_m_per_s
            )
        },
    )
}
