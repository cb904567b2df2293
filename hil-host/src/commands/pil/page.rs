//! HTML page of a PIL run.

use maud::{Markup, html};

use super::figures;
use super::history::History;
use super::report::Found;
use dashpot_realtime::timing::{optional_span, span};
use dashpot_report::DrawError;
use dashpot_report::page::{document, figure, footer, judged, tiles};

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
        (slots(found, history))
        (figure(&figures::forces(history, &distinct(found, history)), &html! {
            "Forces on the target, one slot of each damper."
        })?)
        @for (slot, forces) in history.places.iter().enumerate().filter(|(_, forces)| forces.differ) {
            h3 { "Slot " (slot) ": " (found.damper(slot)) }
            (figure(&figures::difference(history, forces), &html! {
                "Some forces differ from those of the host: target minus host, and both forces."
            })?)
        }
        h2 { "Round trip" }
        (figure(&figures::round_trip(history, is_paced), &round_trip)?)
        h2 { "Cost on the target" }
        (figure(&figures::clock_ticks(history), &clock_ticks)?)
        (footer(&html! {
            "For a long run, curves show the minimum and maximum of each group of ticks, so every peak is visible. \
             Injected faults and recoveries are marked on the time axes."
        }))
    };
    Ok(document("Dashpot: processor in the loop", &body))
}

/// Tabulates the slots with their largest force and their largest difference from the host.
fn slots(found: &Found, history: &History) -> Markup {
    html! {
        div.wide { table {
            thead {
                tr {
                    th { "slot" } th.text { "damper" } th { "largest force, kN" }
                    th { "target minus host, at most, N" } th.text { "forces" }
                }
            }
            @for (slot, forces) in history.places.iter().enumerate() {
                @let [force_n, difference_n] = forces.largest_n();
                tr {
                    td { (slot) }
                    td.text { (found.damper(slot)) }
                    td { (format!("{:.2}", 1e-3 * force_n)) }
                    td { @if difference_n == 0.0 { "0" } @else { (format!("{difference_n:.2e}")) } }
                    td.text {
                        (judged(!forces.differ, if forces.differ { "differ" } else { "bit-identical to the host" }))
                    }
                }
            }
        } }
    }
}

/// Returns the first slot of each damper, with the name of the damper.
fn distinct<'a>(found: &'a Found, history: &History) -> Vec<(usize, &'a str)> {
    let mut slots: Vec<(usize, &str)> = Vec::new();
    for slot in 0..history.places.len() {
        let damper = found.damper(slot);
        if slots.iter().all(|(_, known)| *known != damper) {
            slots.push((slot, damper));
        }
    }
    slots
}

/// Explains the marks on the time axes, if there are any.
fn legend_of_marks(found: &Found) -> Markup {
    let has_faults = found.injected_faults.unwrap_or_default() != Default::default();
    let kinds = [
        (has_faults, "injected faults"),
        (
            found.report.recoveries > 0,
            "recoveries, in which dampers and states were restored on the target",
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
