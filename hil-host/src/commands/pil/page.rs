//! HTML page of a PIL run.

use maud::{Markup, html};

use super::figures;
use super::history::{Forces, History};
use super::report::Found;
use dashpot_realtime::timing::{optional_span, span};
use dashpot_report::DrawError;
use dashpot_report::page::{document, figure, footer, tiles};

/// Returns the run as HTML.
///
/// # Errors
/// A figure cannot be drawn.
pub(super) fn write(found: &Found, history: &History) -> Result<String, DrawError> {
    let report = &found.report;
    let is_paced = report.pacing.is_some();
    let clock_ticks = html! {
        "Clock ticks of " (f64::from(report.target.clock_hz) * 1e-6)
        " MHz per tick of the whole bank: histogram (first) and values over time (second)."
    };
    let round_trip = html! {
        "From the request of a step to its response, including repeated requests and recoveries."
        @if is_paced { " Dashed: one step." }
    };
    let body = html! {
        h1 { "Processor in the loop" }
        p.lead { (found.title()) "." }
        (headline(found))
        (summary(found))
        h2 { "Forces" }
        p {
            "Displacement and force are positive in extension; slot i runs i ticks behind slot 0."
        }
        (legend_of_marks(found))
        @for (slot, forces) in history.places.iter().enumerate() {
            h3 { "Slot " (slot) ": " (found.damper(slot)) }
            (figure(&figures::forces(history, forces), &forces_caption(forces))?)
        }
        h2 { "Cost on the target" }
        (figure(&figures::clock_ticks(history), &clock_ticks)?)
        h2 { "Round trip" }
        (figure(&figures::round_trip(history, is_paced), &round_trip)?)
        (footer(&html! {
            "For a long run, curves show the minimum and maximum of each group of ticks, so every peak is visible. \
             Injected faults and recoveries are marked on the time axes."
        }))
    };
    Ok(document("Dashpot: processor in the loop", &body))
}

fn forces_caption(forces: &Forces) -> Markup {
    html! {
        @if forces.differ {
            "Some forces differ from those of the host. Red, on separate axes: target minus host."
        } @else {
            "Every force is bit-identical to that of the host."
        }
    }
}

/// Explains the marks on the time axes, if there are any.
fn legend_of_marks(found: &Found) -> Markup {
    let has_faults = found.injected_faults.unwrap_or_default() != Default::default();
    let kinds = [
        (has_faults, "amber for an injected fault"),
        (
            found.report.recoveries > 0,
            "red for a recovery, in which dampers and states were restored on the target",
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
            "of the ticks missed their deadline: the response came after the next tick was due"
                .into(),
        ),
        None => (
            html! { (report.recoveries) },
            "recoveries, in which dampers and states were restored on the target".into(),
        ),
    };
    tiles(&[
        (
            html! { (differing) },
            "forces, status words and states that differ from those of the host in any bit".into(),
        ),
        (
            html! { (optional_span(report.round_trip.p50_ns)) },
            format!(
                "median round trip; maximum {}",
                span(report.round_trip.worst_ns)
            ),
        ),
        (
            html! { (format!("{:.0}", report.clock_ticks.max)) },
            "maximum clock ticks of the target per tick of the whole bank".into(),
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
