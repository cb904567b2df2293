//! HTML page of a run.

use maud::{Markup, html};

use super::outside::{Traces, rig};
use super::report::{Report, of_damping, verdict};
use super::tables::tables;
use super::wheelsets::Wheelsets;
use super::{drawing, figures, spectra, track, wear};
use crate::commands::vehicle::history::History;
use dashpot_files::case::Case;
use dashpot_realtime::timing::span;
use dashpot_report::DrawError;
use dashpot_report::page::{self, document, figure, footer, judged, tiles};
use dashpot_vehicle_run::spectra::Spectrum;
use dashpot_vehicle_run::{Ending, Indices, Run};

/// Number of dampers whose loops share a figure.
const LOOPS: usize = 4;

/// Returns the run as HTML.
///
/// # Errors
/// A figure cannot be drawn.
pub(super) fn write(
    case: &Case,
    run: &Run,
    report: &Report,
    history: &History,
    densities: &[Spectrum],
    traces: &Traces,
) -> Result<String, DrawError> {
    let vehicle = run.vehicle();
    let names = vehicle.names();
    let (bodies, wheelsets) = names.split_at(names.len() - vehicle.wheelsets());
    let wheelsets = Wheelsets {
        history,
        names: wheelsets,
        indices: report.indices.as_ref(),
    };
    let dampers: Vec<&str> = vehicle.damper_names().collect();
    let frictions: Vec<&str> = vehicle.friction_names().collect();
    let body = html! {
        h1 { (case.name) }
        p.lead {
            (report.vehicle) " on " (report.track) " at " (format!("{:.0}", report.speed_km_h))
            " km/h; normal damping " (report.normal_damping_s_per_m) " s/m, step "
            (format!("{:.0}", 1e6 * report.step_s)) " µs."
        }
        div.wide { table {
            @for (what, text) in report.contact.lines() { tr { td.text { (what) } td.text { (text) } } }
            tr { td.text { "support of the rails" } td.text { (report.support) } }
            @for change in &report.changes {
                tr { td.text { "change" } td.text { (change) } }
            }
        } }
        @if report.ending != Ending::Completed {
            p { strong { "The run did not complete: " (report.ending) "." } }
        }
        @if !report.warnings.is_empty() {
            div.note {
                p { strong { "Results outside the validity of the model:" } }
                @for found in &report.warnings { p { (found.message) "." } }
            }
        }
        @if let Some(indices) = &report.indices {
            (verdicts(indices, !report.warnings.is_empty()))
        }
        @if let Some(found) = &report.damping { p { (of_damping(found)) "." } }
        (headline(report))
        figure {
            div.wide { (drawing::vehicle(&case.vehicle)) }
            figcaption { "The leading wheelset has number 1." }
        }
        (track::section(history, run.track().layout())?)
        @if let Some(body) = bodies.first() {
            h2 { "Accelerations of the " (body) }
            (figure(&figures::accelerations(history, body), &html! {
                "At the centre of gravity, in the track frame, as an accelerometer there would measure them; positive "
                "to the right and down."
            })?)
        }
        h2 { "Wheelsets" }
        (figure(&wheelsets.displacements(), &html! {
            "Lateral displacement (mm) and yaw (mrad) relative to the nominal track; positive to the right and for yaw "
            "to the right."
        })?)
        h2 { "Wheel loads" }
        (figure(&wheelsets.loads(), &html! {
            "Vertical force Q of each wheel on the rail. At zero the wheel is lifted."
        })?)
        (figure(&wheelsets.filtered_loads(), &html! {
            "The same, filtered at 20 Hz as acceptance tests do, with the limit of EN 14363 for the speed."
        })?)
        h2 { "Lateral forces" }
        (figure(&wheelsets.lateral_forces(), &html! {
            "Force of the rails on each wheelset, positive to the right, filtered at 20 Hz and averaged over 2 m."
        })?)
        (figure(&wheelsets.contact_positions(), &html! {
            "Position of the patch with the greatest load on each wheel, from the tread datum, field side positive."
        })?)
        h2 { "Derailment coefficient" }
        (figure(&wheelsets.derailment(), &html! {
            "Lateral force divided by vertical force, positive if the rail pushes the wheel towards the track centre."
        })?)
        (figure(&wheelsets.filtered_derailment(), &html! {
            "The same, filtered at 20 Hz and averaged over 2 m."
        })?)
        (spectra::section(densities)?)
        @if !dampers.is_empty() {
            h2 { "Dampers" }
            @for some in dampers.chunks(LOOPS) {
                (figure(&figures::loops(history, some), &html! {
                    "Extension and the force that resists it are positive."
                })?)
                (figure(&figures::characteristics(history, some), &html! {
                    "Force over the mean velocity of each tick."
                })?)
            }
        }
        @if !frictions.is_empty() {
            h2 { "Dry friction" }
            @for some in frictions.chunks(LOOPS) {
                (figure(&figures::friction(history, some), &html! {
                    "Between the two levels of its limit an element sticks, and on them it slides."
                })?)
            }
        }
        @if let Some(found) = &report.wear { (wear::section(found)?) }
        @if let Some(outside) = &report.outside {
            h2 { "External dampers" }
            @for forces in &traces.forces {
                h3 { (forces.damper) }
                (figure(&figures::outside(forces, report.step_s), &html! {
                    "Internal: the same run with all dampers simulated internally."
                })?)
            }
            @for samples in &traces.rigs { (rig::section(samples, report.step_s)?) }
            div.wide { table {
                @for (what, text) in outside.lines() { tr { td { (what) } td.text { (text) } } }
            } }
            @if let Some(effect) = &outside.effect { (rig::indices(&effect.indices)) }
        }
        h2 { "Figures" }
        (tables(report))
        (footer(&html! {
            "Curves over time show the minimum and maximum of each group of ticks, so every peak is visible; "
            "history.csv has every tick."
        }))
    };
    Ok(document(&format!("Dashpot: {}", case.name), &body))
}

/// States whether every limit is kept, with a sign for each.
fn verdicts(indices: &Indices, has_warnings: bool) -> Markup {
    let mut sentences = verdict(indices, has_warnings).into_iter();
    let all_kept = indices.limits.iter().all(|limit| limit.is_kept());
    html! {
        @if let Some(first) = sentences.next() {
            p { (judged(all_kept, &first)) }
            ul.verdicts {
                @for (sentence, limit) in sentences.zip(&indices.limits) {
                    li {
                        (page::verdict(limit.is_kept())) ": " (sentence.trim_start())
                    }
                }
            }
        }
    }
}

fn headline(report: &Report) -> Markup {
    let mut facts = Vec::new();
    if let Some(indices) = &report.indices {
        if let Some(body) = indices.bodies.first() {
            facts.push((
                html! { (format!("{:.2}", body.vertical_rms_m_per_s2)) " m/s²" },
                format!(
                    "vertical acceleration of the {} (rms); lateral {:.2}",
                    body.body, body.lateral_rms_m_per_s2
                ),
            ));
        }
        let wheels = || {
            indices
                .wheelsets
                .iter()
                .flat_map(|wheelset| wheelset.wheels.iter().map(move |wheel| (wheelset, wheel)))
        };
        if let Some((wheelset, wheel)) = wheels()
            .max_by(|(_, a), (_, b)| a.derailment_greatest.total_cmp(&b.derailment_greatest))
        {
            facts.push((
                html! { (format!("{:.2}", wheel.derailment_greatest)) },
                format!(
                    "maximum Y/Q, mean over 2 m: {}, {}",
                    wheelset.wheelset, wheel.side
                ),
            ));
        }
        if let Some((wheelset, wheel)) =
            wheels().min_by(|(_, a), (_, b)| a.load_least_n.total_cmp(&b.load_least_n))
        {
            facts.push((
                html! { (format!("{:.0}", 1e-3 * wheel.load_least_n)) " kN" },
                format!("minimum wheel load: {}, {}", wheelset.wheelset, wheel.side),
            ));
        }
    }
    facts.push((
        html! { (span(1e9 * report.mean_tick_s)) },
        format!(
            "for a tick of {:.0} µs on this machine",
            1e6 * report.step_s
        ),
    ));
    tiles(&facts)
}
