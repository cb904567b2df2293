//! HTML page of a sheet, for archiving or printing.

use dashpot_files::sheet::Index;
use maud::{Markup, html};

use super::figures;
use super::limit::{half_width_of, value_of};
use super::text::unused_described;
use super::{Judged, Limited, Origin, RecordingLine, SheetReport, SheetVerdict, TestReport};
use crate::DrawError;
use crate::page::{document, figure, footer};

impl SheetReport {
    fn limits_by_test(&self) -> impl Iterator<Item = (&TestReport, &Limited)> {
        let tests = self.tests.iter();
        tests.flat_map(|test| test.limits.iter().map(move |limit| (test, limit)))
    }

    /// Returns the page.
    ///
    /// # Errors
    /// A figure cannot be drawn.
    pub fn to_html(&self) -> Result<String, DrawError> {
        let is_measured = matches!(self.origin, Origin::Recordings { .. });
        let kind = if is_measured { "Measured" } else { "Computed" };
        let body = html! {
            (stamp(self))
            h1 { (self.title) }
            (lead(&self.origin))
            (head(self))
            @if self.limits > 0 {
                h2 { "Limits" }
                (limits(self))
            }
            (remarks(self))
            h2 { "Tests" }
            (tests(&self.tests))
            @if !self.tests.is_empty() {
                h2 { "Loops" }
                (figure(&figures::loops_of(&self.tests), &html! {
                    (kind) " force against displacement (first) and velocity (second), "
                    @if is_measured { "mean of the steady cycles of every test." }
                    @else { "one periodic cycle of every test." }
                })?)
                h2 { "Forces" }
                (figure(&figures::over_tests(&self.tests), &html! {
                    "Maximum forces of every test, by its number in the table of tests."
                    @if self.limits > 0 {
                        " Bars show the range allowed by the limits of the same test; without a limit on one side, the "
                        "bar ends at the point."
                    }
                })?)
                (figure(&figures::over_speed(&self.tests), &html! {
                    "Maximum forces of every test against its peak velocity."
                })?)
            }
            @if let Some(over_temperature) = &figures::over_temperature(&self.tests) {
                h2 { "Forces against temperature" }
                (figure(over_temperature, &html! {
                    "Maximum forces of each motion that is tested at several temperatures."
                })?)
            }
            @if is_measured { (signature()) }
            (footer(&html! {
                "Sheet: " (self.sheet) ". Limits and cited clauses are those of the sheet. "
                "docs/reference/indices.md defines each index."
                @if is_measured {
                    " Intervals (±) are of 95 %, from the scatter between cycles and the stated uncertainty of the "
                    "sensors."
                }
            }))
        };
        Ok(document(&format!("Dashpot: {}", self.title), &body))
    }
}

/// The verdict in a word and a colour.
fn stamp(report: &SheetReport) -> Markup {
    let colour = match report.verdict {
        SheetVerdict::NoLimits => "stamp",
        verdict if verdict.is_good() => "stamp good",
        _ => "stamp bad",
    };
    html! {
        div class=(colour) {
            b { (report.verdict.word()) }
            span { (report.summary()) }
        }
    }
}

fn lead(origin: &Origin) -> Markup {
    html! {
        p.lead {
            @match origin {
                Origin::Model { damper, overrides } => {
                    "Bench sheet of the damper " (damper) @for change in overrides { " " (change) }
                    ", computed from its model, not measured."
                }
                Origin::Recordings { .. } => "Bench sheet, computed from the recordings named below.",
            }
        }
    }
}

/// Draws the header: fields, and the recordings.
fn head(report: &SheetReport) -> Markup {
    html! {
        @if !report.fields.is_empty() {
            div.wide.worded {
                table.fields {
                    @for field in &report.fields {
                        tr { th { (field.name) } td.text { (field.text) } }
                    }
                }
            }
        }
        @if let Origin::Recordings { recordings, .. } = &report.origin { (recorded(recordings)) }
    }
}

fn recorded(recordings: &[RecordingLine]) -> Markup {
    html! {
        div.wide.worded {
            table {
                thead {
                    tr { th { "recording" } th { "samples" } th { "s" } th { "oil, °C" } th.text { "SHA-256" } }
                }
                @for recording in recordings {
                    tr {
                        td { (recording.name) }
                        td { (recording.samples) }
                        td { (format!("{:.1}", recording.duration_s)) }
                        td { (temperature(recording.temperature_c)) }
                        td.text.digest { (recording.sha256) }
                    }
                }
            }
        }
    }
}

fn temperature(temperature_c: Option<f64>) -> String {
    temperature_c.map_or("not given".into(), |temperature_c| {
        minus(&temperature_c.to_string())
    })
}

/// Lists what the reader has to know: tests without a measurement, motions without a test, and warnings.
fn remarks(report: &SheetReport) -> Markup {
    let mut remarks = Vec::new();
    if let Origin::Recordings {
        missing,
        other_motions,
        unused_cycles,
        ..
    } = &report.origin
    {
        remarks.extend(missing.iter().map(|name| format!("Not measured: {name}")));
        remarks.extend(report.warnings.iter().cloned());
        remarks.extend(other_motions.iter().map(|other| other.described()));
        remarks.extend(unused_described(unused_cycles));
    }
    html! {
        @if !remarks.is_empty() {
            h2 { "Remarks" }
            ul { @for remark in &remarks { li { (remark) } } }
        }
    }
}

/// Tabulates every limit, with violations in amber.
fn limits(report: &SheetReport) -> Markup {
    let has = |part: fn(&Limited) -> bool| report.limits_by_test().any(|(_, limit)| part(limit));
    let has_intervals = has(|limit| limit.half_width.is_some());
    let has_nominal = has(|limit| limit.nominal.is_some());
    html! {
        div.wide.worded {
            table {
                thead {
                    tr {
                        th { "test" } th.text { "index" } th { "unit" } th { "value" }
                        @if has_intervals { th { "±" } }
                        th { "allowed" }
                        @if has_nominal { th { "from nominal" } }
                        th.text { "clause" } th.text { "verdict" }
                    }
                }
                @for (test, limit) in report.limits_by_test() {
                    tr class=[(!limit.kept).then_some("over")] {
                        td { (test.name) }
                        td.text { (limit.index.name()) }
                        td { (limit.index.display_unit().symbol) }
                        td { b { (minus(&limit.formatted())) } }
                        @if has_intervals {
                            td { @if let Some(width) = limit.half_width { (half_width_of(limit.index, width)) } }
                        }
                        td { (minus(&limit.allowed())) }
                        @if has_nominal { td { (minus(&limit.deviation())) } }
                        td.text { (limit.clause.as_deref().unwrap_or("")) }
                        td.text { (judged(limit)) }
                    }
                }
            }
        }
    }
}

fn judged(limit: &Limited) -> Markup {
    match limit.verdict {
        Judged::Undecided => html! { span.above { "? " (limit.word()) } },
        verdict => crate::page::judged(verdict == Judged::Within, limit.word()),
    }
}

/// Tabulates the motions, then every index, with one row per test.
fn tests(tests: &[TestReport]) -> Markup {
    let has_oil = tests.iter().any(|test| test.temperature_c.is_some());
    let is_measured = tests.iter().any(|test| test.measured.is_some());
    html! {
        div.wide.worded {
            table {
                thead {
                    tr {
                        th.text { "test" } th { "amplitude, mm" } th { "frequency, Hz" } th { "peak velocity, m/s" }
                        @if has_oil { th { "oil, °C" } }
                        @if is_measured { th.text { "recording" } th { "from, s" } th { "steady cycles" } }
                    }
                }
                @for (number, test) in (1..).zip(tests) {
                    tr {
                        td { (number) ". " (test.name) }
                        td { (format!("{:.3}", test.amplitude_m * 1e3)) }
                        td { (format!("{:.4}", test.frequency_hz)) }
                        td { (format!("{:.4}", test.peak_velocity_m_per_s)) }
                        @if has_oil { td { (temperature(test.temperature_c)) } }
                        @if let Some(measured) = &test.measured {
                            td.text { (measured.recording) }
                            td { (format!("{:.2}", measured.start_s)) }
                            td { (test.cycles) }
                        }
                    }
                }
            }
        }
        div.wide.worded.tight {
            table {
                thead {
                    tr {
                        th { "test" }
                        @for index in Index::ALL { th { (index.name()) ", " (index.display_unit().symbol) } }
                    }
                }
                @for test in tests {
                    tr {
                        td { (test.name) }
                        @for (index, value) in &test.indices {
                            td {
                                (minus(&value_of(*index, *value)))
                                @if let Some(width) = half_width(test, *index) {
                                    br; small { "± " (half_width_of(*index, width)) }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn half_width(test: &TestReport, index: Index) -> Option<f64> {
    let measured = test.measured.as_ref()?;
    measured.half_widths.get(&index).copied().flatten()
}

/// Lines for date, name and signature.
fn signature() -> Markup {
    html! {
        div.signature {
            @for name in ["Place and date", "Name", "Signature"] { span { (name) } }
        }
    }
}

/// Replaces hyphens by minus signs.
fn minus(number: &str) -> String {
    number.replace('-', "−")
}
