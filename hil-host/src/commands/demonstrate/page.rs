//! The page: one self-contained HTML file with inline SVG.

use std::fmt::Write as _;

use super::results::{Accuracy, Bench, Demonstration, LOOP_FREQUENCY_HZ};
use super::{description, figures};
use crate::commands::failure::Outcome;
use crate::report::page::{built, document, figure, footer, tiles};
use crate::study::Scalar;
use crate::study::bench_test::Harmonic;
use crate::study::published::nominal_indices;

/// The demonstration as HTML.
///
/// # Errors
/// A figure cannot be drawn.
pub fn write(shown: &Demonstration) -> Outcome<String> {
    let mut parts = Vec::new();
    let mut add = |part: &str| parts.push(part.to_owned());
    add("<h1>A rail damper in real time</h1>");
    add(&lead(shown));
    add(&headline(shown));
    add("<h2>What the damper is</h2>");
    add(&description::damper(&shown.benches));
    add(&figure(
        &figures::characteristics(&shown.benches),
        &format!(
            "Computed force over constant velocity, extension to the right.{}",
            description::relief(&shown.benches)
        ),
    )?);
    add("<h2>Fixed step against reference</h2>");
    add(
        "<p>Fixed step: two implicit stages from tables, a fixed number of operations, + − × ÷ \
         only. Reference: the same laws written independently, with pressure and piston as \
         states, clearance and valve openings as events, integrated adaptively to 1e-12 a step. Both \
         follow the made motion, linear between ticks.</p>",
    );
    add(&accuracy_table(&shown.accuracy));
    for ride in &shown.rides {
        add(&format!("<h3>{} on the made ride</h3>", ride.damper));
        add(&figure(
            &figures::force(ride),
            &format!(
                "Computed force, {} to {} s of the made ride: fixed step at 1 kHz in single precision over the \
                 reference.",
                figures::WINDOW_S.0,
                figures::WINDOW_S.1
            ),
        )?);
        add(&figure(
            &figures::error(ride),
            "Error of that fixed step over the whole made ride: fixed step less reference, in newtons.",
        )?);
        add(&figure(
            &figures::ride_loops(ride),
            "Computed force over displacement (first) and velocity (second) along the whole made ride, 1 kHz, \
             single precision.",
        )?);
    }
    add("<h2>On the bench</h2>");
    for bench in &shown.benches {
        add(&format!("<h3>{}</h3>", bench.damper));
        add(&figure(
            &figures::bench_loops(bench),
            &format!(
                "Settled loops of a made harmonic motion at {LOOP_FREQUENCY_HZ} Hz, by amplitude: computed force \
                 over displacement (first) and velocity (second, with the legend of both)."
            ),
        )?);
    }
    add(&bench_table(&shown.benches)?);
    add(&format!(
        "<div class=\"note\">\n<p><b>Two errata of the source paper.</b> {} And its equations with those \
         tables do not give its Table 5: they are progressive in velocity, the published energy per cycle \
         asks for a digressive curve. The <b>paper</b> preset is literal all the same and is not tuned; hence \
         the difference in the table above. Both are told with their numbers in docs/validation.md.</p>\n</div>",
        description::erratum(&shown.benches)?
    ));
    add(&footer(
        "Ride: data/excitations/ride_made.csv, made. Other motions and dampers: <code>dashpot --help</code>.",
    ));
    Ok(document("Dashpot: a rail damper in real time", &parts))
}

fn lead(shown: &Demonstration) -> String {
    format!(
        "<p class=\"lead\">Dashpot computes a locomotive damper’s force from its displacement at 1 to \
         10 kHz, in constant time, for hardware-in-the-loop rigs. Here it runs on a ride of {:.1} s \
         that is made, not measured, and sampled as a logger would: {} samples at uneven times, with a gap.</p>",
        shown.duration_s, shown.samples
    )
}

/// The headline: accuracy and cost on the target's precision.
fn headline(shown: &Demonstration) -> String {
    let worst = |step_s: f64, scalar: Scalar| {
        shown
            .accuracy
            .iter()
            .filter(|row| row.step_s == step_s && row.scalar == scalar)
            .fold((0.0_f64, 0.0_f64), |(nrmse, cost), row| {
                (nrmse.max(row.nrmse), cost.max(row.median_ns_per_step))
            })
    };
    let (slow, fast) = (worst(1e-3, Scalar::F32), worst(1e-4, Scalar::F32));
    let fast_double = worst(1e-4, Scalar::F64);
    tiles(&[
        (
            power_of_ten(slow.0),
            "rms error over rms force at 1 kHz, single precision, the worse of both dampers".into(),
        ),
        (
            power_of_ten(fast.0),
            "the same at 10 kHz, single precision".into(),
        ),
        (
            power_of_ten(fast_double.0),
            "the same at 10 kHz, double precision".into(),
        ),
        (
            format!("{:.0} ns", slow.1.max(fast.1)),
            format!(
                "a step, measured on this machine: single precision, median{}",
                built()
            ),
        ),
    ])
}

/// `1.2 × 10⁻⁴` in HTML.
fn power_of_ten(value: f64) -> String {
    let text = format!("{value:.1e}");
    match text.split_once('e') {
        Some((digits, power)) => {
            format!("{digits} × 10<sup>{}</sup>", power.replace('-', "−"))
        }
        None => text,
    }
}

fn accuracy_table(rows: &[Accuracy]) -> String {
    let mut table = String::from(
        "<div class=\"wide\"><table>\n<tr><th>damper</th><th>rate, kHz</th><th>precision</th>\
         <th>rms error<br>over rms force</th><th>limit</th><th>largest error<br>over peak force</th>\
         <th>median cost,<br>ns a step</th></tr>\n",
    );
    for row in rows {
        // Writing to a string cannot fail.
        let _ = writeln!(
            table,
            "<tr{}><td>{}</td><td>{:.0}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.0}</td></tr>",
            if row.over_limit() {
                " class=\"over\""
            } else {
                ""
            },
            row.damper,
            1e-3 / row.step_s,
            row.scalar,
            power_of_ten(row.nrmse),
            power_of_ten(row.nrmse_limit),
            power_of_ten(row.largest_error_over_peak),
            row.median_ns_per_step
        );
    }
    table.push_str("</table></div>");
    if rows.iter().any(Accuracy::over_limit) {
        table.push_str("\n<p>Rows on amber are above the project's limit.</p>");
    }
    table
}

/// Table 5 beside both dampers.
fn bench_table(benches: &[Bench]) -> Outcome<String> {
    let motion = Harmonic::TABLE_5;
    let mut table = format!(
        "<h3>Table 5 of the paper: ±{:.3} mm at {} Hz</h3>\n<div class=\"wide worded\"><table>\n<tr><th>index</th><th>unit</th>",
        motion.amplitude_m * 1e3,
        motion.frequency_hz
    );
    for bench in benches {
        let _ = write!(table, "<th>{},<br>computed</th>", bench.damper);
    }
    table.push_str("<th>paper,<br>simulation</th><th>paper,<br>test, measured</th></tr>\n");
    for row in &nominal_indices()? {
        let _ = write!(table, "<tr><td>{}</td><td>{}</td>", row.index, row.unit);
        for bench in benches {
            let _ = write!(table, "<td>{}</td>", row.of(&bench.table_5)?);
        }
        let _ = writeln!(
            table,
            "<td>{}</td><td>{}</td></tr>",
            row.simulation, row.test
        );
    }
    table.push_str("</table></div>");
    Ok(table)
}
