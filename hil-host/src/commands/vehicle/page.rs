//! HTML page of a run.

use maud::{Markup, html};

use super::outside::{Traces, rig};
use super::report::{Limits, Report, counted_windows, nadal_limits, of_damping, percent, verdict};
use super::{drawing, figures, spectra, wear};
use crate::commands::vehicle::history::History;
use dashpot_files::case::Case;
use dashpot_realtime::timing::span;
use dashpot_report::DrawError;
use dashpot_report::page::{document, figure, footer, tiles};
use dashpot_vehicle_run::spectra::Spectrum;
use dashpot_vehicle_run::{Ending, Indices, RideIndices, Run};

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
            @for sentence in verdict(indices) { p { (sentence) } }
        }
        @if let Some(found) = &report.damping { p { (of_damping(found)) "." } }
        (headline(report))
        figure {
            div.wide { (drawing::vehicle(&case.vehicle)) }
            figcaption { "The leading wheelset has number 1." }
        }
        @if let Some(body) = bodies.first() {
            h2 { "Accelerations of the " (body) }
            (figure(&figures::accelerations(history, body), &html! {
                "At the centre of gravity, in the track frame, as an accelerometer there would measure them; positive "
                "to the right and down."
            })?)
        }
        h2 { "Wheelsets" }
        (figure(&figures::wheelsets(history, wheelsets), &html! {
            "Relative to the nominal track; positive to the right and for yaw to the right."
        })?)
        h2 { "Wheel loads" }
        (figure(&figures::loads(history, wheelsets), &html! { "Vertical force Q of each wheel on the rail." })?)
        (figure(&figures::filtered_loads(history, wheelsets), &html! {
            "The same, filtered at 20 Hz as acceptance tests do."
        })?)
        h2 { "Lateral forces" }
        (figure(&figures::lateral_forces(history, wheelsets), &html! {
            "Force of the rails on each wheelset, positive to the right, filtered at 20 Hz and averaged over 2 m."
        })?)
        (figure(&figures::contact_positions(history, wheelsets), &html! {
            "Position of the patch with the greatest load on each wheel, from the tread datum, field side positive."
        })?)
        h2 { "Derailment coefficient" }
        (figure(&figures::derailment(history, wheelsets), &html! {
            "Lateral force divided by vertical force, positive if the rail pushes the wheel towards the track centre."
        })?)
        (figure(&figures::filtered_derailment(history, wheelsets), &html! {
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
            "history.csv has every tick. Drag to zoom, double-click to reset."
        }))
    };
    Ok(document(&format!("Dashpot: {}", case.name), &body))
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

fn tables(report: &Report) -> Markup {
    html! {
        @match &report.indices {
            Some(indices) => {
                div.wide { table {
                    tr { th { "m/s²" } th { "lateral rms" } th { "max" } th { "vertical rms" } th { "max" } }
                    @for body in &indices.bodies {
                        tr {
                            td.text { (body.body) }
                            td { (format!("{:.3}", body.lateral_rms_m_per_s2)) }
                            td { (format!("{:.2}", body.lateral_greatest_m_per_s2)) }
                            td { (format!("{:.3}", body.vertical_rms_m_per_s2)) }
                            td { (format!("{:.2}", body.vertical_greatest_m_per_s2)) }
                        }
                    }
                    tr {
                        td.text { "unbalanced, from the layout" }
                        td { (format!("{:.3}", indices.unbalanced.rms_m_per_s2)) }
                        td { (format!("{:.2}", indices.unbalanced.greatest_m_per_s2)) }
                        td {} td {}
                    }
                } }
                @if indices.ride.iter().any(|ride| ride.windows > 0) {
                    div.wide { table {
                        tr {
                            th { "Ride" } th { "height, m" } th { "Sperling lateral" } th { "Sperling vertical" }
                            th { "N_MV" }
                        }
                        @for ride in &indices.ride {
                            tr {
                                td.text { (ride.point) }
                                td { (format!("{:.2}", ride.at_m[2])) }
                                @for index in [ride.sperling_lateral, ride.sperling_vertical, ride.mean_comfort] {
                                    td { (index.map_or_else(|| "-".into(), |index| format!("{index:.3}"))) }
                                }
                            }
                        }
                    } }
                    @if let Some(ride) = indices.ride.first() {
                        p { (ride_note(ride)) }
                    }
                }
                div.wide { table {
                    tr {
                        th { "wheelset" } th { "Q left, kN" } th { "Q right, kN" } th { "Y/Q left" } th { "Y/Q right" }
                        th { "lateral force, kN" } th { "wear number, N" }
                    }
                    @for wheelset in &indices.wheelsets {
                        tr {
                            td.text { (wheelset.wheelset) }
                            @for wheel in &wheelset.wheels {
                                td {
                                    (format!("{:.0} to {:.0}", 1e-3 * wheel.load_least_n, 1e-3 * wheel.load_greatest_n))
                                }
                            }
                            @for wheel in &wheelset.wheels {
                                td { (format!("{:.2}", wheel.derailment_greatest)) }
                            }
                            td { (format!("{:.1}", 1e-3 * wheelset.lateral_force_greatest_n)) }
                            td { (format!("{:.0}", wheelset.wear_number_n)) }
                        }
                    }
                } }
                p {
                    "Q: range within all steps. Y/Q and lateral force: filtered at 20 Hz, maximum of the mean over "
                    "2 m. Wear number: mean creep power over the speed."
                }
                (limits(indices))
            }
            None => { p { "A run that did not complete has no indices." } }
        }
    }
}

/// Caption explaining which windows the ride indices cover.
fn ride_note(ride: &RideIndices) -> String {
    let ([from, to], [low, high]) = (ride.sperling_band_hz, ride.comfort_band_hz);
    format!(
        "From {}. Sperling's index: {from} to {to} Hz, mean of the windows. N_MV, mean comfort of EN 12299: {low} to \
         {high} Hz, 95th percentile of the windows, without longitudinal acceleration; the standard uses five minutes.",
        counted_windows(ride)
    )
}

/// Forces of wheels and wheelsets against their limits.
fn limits(indices: &Indices) -> Markup {
    html! {
        div.wide { table {
            tr {
                th { "worse wheel" } th { "unloading, %" } th { "mean, %" } th { "lifted, %" } th { "Q limit, %" }
                th { "Nadal, %" }
                th { "beyond, m" } th { "Prud'homme, %" } th { "wear rms, N" } th { "max" }
            }
            @for wheelset in &indices.wheelsets {
                @let worse = Limits::of(wheelset);
                tr {
                    td.text { (wheelset.wheelset) }
                    td { (percent(worse.unloading)) }
                    td { (percent(worse.unloading_of_mean)) }
                    td { (format!("{:.1}", 1e2 * worse.lifted_share)) }
                    td { (percent(worse.load_over_limit)) }
                    td { (format!("{:.0}", 1e2 * worse.over_nadal)) }
                    td { (format!("{:.2}", worse.longest_over_nadal_m)) }
                    td { (percent(wheelset.lateral_force_over_limit)) }
                    td { (format!("{:.0}", wheelset.wear_number_rms_n)) }
                    td { (format!("{:.0}", wheelset.wear_number_greatest_n)) }
                }
            }
        } }
        p {
            "Unloading relative to the static load: instantaneous, and of the mean over 2 m. Q, filtered at 20 Hz, as "
            "% of the limit of EN 14363 for the speed. Y/Q, filtered at 20 Hz, as % of Nadal's "
            "limit, mean over 2 m, and the longest distance beyond it. Lateral force as % of Prud'homme's limit, mean "
            "over 2 m. Nadal's limit is " (nadal_limits(indices))
            ". Prud'homme's limit is 10 kN plus a third of the static axle load."
        }
    }
}
