//! The page of a run.

use super::figures;
use super::history::History;
use super::report::Found;
use crate::commands::failure::Outcome;
use crate::realtime::timing::{optional_span, span};
use crate::report::page::{document, escaped, figure, footer, tiles};

/// The run as HTML.
///
/// # Errors
/// A figure cannot be drawn.
pub(super) fn write(found: &Found, history: &History) -> Outcome<String> {
    let report = &found.report;
    let mut parts = vec![
        "<h1>Processor in the loop</h1>".into(),
        format!("<p class=\"lead\">{}.</p>", escaped(&found.title())),
        headline(found),
        summary(found),
        "<h2>Forces</h2>".into(),
        "<p>Blue: the target. Grey, under it: the host. Displacement and force are positive in extension; place i \
         runs i ticks behind place 0.</p>"
            .into(),
        marked(found),
    ];
    for (place, forces) in history.places.iter().enumerate() {
        parts.push(format!(
            "<h3>Place {place}: {}</h3>",
            escaped(found.damper(place))
        ));
        let caption = if forces.differ {
            "Some forces differ from the host's. Red, on axes of its own: target less host."
        } else {
            "Every force has the host's bits."
        };
        parts.push(figure(&figures::forces(history, forces), caption)?);
    }
    parts.push("<h2>Cost on the target</h2>".into());
    parts.push(figure(
        &figures::clock_ticks(history),
        &format!(
            "Clock ticks of {} MHz that one tick of the whole bank took: how often (first) and over time (second).",
            f64::from(report.target.clock_hz) * 1e-6
        ),
    )?);
    parts.push("<h2>Round trip</h2>".into());
    parts.push(figure(
        &figures::round_trip(history, report.pacing.is_some()),
        if report.pacing.is_some() {
            "From a step's request to its answer, repeated requests and recoveries included. Dashed: one step."
        } else {
            "From a step's request to its answer, repeated requests and recoveries included."
        },
    )?);
    parts.push(footer(
        "A long run is thinned to the lowest and highest value of each stretch of ticks, so every peak is shown. \
         Faults made and recoveries stand as marks on the time axes.",
    ));
    Ok(document("Dashpot: processor in the loop", &parts))
}

/// What the marks on the time axes are, where there are any.
fn marked(found: &Found) -> String {
    let made = found.injected_faults.unwrap_or_default() != Default::default();
    let told: Vec<&str> = [
        (made, "amber a fault made"),
        (
            found.report.recoveries > 0,
            "red a recovery, when the target was given its dampers and states again",
        ),
    ]
    .into_iter()
    .filter_map(|(there, told)| there.then_some(told))
    .collect();
    if told.is_empty() {
        return String::new();
    }
    format!("<p>Marks on the time axes: {}.</p>", told.join(", "))
}

fn headline(found: &Found) -> String {
    let report = &found.report;
    let differing = report.mismatches + report.state_mismatches as u64;
    let last = match &report.pacing {
        Some(pacing) => (
            format!("{:.2} %", 1e2 * pacing.missed_share),
            "of the ticks missed their deadline: answered after the next was due".into(),
        ),
        None => (
            report.recoveries.to_string(),
            "recoveries: the target was given its dampers and states again".into(),
        ),
    };
    tiles(&[
        (
            differing.to_string(),
            "forces, status words and states that differ from the host's, in bits".into(),
        ),
        (
            optional_span(report.round_trip.p50_ns),
            format!(
                "round trip at the median, {} at most",
                span(report.round_trip.worst_ns)
            ),
        ),
        (
            format!("{:.0}", report.clock_ticks.max),
            "clock ticks of the target at most for one tick of the whole bank".into(),
        ),
        last,
    ])
}

fn summary(found: &Found) -> String {
    let rows: Vec<String> = found
        .lines()
        .iter()
        .map(|(what, told)| {
            format!(
                "<tr><td>{}</td><td class=\"told\">{}</td></tr>",
                escaped(what),
                escaped(told)
            )
        })
        .collect();
    format!(
        "<div class=\"wide\"><table>\n{}\n</table></div>",
        rows.join("\n")
    )
}
