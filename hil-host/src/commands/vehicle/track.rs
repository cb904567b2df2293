//! Figure of the track under the vehicle, which shows where the curves are.

use maud::{Markup, html};

use super::figures::TIME;
use super::history::History;
use dashpot_rail::track::{Alignment, Layout};
use dashpot_report::DrawError;
use dashpot_report::page::{Figure, figure, panel};
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::style::RESULT;

const HEIGHT: u32 = 200;

/// Section of the page; empty for a track without curve and cant.
///
/// # Errors
/// The figure cannot be drawn.
pub(super) fn section(history: &History, layout: &Layout) -> Result<Markup, DrawError> {
    let places = history.over_time("distance_m", 1.0);
    let over_time = |y: &str, value: &dyn Fn(&Alignment) -> f64| {
        let points = places.iter();
        let points = points.map(|(time_s, distance_m)| (*time_s, value(&layout.at(*distance_m))));
        panel("time, s", y, vec![Curve::new("", RESULT, points).filled()])
    };
    let panels = vec![
        over_time("curvature, 1/km", &|at| 1e3 * at.curvature_per_m),
        over_time("cant, mm", &|at| 1e3 * at.cant_m),
    ];
    let mut curves = panels.iter().flat_map(|panel| &panel.curves);
    if curves.all(|curve| curve.ordinates().all(|value| value == 0.0)) {
        return Ok(html! {});
    }
    let track = Figure {
        panels,
        height: HEIGHT,
        cursor_group: Some(TIME),
    };
    Ok(html! {
        h2 { "Track under the vehicle" }
        (figure(&track, &html! {
            "Curvature of the nominal track, positive to the right, and cant, positive if the left rail is higher, at "
            "the middle of the vehicle."
        })?)
    })
}
