//! The page of a run.

use maud::{Markup, html};

use super::figures;
use super::history::{Forces, History};
use super::report::Found;
use dashpot_realtime::timing::{optional_span, span};
use dashpot_report::DrawError;
use dashpot_report::page::{document, figure, footer, tiles};

/// The run as HTML.
///
/// # Errors
/// A figure cannot be drawn.
pub(super) fn write(found: &Found, history: &History) -> Result<String, DrawError> {
    let report = &found.report;
    let is_paced = report.pacing.is_some();
    let clock_ticks = html! {
        "Clock ticks of " (f64::from(report.target.clock_hz) * 1e-6)
        " MHz that one tick of the whole bank took: how often (first) and over time (second)."
    };
    let round_trip = html! {
        "From a step's request to its answer, repeated requests and recoveries included."
        @if is_paced { " Dashed: one step." }
    };
    let body = html! {
        h1 { "Processor in the loop" }
        p.lead { (found.title()) "." }
        (headline(found))
        (summary(found))
        h2 { "Forces" }
        p {
            "Displacement and force are positive in extension; place i runs i ticks behind place 0."
        }
        (legend_of_marks(found))
        @for (place, forces) in history.places.iter().enumerate() {
            h3 { "Place " (place) ": " (found.damper(place)) }
            (figure(&figures::forces(history, forces), &forces_caption(forces))?)
        }
        h2 { "Cost on the target" }
        (figure(&figures::clock_ticks(history), &clock_ticks)?)
        h2 { "Round trip" }
        (figure(&figures::round_trip(history, is_paced), &round_trip)?)
        (footer(&html! {
            "A long run is thinned to the lowest and highest value of each stretch of ticks, so every peak is shown. \
             Faults made and recoveries stand as marks on the time axes."
        }))
    };
    Ok(document("Dashpot: processor in the loop", &body))
}

fn forces_caption(forces: &Forces) -> Markup {
    html! {
        @if forces.differ {
            "Some forces differ from the host's. Red, on axes of its own: target less host."
        } @else {
            "Every force has the host's bits."
        }
    }
}

/// What the marks on the time axes are, where there are any.
fn legend_of_marks(found: &Found) -> Markup {
    let has_faults = found.injected_faults.unwrap_or_default() != Default::default();
    let kinds = [
        (has_faults, "amber a fault made"),
        (
            found.report.recoveries > 0,
            "red a recovery, when the target was given its dampers and states again",
        ),
    ];
    let kinds: Vec<&str> = kinds
        .into_iter()
        .filter_map(|(is_there, kind)| is_there.then_some(kind))
        .collect();
    html! {
        @if !kinds.is_empty() {
            p { "Marks on the time axes: " (kinds.join(", ")) "." }
        }
    }
}

fn headline(found: &Found) -> Markup {
    let report = &found.report;
    let differing = report.mismatches + report.state_mismatches as u64;
    let last = match &report.pacing {
        Some(pacing) => (
            html! { (format!("{:.2} %", 1e2 * pacing.missed_share)) },
            "of the ticks missed their deadline: answered after the next was due".into(),
        ),
        None => (
            html! { (report.recoveries) },
            "recoveries: the target was given its dampers and states again".into(),
        ),
    };
    tiles(&[
        (
            html! { (differing) },
            "forces, status words and states that differ from the host's, in bits".into(),
        ),
        (
            html! { (optional_span(report.round_trip.p50_ns)) },
            format!(
                "round trip at the median, {} at most",
                span(report.round_trip.worst_ns)
            ),
        ),
        (
            html! { (format!("{:.0}", report.clock_ticks.max)) },
            "clock ticks of the target at most for one tick of the whole bank".into(),
        ),
        last,
    ])
}

fn summary(found: &Found) -> Markup {
    html! {
        div.wide {
            table {
                @for (name, result) in found.lines() {
                    tr { td { (name) } td.text { (result) } }
                }
            }
        }
    }
}
