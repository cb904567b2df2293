//! Figure of observed indices over the varied parameter.

use maud::{Markup, html};
use plotters::style::RGBColor;

use super::index::{Index, meanings, values};
use super::words::{equation, in_unit, of_axis};
use super::{Drawn, HEIGHT, heat};
use crate::commands::failure::Outcome;
use dashpot_files::study::{Axis, Sweep, Value};
use dashpot_report::page::{Figure, figure, panel};
use dashpot_report::plot::curves::{Curve, ramp};
use dashpot_report::plot::sheet::Panel;
use dashpot_report::plot::style::SEVERAL;
use dashpot_study::sweep::Estimate;

/// Draws a panel for each sweep whose first axis is numeric, and a table for each other sweep.
///
/// # Errors
/// The figure cannot be drawn.
pub(super) fn part(
    drawn: &Drawn<'_>,
    sweeps: &[&Sweep],
    observed: &[Index],
    changes: bool,
    caption: &str,
) -> Outcome<Markup> {
    let is_number = |axis: &Axis| matches!(axis.values.first(), Some(Value::Number(_)));
    let (plotted, listed): (Vec<&Sweep>, Vec<&Sweep>) = sweeps
        .iter()
        .partition(|sweep| sweep.axes.first().is_some_and(is_number));
    let panels: Vec<Panel> = plotted
        .iter()
        .map(|sweep| over_axis(drawn, sweep, observed, changes))
        .collect();
    let drawing = Figure {
        panels,
        height: HEIGHT,
        cursor_group: None,
    };
    let explained = html! { (caption) " " (meanings(drawn, observed)) };
    Ok(html! {
        @if !plotted.is_empty() { (figure(&drawing, &explained)?) }
        @for sweep in plotted { (heat::maps(drawn, sweep, observed, changes)) }
        @for sweep in listed {
            (table(drawn, sweep, observed))
            (heat::maps(drawn, sweep, observed, changes))
            p { (explained) }
        }
    })
}

/// Draws means with confidence intervals: one curve per index and per value of a second axis.
fn over_axis(drawn: &Drawn<'_>, sweep: &Sweep, observed: &[Index], changes: bool) -> Panel {
    let first = &sweep.axes[0];
    let others = sweep.points() / first.values.len() as u64;
    let mut curves = Vec::new();
    let shades = ramp(others as usize);
    for (number, index) in observed.iter().enumerate() {
        for other in 0..others {
            let colour = match others {
                1 => SEVERAL[number % SEVERAL.len()],
                _ => shades[other as usize],
            };
            let estimates = first.values.iter().enumerate().filter_map(|(at, value)| {
                let Value::Number(x) = value else {
                    return None;
                };
                let point = at as u64 * others + other;
                let values = values(drawn, sweep, point, index, changes);
                let present: Vec<f64> = values.into_iter().flatten().collect();
                Some((x * first.factor, Estimate::of(&present)?))
            });
            let estimates: Vec<(f64, Estimate)> = estimates.collect();
            if others == 1 {
                curves.extend(seed_curves(drawn, sweep, index, changes, colour));
            }
            let name = match (others, observed.len()) {
                (1, 1) => String::new(),
                (1, _) => index.name(drawn),
                _ => at_others(sweep, other),
            };
            let means = || estimates.iter().map(|(x, estimate)| (*x, estimate.mean));
            let bars = estimates.iter().filter_map(|(x, estimate)| {
                let half = estimate.confidence?;
                Some((*x, estimate.mean - half, estimate.mean + half))
            });
            let bars: Vec<_> = bars.collect();
            if !bars.is_empty() {
                curves.push(Curve::bars("", colour, bars));
            }
            curves.push(Curve::new("", colour, means()).dotted());
            curves.push(Curve::new(name, colour, means()).wide(5));
        }
    }
    let (y, title) = match observed {
        _ if changes => ("change, %".into(), sweep.title.clone()),
        [index] => {
            let name = index.name(drawn);
            let title = format!("{}: {name}", sweep.title);
            (name, title)
        }
        _ => ("index".into(), sweep.title.clone()),
    };
    Panel {
        title,
        sides: true,
        keeps_to_values: changes || observed.iter().all(|index| index.factor.is_none()),
        ..panel(&of_axis(first), &y, curves)
    }
}

/// Draws pale curves of the individual seeds, which show how far the seeds spread and that they change together.
fn seed_curves(
    drawn: &Drawn<'_>,
    sweep: &Sweep,
    index: &Index,
    changes: bool,
    colour: RGBColor,
) -> Vec<Curve> {
    let axis = &sweep.axes[0];
    let mut seeds: Vec<Vec<(f64, f64)>> = vec![Vec::new(); sweep.seeds.len()];
    for (at, value) in axis.values.iter().enumerate() {
        let Value::Number(x) = value else { continue };
        let values = values(drawn, sweep, at as u64, index, changes);
        for (points, value) in seeds.iter_mut().zip(values) {
            points.extend(value.map(|y| (x * axis.factor, y)));
        }
    }
    let RGBColor(red, green, blue) = colour;
    let pale = RGBColor(lighter(red), lighter(green), lighter(blue));
    let curve = |points| Curve::new("", pale, points).wide(3);
    seeds.into_iter().map(curve).collect()
}

fn lighter(part: u8) -> u8 {
    255 - (255 - part) / 4
}

/// Describes the values of all axes after the first.
fn at_others(sweep: &Sweep, other: u64) -> String {
    let values = sweep.values(other);
    let named = sweep.axes.iter().zip(values).skip(1);
    let named = named.map(|(axis, value)| equation(axis, value));
    named.collect::<Vec<_>>().join(", ")
}

/// Tabulates means with confidence intervals, and their change from the first value of the first axis.
fn table(drawn: &Drawn<'_>, sweep: &Sweep, observed: &[Index]) -> Markup {
    let others = sweep.points()
        / sweep
            .axes
            .first()
            .map_or(1, |axis| axis.values.len() as u64);
    let change = |point: u64, index: usize| {
        let [from, to] = [point % others, point].map(|at| drawn.seed_values(sweep, at, index));
        Estimate::of_change(&from, &to).filter(|_| point >= others)
    };
    html! {
        div.wide.worded { table {
            tr {
                @for axis in &sweep.axes { th { (of_axis(axis)) } }
                @for index in observed {
                    th { (index.name(drawn)) }
                    th { "change, %" }
                }
            }
            @for point in 0..sweep.points() {
                tr {
                    @for (axis, value) in sweep.axes.iter().zip(sweep.values(point)) { td { (in_unit(axis, value)) } }
                    @for index in observed {
                        @let values = values(drawn, sweep, point, index, false);
                        @let present: Vec<f64> = values.into_iter().flatten().collect();
                        td { (text(Estimate::of(&present), 4)) }
                        td { (text(change(point, index.number), 2)) }
                    }
                }
            }
        } }
    }
}

/// Formats a mean with its confidence interval.
fn text(estimate: Option<Estimate>, digits: usize) -> String {
    match estimate {
        Some(Estimate {
            mean,
            confidence: Some(half),
            ..
        }) => format!("{mean:.digits$} ± {half:.digits$}"),
        Some(Estimate { mean, .. }) => format!("{mean:.digits$}"),
        None => "-".into(),
    }
}
