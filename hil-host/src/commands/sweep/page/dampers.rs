//! Figure of dampers: force over time, displacement and velocity.

use maud::{Markup, html};

use super::{Drawn, HEIGHT, failed};
use crate::commands::failure::Outcome;
use dashpot_files::study::Sweep;
use dashpot_report::page::{Figure, figure, panel};
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::envelope::thinned;
use dashpot_report::plot::sheet::Panel;
use dashpot_report::plot::style::{BLUE_LINE, RED_LINE};
use dashpot_study::sweep::record;
use dashpot_vehicle_run::signals::slug;

/// Returns the names of the displacement and force signals of each damper.
pub(super) fn signals(dampers: &[String]) -> Vec<String> {
    let signals_of = |name: &String| {
        let name = slug(name);
        [format!("{name}_displacement_m"), format!("{name}_force_n")]
    };
    dampers.iter().flat_map(signals_of).collect()
}

/// Draws the first case of a sweep with its first seed.
///
/// # Errors
/// The case cannot be run, or the figure cannot be drawn.
pub(super) fn part(
    drawn: &Drawn<'_>,
    sweep: &Sweep,
    dampers: &[String],
    caption: &str,
) -> Outcome<Markup> {
    let case = drawn
        .study
        .case_with(sweep, None, sweep.seeds.first().copied())?;
    let history = record(&case, &signals(dampers), &drawn.shared).map_err(failed(sweep))?;
    let mut panels = [
        ("time, s", false),
        ("displacement, mm", true),
        ("velocity, m/s", true),
    ]
    .map(|(x, sides)| Panel {
        sides,
        ..panel(x, "force, kN", Vec::new())
    });
    let colours = [BLUE_LINE, RED_LINE];
    let pairs = history.signals.chunks_exact(2).zip(dampers);
    for (number, (pair, name)) in pairs.enumerate() {
        let [x, force] = pair else { continue };
        let colour = colours[number % colours.len()];
        let name = if dampers.len() > 1 { name.as_str() } else { "" };
        let force = || force.iter().map(|force| force * 1e-3);
        let over_displacement = x.iter().map(|x| x * 1e3).zip(force());
        let velocities = x
            .windows(2)
            .map(|pair| (pair[1] - pair[0]) / history.step_s);
        let over_velocity = velocities.zip(force().skip(1));
        let curve = |points: Vec<(f64, f64)>| Curve::new(name, colour, points).wide(4);
        panels[0]
            .curves
            .push(curve(thinned(force(), history.step_s)));
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
