//! Tables of the page of a run: indices, and forces against their limits.

use maud::{Markup, html};

use super::report::{Limits, Report, counted_windows, nadal_limits, percent};
use dashpot_report::page::share_cell;
use dashpot_vehicle_run::{Indices, RideIndices};

/// Returns the tables.
pub(super) fn tables(report: &Report) -> Markup {
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
                    (share_cell(worse.load_over_limit, &percent(worse.load_over_limit)))
                    (share_cell(Some(worse.over_nadal), &percent(Some(worse.over_nadal))))
                    td { (format!("{:.2}", worse.longest_over_nadal_m)) }
                    (share_cell(wheelset.lateral_force_over_limit, &percent(wheelset.lateral_force_over_limit)))
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
