//! Observed indices over what varies.

use maud::{Markup, html};
use plotters::style::RGBColor;

use super::{Drawn, HEIGHT};
use crate::commands::failure::Outcome;
use crate::files::study::{Axis, Sweep, Value};
use crate::report::page::{Figure, figure, panel};
use crate::report::plot::curves::{Curve, ramp};
use crate::report::plot::sheet::Panel;
use crate::report::plot::style::{AMBER_LINE, BLUE_LINE, PALE, RED_LINE};
use crate::study::sweep::Estimate;

/// Colours of indices of one panel.
const COLOURS: [RGBColor; 4] = [BLUE_LINE, RED_LINE, AMBER_LINE, PALE];

/// A panel for each sweep whose first axis has numbers, a table for each other.
///
/// # Errors
/// The figure cannot be drawn.
pub(super) fn part(
    drawn: &Drawn<'_>,
    sweeps: &[&Sweep],
    observed: &[usize],
    caption: &str,
) -> Outcome<Markup> {
    let is_number = |axis: &Axis| matches!(axis.values.first(), Some(Value::Number(_)));
    let (plotted, listed): (Vec<&Sweep>, Vec<&Sweep>) = sweeps
        .iter()
        .partition(|sweep| sweep.axes.first().is_some_and(is_number));
    let panels: Vec<Panel> = plotted
        .iter()
        .map(|sweep| over_axis(drawn, sweep, observed))
        .collect();
    let of_panels = Figure {
        panels,
        height: HEIGHT,
        shares: None,
    };
    Ok(html! {
        @if !plotted.is_empty() { (figure(&of_panels, &html! { (caption) })?) }
        @for sweep in listed {
            (table(drawn, sweep, observed))
            p { (caption) }
        }
    })
}

/// Means with their confidence; a curve for each index, and for each value of a second axis.
fn over_axis(drawn: &Drawn<'_>, sweep: &Sweep, observed: &[usize]) -> Panel {
    let first = &sweep.axes[0];
    let others = sweep.points() / first.values.len() as u64;
    let mut curves = Vec::new();
    let shades = ramp(others as usize);
    for (number, index) in observed.iter().enumerate() {
        for other in 0..others {
            let colour = match others {
                1 => COLOURS[number % COLOURS.len()],
                _ => shades[other as usize],
            };
            let estimates = first.values.iter().enumerate().filter_map(|(at, value)| {
                let Value::Number(x) = value else {
                    return None;
                };
                let point = at as u64 * others + other;
                let estimate = Estimate::of(&drawn.values(sweep, point, *index))?;
                Some((x * first.factor, estimate))
            });
            let estimates: Vec<(f64, Estimate)> = estimates.collect();
            let name = match (others, observed.len()) {
                (1, 1) => String::new(),
                (1, _) => drawn.study.observed[*index].name.replace('_', " "),
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
    let y = match observed {
        [index] => drawn.study.observed[*index].meaning,
        _ => "index",
    };
    Panel {
        title: sweep.title.clone(),
        sides: true,
        ..panel(&first.label, y, curves)
    }
}

/// Values of the axes behind the first.
fn at_others(sweep: &Sweep, other: u64) -> String {
    let values = sweep.values(other);
    let named = sweep.axes.iter().zip(values).skip(1);
    let named = named.map(|(axis, value)| match value {
        Value::Number(number) => format!("{}", number * axis.factor),
        Value::Word(word) => word.clone(),
    });
    named.collect::<Vec<_>>().join(", ")
}

/// Means with their confidence, and their change from the first value.
fn table(drawn: &Drawn<'_>, sweep: &Sweep, observed: &[usize]) -> Markup {
    let change = |point: u64, index: usize| {
        let [first, here] = [0, point].map(|point| drawn.values(sweep, point, index));
        // Of runs on the same irregularities.
        let pairs = first.iter().zip(&here);
        let ratios: Vec<f64> = pairs.map(|(a, b)| 100.0 * (b / a - 1.0)).collect();
        Estimate::of(&ratios).filter(|_| point > 0 && first.len() == here.len())
    };
    html! {
        div.wide.worded { table {
            tr {
                th { (sweep.axes.first().map_or("", |axis| &axis.label)) }
                @for index in observed {
                    th { (drawn.study.observed[*index].name.replace('_', " ")) }
                    th { "change, %" }
                }
            }
            @for point in 0..sweep.points() {
                tr {
                    td { (sweep.values(point).iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")) }
                    @for index in observed {
                        td { (text(Estimate::of(&drawn.values(sweep, point, *index)), 4)) }
                        td { (text(change(point, *index), 2)) }
                    }
                }
            }
        } }
    }
}

/// A mean and its confidence.
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
