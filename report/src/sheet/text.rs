//! The report of a sheet as text.

use std::io::{self, Write};

use super::limit::{half_width_of, value_of};
use super::{
    Judged, Limited, Origin, OtherMotion, RecordingLine, SheetReport, SheetVerdict, TestReport,
};
use crate::verdict::Verdict;
use dashpot_testbench::steady::{
    MAX_DISTORTION, MIN_CYCLES, MIN_SAMPLES_PER_CYCLE, Unused, UnusedCycles,
};

impl SheetReport {
    /// Describes how many limits are met.
    pub fn summary(&self) -> String {
        let counted = |count: usize, what: &str| match count {
            1 => format!("1 {what}"),
            _ => format!("{count} {what}s"),
        };
        let limits = counted(self.limits, "limit");
        let missing = match &self.origin {
            Origin::Recordings { missing, .. } if !missing.is_empty() => {
                format!("; {} not measured", counted(missing.len(), "test"))
            }
            _ => String::new(),
        };
        let count = |judged: Judged| {
            let judged = |limit: &&Limited| limit.verdict == judged;
            let tests = self.tests.iter();
            tests.flat_map(|test| &test.limits).filter(judged).count()
        };
        let (violated, undecided) = (count(Judged::Outside), count(Judged::Undecided));
        let summary = match (self.limits, violated, undecided) {
            (0, ..) => "no limits".into(),
            (_, 0, 0) => format!("{limits}, all met"),
            (_, _, 0) => format!("{violated} of {limits} violated"),
            (_, 0, _) => format!("{undecided} of {limits} undecided"),
            _ => format!("{violated} of {limits} violated, {undecided} undecided"),
        };
        summary + &missing
    }

    /// Prints the report.
    ///
    /// # Errors
    /// The output cannot be written.
    pub fn print(out: &mut dyn Write, report: &Self) -> io::Result<()> {
        writeln!(out, "{}", report.title)?;
        match &report.origin {
            Origin::Model { damper, overrides } => {
                let damper = [std::slice::from_ref(damper), overrides].concat();
                writeln!(out, "{}", damper.join(" "))?;
            }
            Origin::Recordings { recordings, .. } => print_recordings(out, recordings)?,
        }
        for field in &report.fields {
            writeln!(out, "{}: {}", field.name, field.text)?;
        }
        for test in &report.tests {
            test.print(out)?;
        }
        if let Origin::Recordings {
            missing,
            other_motions,
            unused_cycles,
            ..
        } = &report.origin
        {
            writeln!(out)?;
            for name in missing {
                writeln!(out, "warning: not measured: {name}")?;
            }
            for other in other_motions {
                writeln!(out, "note: {}", other.described())?;
            }
            for line in unused_described(unused_cycles) {
                writeln!(out, "note: {line}")?;
            }
        }
        for warning in &report.warnings {
            writeln!(out, "warning: {warning}")?;
        }
        let summary = report.summary();
        match report.verdict {
            SheetVerdict::NoLimits => writeln!(out, "\n{summary}")?,
            verdict => {
                let line = format!("{}: {summary}", verdict.word());
                writeln!(out, "\n{}", Verdict::of(verdict.is_good()).mark(line))?;
            }
        }
        if let Some(page) = &report.page {
            writeln!(out, "page: {page}")?;
        }
        Ok(())
    }
}

fn print_recordings(out: &mut dyn Write, recordings: &[RecordingLine]) -> io::Result<()> {
    for recording in recordings {
        let temperature = match recording.temperature_c {
            Some(temperature_c) => format!("oil {temperature_c} °C"),
            None => "oil temperature not given".into(),
        };
        writeln!(
            out,
            "{}: {} samples in {:.1} s, {temperature}, SHA-256 {}",
            recording.name, recording.samples, recording.duration_s, recording.sha256
        )?;
    }
    Ok(())
}

impl OtherMotion {
    /// Describes the motion.
    pub(super) fn described(&self) -> String {
        format!(
            "{}, from {:.2} s: ±{:.3} mm at {:.4} Hz belongs to no test of the sheet",
            self.recording,
            self.start_s,
            self.amplitude_m * 1e3,
            self.frequency_hz
        )
    }
}

/// Describes cycles that were not used. Those of starts and stops are counted together.
pub(super) fn unused_described(unused: &[(String, UnusedCycles)]) -> Vec<String> {
    let (long, short): (Vec<_>, Vec<_>) = unused
        .iter()
        .partition(|(_, cycles)| cycles.cycles >= MIN_CYCLES);
    let mut lines: Vec<String> = long.into_iter().map(described).collect();
    let count: usize = short.iter().map(|(_, cycles)| cycles.cycles).sum();
    if count > 0 {
        let word = if count == 1 { "cycle" } else { "cycles" };
        lines.push(format!(
            "{count} single {word} not used, such as those of starts and stops"
        ));
    }
    lines
}

fn described((recording, cycles): &(String, UnusedCycles)) -> String {
    let reason = match cycles.reason {
        Unused::NotHarmonic => format!("not a sine within {:.0} % (rms)", 100.0 * MAX_DISTORTION),
        Unused::FewCycles => format!("fewer than {MIN_CYCLES} steady cycles"),
        Unused::FewSamples => format!("fewer than {MIN_SAMPLES_PER_CYCLE:.0} samples per cycle"),
    };
    format!(
        "{recording}, from {:.2} s: {} cycles of ±{:.3} mm at {:.4} Hz not used: {reason}",
        cycles.start_s,
        cycles.cycles,
        cycles.amplitude_m * 1e3,
        cycles.frequency_hz
    )
}

impl TestReport {
    /// Describes the motion.
    fn motion(&self) -> String {
        let mut motion = format!(
            "±{:.3} mm at {:.4} Hz, peak {:.4} m/s",
            self.amplitude_m * 1e3,
            self.frequency_hz,
            self.peak_velocity_m_per_s
        );
        if let Some(temperature_c) = self.temperature_c {
            motion += &format!(", oil {temperature_c} °C");
        }
        if let Some(measured) = &self.measured {
            motion += &format!(
                "\n  {}, {:.2} to {:.2} s: {} steady cycles",
                measured.recording, measured.start_s, measured.end_s, self.cycles
            );
            if measured.unsteady_cycles > 0 {
                motion += &format!(", {} left out as unsteady", measured.unsteady_cycles);
            }
        }
        motion
    }

    fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "\n{}: {}", self.name, self.motion())?;
        for (index, value) in &self.indices {
            let unit = index.display_unit().symbol;
            let limit = self.limits.iter().find(|limit| limit.index == *index);
            write!(out, "  {:<38}{unit:<8}", index.name())?;
            let text = limit.map_or_else(|| value_of(*index, *value), |limit| limit.formatted());
            write!(out, "{text:>10}")?;
            if let Some(measured) = &self.measured {
                let half_width = measured.half_widths.get(index).copied().flatten();
                let text = half_width.map(|half_width| half_width_of(*index, half_width));
                let text = text.map(|text| format!("± {text}")).unwrap_or_default();
                write!(out, " {text:<9}")?;
            }
            if let Some(limit) = limit {
                let clause = [
                    limit.deviation().as_str(),
                    limit.clause.as_deref().unwrap_or(""),
                ]
                .join(" ");
                let line = format!(
                    "  {:<9} {:<22} {}",
                    limit.colour().mark(limit.word()),
                    limit.allowed(),
                    clause.trim()
                );
                write!(out, "{}", line.trim_end())?;
            }
            writeln!(out)?;
        }
        Ok(())
    }
}
