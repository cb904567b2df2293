//! Figure of dampers: force over time, displacement and velocity.

use maud::{Markup, html};

use super::{Drawn, HEIGHT};
use crate::commands::failure::Outcome;
use dashpot_files::study::Sweep;
use dashpot_report::page::{Figure, figure, panel};
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::envelope::thinned;
use dashpot_report::plot::sheet::Panel;
use dashpot_report::plot::style::{FIRST, SECOND};

/// Draws the first case of a sweep with its first seed.
///
/// # Errors
/// A curve is missing, or the figure cannot be drawn.
pub(super) fn part(
    drawn: &Drawn<'_>,
    sweep: &Sweep,
    dampers: &[String],
    caption: &str,
) -> Outcome<Markup> {
    let mut panels = [
        ("time, s", false),
        ("displacement, mm", true),
        ("velocity, m/s", true),
    ]
    .map(|(x, sides)| Panel {
        sides,
        ..panel(x, "force, kN", Vec::new())
    });
    let colours = [FIRST, SECOND];
    for (number, name) in dampers.iter().enumerate() {
        let [x, force] = drawn.study.damper_keys(sweep, name);
        let (x, force) = (drawn.curve(&x)?, drawn.curve(&force)?);
        let (step_s, x, force) = (x.step_s, &x.values, &force.values);
        let colour = colours[number % colours.len()];
        let name = if dampers.len() > 1 { name.as_str() } else { "" };
        let force = || force.iter().map(|force| force * 1e-3);
        let over_displacement = x.iter().map(|x| x * 1e3).zip(force());
        let velocities = x.windows(2).map(|pair| (pair[1] - pair[0]) / step_s);
        let over_velocity = velocities.zip(force().skip(1));
        let curve = |points: Vec<(f64, f64)>| Curve::new(name, colour, points).wide(4);
        panels[0].curves.push(curve(thinned(force(), step_s)));
        panels[1].curves.push(curve(over_displacement.collect()));
        panels[2].curves.push(curve(over_velocity.collect()));
    }
    let drawn = Figure {
        panels: panels.into(),
        height: HEIGHT,
        cursor_group: None,
    };
    Ok(figure(&drawn, &html! { (caption) })?)
}
