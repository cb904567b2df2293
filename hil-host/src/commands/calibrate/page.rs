//! HTML page of a calibration.

use maud::{Markup, html};

use super::report::{Loop, Number, Report};
use crate::commands::failure::Outcome;
use crate::commands::raw_name::in_words;
use dashpot_calibration::{Calibrated, Calibration, LoopFit, LoopTest, Profile, RISE_95};
use dashpot_report::DrawError;
use dashpot_report::page::{Figure, document, figure, footer, panel, tiles};
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::loops;
use dashpot_report::plot::style::{BEFORE, COMPARED, DIFFERENCE, FINE, LIMIT, RESULT};

/// Height of a panel (pixels).
const HEIGHT: u32 = 300;

/// Maximum number of samples drawn per loop.
const MAX_SAMPLES: usize = 2000;

/// Formats a number with U+2212 as minus sign, at which browsers do not break a line.
fn digits(value: f64) -> String {
    super::digits::digits(value).replace('-', "\u{2212}")
}

/// Returns the page.
///
/// # Errors
/// A figure cannot be drawn.
pub(super) fn write(
    report: &Report,
    calibration: &Calibration,
    found: &Calibrated,
) -> Outcome<String> {
    let tests = calibration
        .loops
        .iter()
        .zip(&found.loops)
        .zip(&report.loops);
    let body = html! {
        h1 { "Calibrated damper" }
        p.lead { (report.before()) ", with parameters identified from bench tests by least squares." }
        (headline(report))
        h2 { "Parameters" }
        (numbers(report))
        (notes(report))
        (profiles(report, found)?)
        h2 { "Tests" }
        @if !report.loops.is_empty() { (loop_table(&report.loops)) }
        @if !report.indices.is_empty() { (index_table(report)) }
        (report.further.tables())
        @for ((test, fit), row) in tests { (loop_figures(calibration.step_s, test, fit, row)?) }
        (footer(&html! {
            "The damper file is " code { (report.output) } "; its header lists the tests. docs/calibration.md "
            "describes how values and intervals are found."
        }))
    };
    Ok(document("Dashpot: calibrated damper", &body))
}

fn headline(report: &Report) -> Markup {
    let worst = report.loops.iter().max_by(|a, b| {
        let share = |row: &Loop| row.missed_after_n / row.peak_force_n;
        share(a).total_cmp(&share(b))
    });
    let mut shown: Vec<(Markup, String)> = report
        .numbers
        .iter()
        .map(|number| (html! { (digits(number.found)) }, in_words(&number.key)))
        .collect();
    if let Some(row) = worst {
        let share = 100.0 * row.missed_after_n / row.peak_force_n;
        shown.push((
            html! { (format!("{share:.1} %")) },
            "rms residual in the worst test, relative to the peak force".into(),
        ));
    }
    tiles(&shown)
}

fn numbers(report: &Report) -> Markup {
    let end = |end: Option<f64>| end.map_or_else(|| "bound".into(), digits);
    html! {
        div.wide.worded {
            table {
                tr {
                    th { "parameter" } th { "before" } th { "found" } th { "95 % interval" } th { "prior" }
                    th { "determined by" }
                }
                @for number in &report.numbers {
                    tr {
                        td { (in_words(&number.key)) br; code { (number.key) } }
                        td { (digits(number.before)) }
                        td { b { (digits(number.found)) } }
                        td { (end(number.least)) " to " (end(number.greatest)) }
                        td {
                            @if let Some(prior) = number.prior {
                                (digits(prior.mean)) " ± " (digits(prior.standard_deviation))
                            }
                        }
                        td { @if number.by_tests { "tests" } @else { "tests and prior" } }
                    }
                }
            }
        }
    }
}

fn notes(report: &Report) -> Markup {
    html! {
        @for influence in &report.influences { p { "Assumed: " (influence.words(&report.numbers)) "." } }
        @for warning in &report.warnings { p.note { (warning.words) "." } }
    }
}

/// Draws the profile likelihood of each parameter: the rise of the sum of squares around its best value.
fn profiles(report: &Report, found: &Calibrated) -> Result<Markup, DrawError> {
    let panel_of = |(number, profile): (&Number, &Profile)| {
        let centre = number.found;
        // Use percent where possible, so that the tick labels are readable.
        let (scale, label) = match centre {
            0.0 => (1.0, "change from the value found"),
            _ => (100.0 / centre.abs(), "change from the value found, %"),
        };
        let shown = |value: f64| (value - centre) * scale;
        let points = profile
            .points
            .iter()
            .filter(|(_, rise)| *rise <= 2.0 * RISE_95);
        let points: Vec<(f64, f64)> = points.map(|(value, rise)| (shown(*value), *rise)).collect();
        // On each side of the minimum, the rise is nearly a parabola.
        let side = |end: Option<&(f64, f64)>| {
            let (end, rise) = end.copied().unwrap_or((0.0, 0.0));
            (0..=20).map(move |part| {
                let fraction = f64::from(part) / 20.0;
                (end * fraction, rise * fraction * fraction)
            })
        };
        let (first, last) = (side(points.first()), side(points.last()));
        let limit = [points.first(), points.last()].into_iter().flatten();
        let limit: Vec<(f64, f64)> = limit.map(|(value, _)| (*value, RISE_95)).collect();
        let mut panel = panel(
            label,
            "rise of chi-square",
            vec![
                Curve::new("95 %", LIMIT, limit).dashed(),
                Curve::new("", RESULT, first.rev().chain(last).collect::<Vec<_>>()),
                Curve::new("", RESULT, points).dotted(),
            ],
        );
        panel.title = in_words(&number.key);
        panel.sides = true;
        panel
    };
    let profiles = Figure {
        panels: report
            .numbers
            .iter()
            .zip(&found.profiles)
            .map(panel_of)
            .collect(),
        height: 200,
        cursor_group: None,
    };
    figure(
        &profiles,
        &html! {
            "Profile likelihood (rise of chi-square): how much the fit of all tests worsens when one parameter is "
            "fixed at another value and the others are refitted. The 95 % interval ends where the curve crosses "
            "the dashed line."
        },
    )
}

fn loop_table(rows: &[Loop]) -> Markup {
    html! {
        div.wide.worded {
            table {
                tr {
                    th { "test" } th { "amplitude, mm" } th { "middle, mm" } th { "peak velocity, m/s" }
                    th { "peak force, kN" } th { "noise of force, N" }
                    th { "residual before, N" } th { "residual after, N" }
                }
                @for row in rows {
                    tr class=[row.misses.then_some("over")] {
                        td { (row.test) }
                        td { (format!("{:.2}", row.amplitude_m * 1e3)) }
                        td { (format!("{:.2}", row.displacement_offset_m * 1e3)) }
                        td { (format!("{:.3}", row.peak_velocity_m_per_s)) }
                        td { (format!("{:.2}", row.peak_force_n * 1e-3)) }
                        td { (format!("{:.0}", row.force_noise_n)) }
                        td { (format!("{:.0}", row.missed_before_n)) }
                        td { (format!("{:.0}", row.missed_after_n)) }
                    }
                }
            }
        }
    }
}

fn index_table(report: &Report) -> Markup {
    html! {
        div.wide.worded {
            table {
                tr { th { "test" } th { "index" } th { "measured" } th { "before" } th { "found" } }
                @for row in &report.indices {
                    @for (name, measured, before, after) in row.lines() {
                        tr {
                            td { (row.motion("±")) }
                            td { (name) }
                            td { (measured) }
                            td { (format!("{before:.1}")) }
                            td { (format!("{after:.1}")) }
                        }
                    }
                }
            }
        }
    }
}

/// Draws the loops of a test and the residual of the model.
fn loop_figures(
    step_s: f64,
    test: &LoopTest,
    fit: &LoopFit,
    row: &Loop,
) -> Result<Markup, DrawError> {
    let every = fit.after_n.len().div_ceil(MAX_SAMPLES).max(1);
    let measured = test.counted_forces_n();
    let (x, v) = (
        test.counted_displacements_m(),
        test.counted_velocities_m_per_s(step_s),
    );
    let over = |name: &str, colour, abscissas: &[f64], scale: f64, forces: &[f64]| {
        let points = abscissas.iter().zip(forces).step_by(every);
        let points: Vec<(f64, f64)> = points.map(|(x, f)| (x * scale, f * 1e-3)).collect();
        Curve::new(name, colour, points)
    };
    let curves = |abscissas: &[f64], scale| {
        vec![
            over("measured", COMPARED, abscissas, scale, measured).dotted(),
            over("before", BEFORE, abscissas, scale, &fit.before_n).wide(FINE),
            over("found", RESULT, abscissas, scale, &fit.after_n),
        ]
    };
    let loops = Figure {
        panels: loops::panels(curves(&x, 1e3), curves(&v, 1.0)),
        height: HEIGHT,
        cursor_group: None,
    };
    let times = test.counted_times_s(step_s);
    let missed = times.iter().zip(measured).zip(&fit.after_n).step_by(every);
    let missed = missed.map(|((time, f), model)| (*time, model - f));
    let missed = Figure {
        panels: vec![panel(
            "time, s",
            "found minus measured, N",
            vec![Curve::new("", DIFFERENCE, missed).wide(FINE)],
        )],
        height: 200,
        cursor_group: None,
    };
    let caption = html! {
        "Force against displacement (first) and velocity (second), with the noise of the displacement removed: "
                "measured, before and found."
    };
    let missed_caption = html! {
        "Residual of the model: " (format!("{:.0}", row.missed_after_n)) " N rms at a peak force of "
                (format!("{:.1}", row.peak_force_n * 1e-3)) " kN."
    };
    Ok(html! {
        h3 { (row.test) }
        (figure(&loops, &caption)?)
        (figure(&missed, &missed_caption)?)
    })
}
