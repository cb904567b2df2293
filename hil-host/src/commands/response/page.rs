//! HTML page of `dashpot response`.

use maud::{Markup, html};
use plotters::style::RGBColor;

use super::report::{Kind, Report, Series, formatted};
use crate::commands::failure::Outcome;
use dashpot_files::study::format_number;
use dashpot_report::DrawError;
use dashpot_report::page::{Figure, document, figure, footer};
use dashpot_report::plot::curves::{Curve, ramp};
use dashpot_report::plot::response;
use dashpot_report::plot::sheet::Scale;
use dashpot_report::plot::style::AMBER_LINE;

/// Height of a panel (pixels).
const HEIGHT: u32 = 300;

/// Returns the page.
///
/// # Errors
/// A figure cannot be drawn.
pub(super) fn write(report: &Report) -> Outcome<String> {
    let mut figures = Vec::new();
    match &report.over {
        None => {
            let all: Vec<&Series> = report.series.iter().collect();
            figures.push((String::new(), part(report, &all)?));
        }
        // Each amplitude has one figure, which compares the parameter values.
        Some(_) => {
            let harmonic = |series: &&Series| series.response == Kind::Harmonic;
            let first = report.series.first().and_then(|series| series.value);
            let amplitudes = report.series.iter().filter(harmonic);
            let amplitudes = amplitudes.filter(|series| series.value == first);
            for amplitude_m in amplitudes.filter_map(|series| series.amplitude_m) {
                let belongs =
                    |series: &&Series| series.amplitude_m.is_none_or(|other| other == amplitude_m);
                let chosen: Vec<&Series> = report.series.iter().filter(belongs).collect();
                let title = format!("Amplitude {} mm", format_number(amplitude_m * 1e3));
                figures.push((title, part(report, &chosen)?));
            }
        }
    }
    let body = html! {
        h1 { "Frequency response of a damper" }
        p.lead {
            (report.damper) @for change in &report.overrides { " " (change) }
            ": ratio of the first harmonics of settled force and displacement"
            @if let Some(key) = &report.over { ", for several values of " (key) }
            "."
        }
        @for (title, figure) in &figures {
            @if !title.is_empty() { h2 { (title) } }
            (figure)
        }
        (differences(report))
        (footer(&html! { "Definitions: docs/model.md, frequency response." }))
    };
    Ok(document("Dashpot: frequency response", &body))
}

/// Draws dynamic stiffness, loss angle and damping of `series`.
fn part(report: &Report, series: &[&Series]) -> Result<Markup, DrawError> {
    let harmonic = series
        .iter()
        .filter(|series| series.response == Kind::Harmonic);
    let colours: Vec<_> = ramp(harmonic.clone().count());
    let coloured: Vec<(&&Series, RGBColor)> = harmonic.zip(colours).collect();
    let colour = |wanted: &Series| {
        let is_same = |other: &Series| {
            other.value == wanted.value
                && (report.over.is_some() || other.amplitude_m == wanted.amplitude_m)
        };
        let found = coloured.iter().find(|(other, _)| is_same(other));
        found.map_or(AMBER_LINE, |(_, colour)| *colour)
    };
    let mut panels = response::panels(Scale::Decades);
    for series in series {
        // Dashed and dotted curves have the colour of the solid line they belong to. Of these curves, only the
        // linearised one without a parameter has a label.
        let name = match (series.response, &report.over, series.value) {
            (Kind::Harmonic, Some(_), Some(value)) => formatted(value),
            (Kind::Harmonic, ..) => series.name(),
            (Kind::Linearised, None, _) => "linearised".into(),
            (Kind::Linearised | Kind::Swept, ..) => String::new(),
        };
        let curves = response::of(&name, colour(series), &series.responses, Scale::Decades);
        for (panel, curve) in panels.iter_mut().zip(curves) {
            panel.curves.push(drawn(series.response, curve));
        }
    }
    let drawing = Figure {
        panels: panels.into(),
        height: HEIGHT,
        cursor_group: Some("frequency"),
    };
    let caption = html! {
        "Lines: harmonic, periodic at each frequency. Dashes: linearised, at a peak velocity of 0.1 mm/s with the "
        "clearance taken up."
        @if report.swept_sine.is_some() { " Points: swept." }
        " The loss angle is the phase by which the force leads the displacement. Damping is the ratio of force to "
        "velocity, in phase with the velocity."
    };
    figure(&drawing, &caption)
}

fn drawn(kind: Kind, curve: Curve) -> Curve {
    match kind {
        Kind::Harmonic => curve,
        Kind::Linearised => curve.dashed(),
        Kind::Swept => curve.dotted(),
    }
}

/// Compares swept with harmonic values.
fn differences(report: &Report) -> Markup {
    let swept: Vec<&Series> = report
        .series
        .iter()
        .filter(|series| series.response == Kind::Swept)
        .collect();
    html! {
        @if let Some(sweep) = &report.swept_sine {
            h2 { "Swept compared with harmonic" }
            p {
                "One motion of constant amplitude through all frequencies at " (sweep.octaves_per_minute)
                " octaves per minute; each value by synchronous demodulation with a " (sweep.window) " window of "
                (sweep.window_cycles) " cycles."
            }
            div.wide {
                table {
                    tr {
                        th { "curve" }
                        th { "largest difference in complex stiffness," br; "% of the harmonic stiffness" }
                    }
                    @for series in swept {
                        tr {
                            td { (series.name()) }
                            td {
                                @match series.largest_difference {
                                    Some(largest) => (format!("{:.3}", largest * 100.0)),
                                    None => "no force",
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}
