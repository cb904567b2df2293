//! HTML page of a sheet, for archiving or printing.

use maud::{Markup, html};

use super::figures;
use super::report::{Report, TestReport, value_of};
use crate::commands::failure::Outcome;
use dashpot_files::sheet::Index;
use dashpot_report::page::{document, figure, footer, judged, tiles};
use dashpot_testbench::bench_sheet::Tested;

/// Returns the page.
///
/// # Errors
/// A figure cannot be drawn.
pub(super) fn write(report: &Report, tested: &[Tested<'_>]) -> Outcome<String> {
    let loops = html! {
        "Computed force against displacement (first) and velocity (second), one periodic cycle of every test."
    };
    let over_speed = html! {
        "Maximum forces of every test against its peak velocity."
        @if report.limits > 0 {
            " Bars show the range allowed by the limits of the test; without a limit on one side, the bar ends at the "
            "point."
        }
    };
    let over_temperature = figures::over_temperature(tested);
    let body = html! {
        h1 { (report.title) }
        p.lead {
            "Bench sheet of the damper " (report.damper) @for change in &report.overrides { " " (change) }
            ", computed from its model, not measured."
        }
        (head(report))
        (headline(report))
        @if report.limits > 0 {
            h2 { "Limits" }
            (limits(report))
        }
        h2 { "Tests" }
        (tests(&report.tests))
        h2 { "Loops" }
        (figure(&figures::loops_of(tested), &loops)?)
        h2 { "Forces against velocity" }
        (figure(&figures::over_speed(tested), &over_speed)?)
        @if let Some(over_temperature) = &over_temperature {
            h2 { "Forces against temperature" }
            (figure(over_temperature, &html! {
                "Maximum forces of each motion that is tested at several temperatures."
            })?)
        }
        (footer(&html! {
            "Sheet: " (report.sheet) ". Limits and cited clauses are those of the sheet. "
            "docs/reference/indices.md defines each index."
        }))
    };
    Ok(document(&format!("Dashpot: {}", report.title), &body))
}

/// Draws the header fields of the sheet.
fn head(report: &Report) -> Markup {
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
    }
}

fn headline(report: &Report) -> Markup {
    let tests = (html! { (report.tests.len()) }, "tests".to_owned());
    let verdict = match (report.limits, report.limits_not_kept) {
        (0, _) => (html! { "none" }, "limits in the sheet".into()),
        (all, outside) => (
            html! { (all - outside) " of " (all) },
            if outside == 0 {
                "limits met".into()
            } else {
                format!("limits met; {outside} violated")
            },
        ),
    };
    tiles(&[tests, verdict])
}

/// Tabulates every limit, with violations in amber.
fn limits(report: &Report) -> Markup {
    let rows = report
        .tests
        .iter()
        .flat_map(|test| test.limits.iter().map(move |limit| (test, limit)));
    html! {
        div.wide.worded {
            table {
                thead {
                    tr {
                        th { "test" } th.text { "index" } th { "unit" } th { "value" } th { "allowed" }
                        th.text { "clause" } th.text { "verdict" }
                    }
                }
                @for (test, limit) in rows {
                    tr class=[(!limit.kept).then_some("over")] {
                        td { (test.name) }
                        td.text { (limit.index.name()) }
                        td { (limit.index.display_unit().symbol) }
                        td { b { (minus(&limit.formatted())) } }
                        td { (minus(&limit.allowed())) }
                        td.text { (limit.clause.as_deref().unwrap_or("")) }
                        td.text { (judged(limit.kept, limit.verdict())) }
                    }
                }
            }
        }
    }
}

/// Tabulates the motions, then every index, with one row per test.
fn tests(tests: &[TestReport]) -> Markup {
    let has_oil = tests.iter().any(|test| test.temperature_c.is_some());
    html! {
        div.wide.worded {
            table {
                thead {
                    tr {
                        th { "test" } th { "amplitude, mm" } th { "frequency, Hz" } th { "peak velocity, m/s" }
                        @if has_oil { th { "oil, °C" } }
                    }
                }
                @for test in tests {
                    tr {
                        td { (test.name) }
                        td { (format!("{:.3}", test.amplitude_m * 1e3)) }
                        td { (format!("{:.4}", test.frequency_hz)) }
                        td { (format!("{:.4}", test.peak_velocity_m_per_s)) }
                        @if has_oil {
                            td {
                                @if let Some(temperature_c) = test.temperature_c { (minus(&temperature_c.to_string())) }
                            }
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
                        @for (index, value) in &test.indices { td { (minus(&value_of(*index, *value))) } }
                    }
                }
            }
        }
    }
}

/// Replaces hyphens by minus signs.
fn minus(number: &str) -> String {
    number.replace('-', "−")
}
