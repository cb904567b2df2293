//! Report of a sheet.

use std::collections::BTreeMap;
use std::io::{self, Write};

use serde::Serialize;

use crate::commands::counted;
use crate::commands::rig::RigArguments;
use dashpot_files::output;
use dashpot_files::sheet::Index;
use dashpot_files::sheet::{Limit, SheetParameters};
use dashpot_files::study::format_number;
use dashpot_report::verdict::Verdict;
use dashpot_testbench::bench_sheet::Tested;

/// A header field.
#[derive(Serialize)]
pub(super) struct Field {
    pub(super) name: String,
    pub(super) text: String,
}

/// A limit and its verdict.
#[derive(Serialize)]
pub(super) struct Limited {
    pub(super) index: Index,
    pub(super) value: Option<f64>,
    pub(super) least: Option<f64>,
    pub(super) most: Option<f64>,
    pub(super) clause: Option<String>,
    pub(super) kept: bool,
}

/// A test and its values.
#[derive(Serialize)]
pub(super) struct TestReport {
    pub(super) name: String,
    pub(super) amplitude_m: f64,
    pub(super) frequency_hz: f64,
    pub(super) peak_velocity_m_per_s: f64,
    /// Oil temperature; `None` for a damper without oil.
    pub(super) temperature_c: Option<f64>,
    step_s: f64,
    cycles: usize,
    pub(super) indices: BTreeMap<Index, Option<f64>>,
    pub(super) limits: Vec<Limited>,
}

/// A sheet with its values.
#[derive(Serialize)]
pub(super) struct Report {
    pub(super) title: String,
    pub(super) fields: Vec<Field>,
    pub(super) damper: String,
    pub(super) overrides: Vec<String>,
    pub(super) sheet: String,
    pub(super) limits: usize,
    pub(super) limits_not_kept: usize,
    pub(super) tests: Vec<TestReport>,
    page: Option<String>,
}

impl Limited {
    fn new(limit: &Limit, value: Option<f64>) -> Self {
        Self {
            index: limit.index,
            value,
            least: limit.min,
            most: limit.max,
            clause: limit.clause.clone(),
            kept: limit.is_kept(value),
        }
    }

    /// Formats the allowed range in the unit of the index.
    pub(super) fn allowed(&self) -> String {
        let end = |end: f64| format_number(end / self.index.display_unit().size);
        match (self.least, self.most) {
            (Some(least), Some(most)) => format!("{} to {}", end(least), end(most)),
            (Some(least), None) => format!("at least {}", end(least)),
            (None, Some(most)) => format!("at most {}", end(most)),
            (None, None) => String::new(),
        }
    }

    pub(super) fn verdict(&self) -> &'static str {
        if self.kept { "within" } else { "outside" }
    }
}

/// Formats a value with four digits in the display unit of its index.
pub(super) fn value_of(index: Index, value: Option<f64>) -> String {
    value.map_or("none".into(), |value| {
        let value = value / index.display_unit().size;
        let magnitude = value.abs().max(1e-9).log10().floor();
        let digits = (3.0 - magnitude).clamp(0.0, 4.0) as usize;
        format!("{value:.digits$}")
    })
}

impl Limited {
    /// Formats the value, rounded to enough digits to differ from a violated limit.
    pub(super) fn formatted(&self) -> String {
        let text = value_of(self.index, self.value);
        let Some(value) = self.value else {
            return text;
        };
        let read: f64 = text.parse().unwrap_or(value);
        let rounded = Some(read * self.index.display_unit().size);
        let looks_kept = self.least.is_none_or(|least| rounded >= Some(least))
            && self.most.is_none_or(|most| rounded <= Some(most));
        if looks_kept == self.kept {
            return text;
        }
        format_number(value / self.index.display_unit().size)
    }
}

impl TestReport {
    /// Describes the motion.
    pub(super) fn motion(&self) -> String {
        let mut motion = format!(
            "±{:.3} mm at {:.4} Hz, peak {:.4} m/s",
            self.amplitude_m * 1e3,
            self.frequency_hz,
            self.peak_velocity_m_per_s
        );
        if let Some(temperature_c) = self.temperature_c {
            motion += &format!(", oil {temperature_c} °C");
        }
        motion
    }
}

impl Report {
    pub(super) fn new(
        arguments: &RigArguments,
        sheet: &SheetParameters,
        tested: &[Tested<'_>],
    ) -> Self {
        let test = |tested: &Tested<'_>| {
            let motion = &tested.cycle.motion;
            let indices: BTreeMap<Index, Option<f64>> = tested.values().collect();
            let limit = |limit: &Limit| {
                let value = indices.get(&limit.index).copied().flatten();
                Limited::new(limit, value)
            };
            TestReport {
                name: tested.test.name.clone(),
                amplitude_m: motion.amplitude_m,
                frequency_hz: motion.frequency_hz,
                peak_velocity_m_per_s: motion.peak_velocity_m_per_s(),
                temperature_c: tested.temperature_c,
                step_s: tested.cycle.step_s,
                cycles: tested.cycle.cycles,
                limits: tested.test.limits.iter().map(limit).collect(),
                indices,
            }
        };
        let tests: Vec<TestReport> = tested.iter().map(test).collect();
        let limits = || tests.iter().flat_map(|test| &test.limits);
        let field = |field: &dashpot_files::sheet::Field| Field {
            name: field.name.clone(),
            text: field.text.clone(),
        };
        Self {
            title: sheet.title.clone(),
            fields: sheet.fields.iter().map(field).collect(),
            damper: arguments.damper.damper.clone(),
            overrides: arguments.damper.overrides.clone(),
            sheet: sheet.file.clone(),
            limits: limits().count(),
            limits_not_kept: limits().filter(|limit| !limit.kept).count(),
            page: arguments
                .page
                .as_ref()
                .map(|path| output::name(path).display().to_string()),
            tests,
        }
    }

    /// Describes how many limits are met.
    pub(super) fn verdict(&self) -> String {
        let limits = counted(self.limits as u64, "limit");
        match (self.limits, self.limits_not_kept) {
            (0, _) => "no limits".into(),
            (_, 0) => format!("{limits}, all met"),
            (_, outside) => format!("{outside} of {limits} violated"),
        }
    }

    pub(super) fn print(out: &mut dyn Write, report: &Self) -> io::Result<()> {
        let damper = [std::slice::from_ref(&report.damper), &report.overrides].concat();
        writeln!(out, "{}\n{}", report.title, damper.join(" "))?;
        for field in &report.fields {
            writeln!(out, "{}: {}", field.name, field.text)?;
        }
        for test in &report.tests {
            writeln!(out, "\n{}: {}", test.name, test.motion())?;
            for (index, value) in &test.indices {
                let unit = index.display_unit().symbol;
                let mut limits = test.limits.iter().filter(|limit| limit.index == *index);
                write!(out, "  {:<38}{unit:<8}", index.name())?;
                match limits.next() {
                    None => writeln!(out, "{:>10}", value_of(*index, *value))?,
                    Some(limit) => {
                        let clause = limit.clause.as_deref().unwrap_or("");
                        writeln!(
                            out,
                            "{:>10}  {:<8} {:<22} {clause}",
                            limit.formatted(),
                            Verdict::of(limit.kept).mark(limit.verdict()),
                            limit.allowed()
                        )?;
                    }
                }
            }
        }
        let verdict = Verdict::of(report.limits_not_kept == 0);
        match report.limits {
            0 => writeln!(out, "\n{}", report.verdict())?,
            _ => writeln!(out, "\n{}", verdict.mark(report.verdict()))?,
        }
        if let Some(page) = &report.page {
            writeln!(out, "page: {page}")?;
        }
        Ok(())
    }
}
