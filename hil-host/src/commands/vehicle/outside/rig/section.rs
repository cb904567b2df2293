//! Curves of a rig on the page.

use dashpot_report::DrawError;
use dashpot_report::page::{Figure, figure, panel};
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::envelope::thinned;
use dashpot_report::plot::style::{BEFORE, COMPARED, DIFFERENCE, RESULT};
use dashpot_study::verification::IndexEffect;
use maud::{Markup, html};

use super::samples::{Sample, Samples};
use crate::commands::vehicle::figures::{HEIGHT, TIME};

/// Section of the page for one rig.
///
/// # Errors
/// A figure cannot be drawn.
pub(in crate::commands::vehicle) fn section(
    samples: &Samples,
    step_s: f64,
) -> Result<Markup, DrawError> {
    let over_time = |name: &str, colour, value: &dyn Fn(&Sample) -> f32| {
        // A missing reading is drawn as the last one.
        let mut last = 0.0;
        let mut values = samples.rows.iter().map(|row| {
            let value = value(row);
            last = if value.is_nan() { last } else { value };
            f64::from(last)
        });
        Curve::new(name, colour, thinned(&mut values, step_s))
    };
    let displacements = vec![
        over_time("desired", COMPARED, &|row| 1e3 * row.desired_m).wide(16),
        over_time("command", BEFORE, &|row| 1e3 * row.command_m).wide(4),
        over_time("measured", RESULT, &|row| 1e3 * row.measured_m).wide(5),
    ];
    let errors = vec![
        over_time("", DIFFERENCE, &|row| {
            1e3 * (row.measured_m - row.desired_m)
        })
        .wide(5),
    ];
    let delays = vec![over_time("", RESULT, &|row| 1e3 * row.delay_s).wide(5)];
    let energies = vec![over_time("", RESULT, &|row| row.added_j).wide(5)];
    let of_panels = |panels| Figure {
        panels,
        height: HEIGHT,
        cursor_group: Some(TIME),
    };
    Ok(html! {
        h3 { "Rig of the " (samples.damper) }
        (figure(&of_panels(vec![
            panel("time, s", "displacement, mm", displacements),
            panel("time, s", "measured minus desired, mm", errors),
        ]), &html! {
            "Desired: the displacement that the rig should have reached. The command leads it, because the actuator "
            "follows late."
        })?)
        (figure(&of_panels(vec![
            panel("time, s", "delay, ms", delays),
            panel("time, s", "energy added, J", energies),
        ]), &html! {
            "Delay: of the measured displacement, over the past second. Energy: what the actuator adds to the vehicle; "
            "it grows long before the motion does."
        })?)
    })
}

/// Table of every index with external dampers and with all dampers inside, largest change first.
pub(in crate::commands::vehicle) fn indices(all: &[IndexEffect]) -> Markup {
    let mut sorted: Vec<&IndexEffect> = all.iter().collect();
    sorted.sort_by(|a, b| b.relative.total_cmp(&a.relative));
    html! {
        details {
            summary { "Every index with external dampers and with all dampers inside" }
            div.wide { table {
                tr { th { "index" } th { "inside" } th { "external" } th { "change, %" } }
                @for effect in sorted {
                    tr {
                        td.text { (effect.index) }
                        td { (format!("{:.4e}", effect.inside)) }
                        td { (format!("{:.4e}", effect.outside)) }
                        td { (format!("{:.2}", 1e2 * effect.relative)) }
                    }
                }
            } }
        }
    }
}
