//! The demo page, a self-contained HTML file.

use maud::{Markup, html};

use super::results::{Accuracy, Bench, Demonstration, LOOP_FREQUENCY_HZ, Ride, STEPS_S};
use super::{description, figures, live};
use crate::commands::failure::Outcome;
use dashpot_files::Scalar;
use dashpot_files::harmonic::Harmonic;
use dashpot_report::DrawError;
use dashpot_report::page::{built, figure, footer, parts, tiles};
use dashpot_testbench::TestbenchError;
use dashpot_testbench::published::nominal_indices;

/// Returns the demo as HTML.
///
/// # Errors
/// A figure cannot be drawn.
pub(super) fn write(shown: &Demonstration) -> Outcome<String> {
    let characteristics = html! {
        "Computed force at constant velocity; extension is to the right."
        (description::relief(&shown.benches))
    };
    let body = html! {
        h2 { "A rail damper in real time" }
        (lead(shown))
        (headline(shown))
        h2 { "The damper" }
        (description::damper(&shown.benches))
        (figure(&figures::characteristics(&shown.benches), &characteristics)?)
        h2 { "Fixed step compared with reference" }
        p {
            "The fixed step reads two implicit stages from tables, with a fixed number of operations and only + − × ÷. \
             The reference is an independent implementation of the same laws. Its states are pressure and piston \
             position, its events are the edges of the clearance and the valve openings, and it integrates \
             adaptively with a tolerance of 1e-12 per step. \
             Both follow the synthetic motion, interpolated linearly between ticks."
        }
        (accuracy_table(&shown.accuracy))
        @for ride in &shown.rides { (ride_figures(ride)?) }
        h2 { "On the bench" }
        @for bench in &shown.benches { (bench_figure(bench)?) }
        (bench_table(&shown.benches)?)
        div.note {
            p {
                b { "Two errata of the source paper." }
                " " (description::erratum(&shown.benches)?)
                " Second, the paper's equations with those tables do not reproduce its Table 5. The equations are \
                 progressive in velocity, but the published energy per cycle requires a digressive curve. The "
                b { "paper" }
                " preset nevertheless follows the paper exactly and is not tuned, hence the difference in the table \
                 above. docs/validation.md gives the details of both errata."
            }
        }
        (footer(&html! {
            "Ride: data/excitations/ride_made.csv, synthetic. For other motions and dampers, see "
            code { "dashpot --help" } "."
        }))
    };
    live::above("Dashpot: a rail damper in real time", parts(&body))
}

fn lead(shown: &Demonstration) -> Markup {
    html! {
        p.lead {
            "Dashpot computes a locomotive damper’s force from its displacement at 1 to 10 kHz, in constant time, \
             for hardware-in-the-loop rigs. Here it runs on a synthetic ride of " (format!("{:.1}", shown.duration_s))
            " s, sampled as by a logger: " (shown.samples) " samples at uneven times, with a gap."
        }
    }
}

/// Draws the headline with accuracy and cost.
fn headline(shown: &Demonstration) -> Markup {
    let worst = |step_s: f64, scalar: Scalar| {
        shown
            .accuracy
            .iter()
            .filter(|row| row.step_s == step_s && row.scalar == scalar)
            .fold((0.0_f64, 0.0_f64), |(nrmse, cost), row| {
                (nrmse.max(row.nrmse), cost.max(row.median_ns_per_step))
            })
    };
    let [slow_s, fast_s] = STEPS_S;
    let (slow, fast) = (worst(slow_s, Scalar::F32), worst(fast_s, Scalar::F32));
    let fast_double = worst(fast_s, Scalar::F64);
    tiles(&[
        (
            power_of_ten(slow.0),
            format!(
                "rms error over rms force at {} kHz, single precision, worse of the two dampers",
                rate_khz(slow_s)
            ),
        ),
        (
            power_of_ten(fast.0),
            format!("the same at {} kHz, single precision", rate_khz(fast_s)),
        ),
        (
            power_of_ten(fast_double.0),
            format!("the same at {} kHz, double precision", rate_khz(fast_s)),
        ),
        (
            html! { (format!("{:.0} ns", slow.1.max(fast.1))) },
            format!(
                "per step, measured on this machine: single precision, median{}",
                built()
            ),
        ),
    ])
}

/// Formats the rate of a step in kHz.
fn rate_khz(step_s: f64) -> String {
    format!("{:.0}", 1e-3 / step_s)
}

/// Formats a number as `1.2 × 10⁻⁴` in HTML.
fn power_of_ten(value: f64) -> Markup {
    let text = format!("{value:.1e}");
    match text.split_once('e') {
        Some((digits, power)) => {
            html! { (digits) " × 10" sup { (power.replace('-', "−")) } }
        }
        None => html! { (text) },
    }
}

fn accuracy_table(rows: &[Accuracy]) -> Markup {
    html! {
        div.wide {
            table {
                tr {
                    th { "damper" }
                    th { "rate, kHz" }
                    th { "precision" }
                    th { "rms error" br; "over rms force" }
                    th { "limit" }
                    th { "max error" br; "over peak force" }
                    th { "median cost," br; "ns per step" }
                }
                @for row in rows {
                    tr class=[row.over_limit().then_some("over")] {
                        td { (row.damper) }
                        td { (rate_khz(row.step_s)) }
                        td { (row.scalar) }
                        @if row.over_limit() {
                            td.above { (power_of_ten(row.nrmse)) " ✗" }
                        } @else {
                            td { (power_of_ten(row.nrmse)) }
                        }
                        td { @if let Some(limit) = row.nrmse_limit { (power_of_ten(limit)) } }
                        td { (power_of_ten(row.largest_error_over_peak)) }
                        td { (format!("{:.0}", row.median_ns_per_step)) }
                    }
                }
            }
        }
        @if rows.iter().any(Accuracy::over_limit) {
            p { "Rows with ✗ exceed the project's limit." }
        }
    }
}

/// Draws forces, error and loops of a damper on the ride.
fn ride_figures(ride: &Ride) -> Result<Markup, DrawError> {
    let (from_s, to_s) = figures::WINDOW_S;
    let force = html! {
        "Computed force from " (from_s) " to " (to_s) " s of the synthetic ride: fixed step at "
        (rate_khz(ride.step_s)) " kHz in single precision, drawn over the reference."
    };
    let error = html! {
        "Error of the same fixed step over the whole synthetic ride: fixed step minus reference, in newtons."
    };
    let loops = html! {
        "Computed force against displacement (first) and velocity (second) along the whole synthetic ride, "
        (rate_khz(ride.step_s)) " kHz, single precision."
    };
    Ok(html! {
        h3 { (ride.damper) " on the synthetic ride" }
        (figure(&figures::force(ride), &force)?)
        (figure(&figures::error(ride), &error)?)
        (figure(&figures::ride_loops(ride), &loops)?)
    })
}

/// Draws the settled loops of a damper.
fn bench_figure(bench: &Bench) -> Result<Markup, DrawError> {
    let caption = html! {
        "Settled loops of a synthetic harmonic motion at " (LOOP_FREQUENCY_HZ) " Hz for several amplitudes: computed \
         force against \
         displacement (first) and velocity (second)."
    };
    Ok(html! {
        h3 { (bench.damper) }
        (figure(&figures::bench_loops(bench), &caption)?)
    })
}

/// Compares both dampers with Table 5.
fn bench_table(benches: &[Bench]) -> Result<Markup, TestbenchError> {
    let motion = Harmonic::TABLE_5;
    Ok(html! {
        h3 {
            "Table 5 of the paper: ±" (format!("{:.3}", motion.amplitude_m * 1e3)) " mm at "
            (motion.frequency_hz) " Hz"
        }
        div.wide.worded {
            table {
                tr {
                    th { "index" }
                    th { "unit" }
                    @for bench in benches { th { (bench.damper) "," br; "computed" } }
                    th { "paper," br; "simulation" }
                    th { "paper," br; "test, measured" }
                }
                @for row in &nominal_indices()? {
                    tr {
                        td { (row.index) }
                        td { (row.unit) }
                        @for bench in benches { td { (row.format_value(&bench.table_5)?) } }
                        td { (row.simulation) }
                        td { (row.test) }
                    }
                }
            }
        }
    })
}
