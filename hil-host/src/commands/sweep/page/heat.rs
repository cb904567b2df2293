//! Heat maps of indices over the two axes of a sweep.

use maud::{Markup, html};

use super::Drawn;
use super::index::{Index, values};
use super::words::{in_unit, of_axis};
use dashpot_files::study::{Axis, Sweep};
use dashpot_report::page::{HeatAxis, HeatMap};
use dashpot_study::sweep::Estimate;

/// Returns a map of each index; empty for a sweep with another number of axes than two.
pub(super) fn maps(drawn: &Drawn<'_>, sweep: &Sweep, observed: &[Index], changes: bool) -> Markup {
    let [rows, columns] = &sweep.axes[..] else {
        return html! {};
    };
    let labels = [rows, columns].map(of_axis);
    let axis = |axis: &Axis, label| HeatAxis {
        label,
        values: axis
            .values
            .iter()
            .map(|value| in_unit(axis, value))
            .collect(),
    };
    html! {
        @for index in observed {
            @let what = if changes {
                format!("{}, change from the first row, %", index.name(drawn))
            } else {
                index.name(drawn)
            };
            @let map = HeatMap {
                what: &what,
                rows: axis(rows, &labels[0]),
                columns: axis(columns, &labels[1]),
                value: Box::new(|row, column| {
                    let point = row * columns.values.len() + column;
                    let values = values(drawn, sweep, point as u64, index, changes);
                    let present: Vec<f64> = values.into_iter().flatten().collect();
                    Some(Estimate::of(&present)?.mean)
                }),
            };
            (map.html())
        }
    }
}
