//! Page about a fleet: its dampers, worst first, with the trends of the worst, and the recordings that are not used.

use maud::{Markup, html};

use super::DrawError;
use super::page::{Figure, document, figure, footer, judged, panel, tiles};
use super::plot::curves::Curve;
use super::plot::sheet::Panel;
use super::plot::style::{LIMIT, RESULT};
use dashpot_testbench::trend::fleet::Urgency;
use dashpot_testbench::trend::{Axis, DamperTrends, Fleet, Trend};

/// Dampers whose trends are drawn.
const DRAWN: usize = 6;
/// Points of a line and its band.
const STEPS: usize = 60;
/// A line is drawn beyond the last reading by at most this multiple of the readings' span.
const MAX_AHEAD: f64 = 1.0;

/// Returns an HTML page about a fleet.
///
/// # Errors
/// Returns an error if a figure cannot be drawn.
pub fn page(title: &str, fleet: &Fleet) -> Result<String, DrawError> {
    let refused = fleet.refused().count();
    let body = html! {
        h1 { "Dampers of a fleet" }
        p.lead { (title) ". The damper to look at first is at the top." }
        (headline(fleet, refused))
        h2 { "Dampers" }
        (table(fleet, true))
        @if fleet.dampers.iter().any(|damper| !damper.is_installed) {
            h2 { "Exchanged dampers" }
            (table(fleet, false))
        }
        h2 { "Trends of the worst dampers" }
        (drawings(fleet)?)
        @if refused > 0 {
            h2 { "Recordings that are not used" }
            (refusals(fleet))
        }
        (footer(&html! {
            "Each recording gives one reading, at its end. Lines are weighted by the deviations of the readings and by \
             their scatter from recording to recording; intervals contain the true value in 95 % of cases if the wear \
             is steady. docs/health.md describes the method, docs/out-of-service.md where the limits come from."
        }))
    };
    Ok(document("Dashpot: dampers of a fleet", &body))
}

fn installed(fleet: &Fleet) -> impl Iterator<Item = &DamperTrends> {
    fleet.dampers.iter().filter(|damper| damper.is_installed)
}

fn headline(fleet: &Fleet, refused: usize) -> Markup {
    let count = |of: fn(Urgency) -> bool| {
        let urgencies = installed(fleet).map(|damper| damper.urgency(fleet.axis));
        urgencies.filter(|urgency| of(*urgency)).count()
    };
    let beyond = count(|urgency| matches!(urgency, Urgency::Beyond(_)));
    let reaching = count(|urgency| matches!(urgency, Urgency::Reaches(_)));
    let (_, horizon) = fleet.axis.horizon();
    let used = fleet.recorded().count() - refused;
    tiles(&[
        (html! { (installed(fleet).count()) }, "dampers".into()),
        (html! { (beyond) }, "beyond a limit".into()),
        (
            html! { (reaching) },
            format!("will reach a limit within {horizon}"),
        ),
        (
            html! { (used) " of " (used + refused) },
            "recordings used".into(),
        ),
    ])
}

/// Tabulates the dampers that are installed, or those that are not.
fn table(fleet: &Fleet, is_installed: bool) -> Markup {
    let axis = fleet.axis;
    let dampers = fleet.dampers.iter();
    let dampers = dampers.filter(|damper| damper.is_installed == is_installed);
    html! {
        div.wide.worded {
            table.tight {
                thead {
                    tr {
                        th { "vehicle" } th.text { "damper" } th.text { "limit reached" } th.text { "parameter" }
                        th.text { "rate" } th { "limit" } th.text { "damping" } th.text { "stiffness" }
                        th.text { "clearance 2a" } th { "readings" }
                    }
                }
                @for damper in dampers {
                    @let worst = damper.worst(axis);
                    @let [vehicle, position, serial_number] = damper.name();
                    tr class=[(is_installed && is_beyond(damper, axis)).then_some("over")] {
                        td { (vehicle) }
                        td.text { (position) @if !serial_number.is_empty() { ", no. " (serial_number) } }
                        td.text {
                            (when(damper, axis))
                            @for note in damper.notes(axis) { br; (note) }
                        }
                        td.text { (worst.parameter.name()) }
                        td.text { (worst.rate_in_words(axis)) }
                        td { (worst.limit_in_words()) }
                        @for trend in &damper.trends { td.text { (trend.now_in_words()) } }
                        td { (damper.used()) " of " (damper.recorded.len()) }
                    }
                }
            }
        }
        p {
            "Damping, stiffness and clearance are those at the last reading, with 95 % intervals. Damping is relative \
             to nominal. A stiffness that cannot be told from a rigid mount is “rigid”."
        }
    }
}

fn is_beyond(damper: &DamperTrends, axis: Axis) -> bool {
    matches!(damper.urgency(axis), Urgency::Beyond(_))
}

fn when(damper: &DamperTrends, axis: Axis) -> Markup {
    let words = damper.worst(axis).when_in_words(axis);
    if is_beyond(damper, axis) {
        judged(false, &words)
    } else {
        html! { (words) }
    }
}

/// Draws the trends of the worst dampers.
fn drawings(fleet: &Fleet) -> Result<Markup, DrawError> {
    let mut figures = Vec::new();
    for damper in installed(fleet) {
        let drawn = damper
            .trends
            .iter()
            .filter_map(|trend| plot(trend, fleet.axis));
        let panels: Vec<Panel> = drawn.collect();
        if panels.is_empty() {
            continue;
        }
        let [vehicle, position, _] = damper.name();
        let worst = damper.worst(fleet.axis);
        let caption = html! {
            b { (vehicle) ", " (position) } ": " (worst.parameter.name()) ", " (worst.when_in_words(fleet.axis)) "."
        };
        let plots = Figure {
            panels,
            height: 230,
            cursor_group: None,
        };
        figures.push(figure(&plots, &caption)?);
        if figures.len() == DRAWN {
            break;
        }
    }
    Ok(html! {
        @if figures.is_empty() {
            p { "No damper has enough readings for a line: three at two dates or more." }
        } @else {
            p {
                "Points are readings, with bars of two standard deviations. The band is the 95 % interval of the line, \
                 without the scatter of a single reading."
            }
        }
        @for figure in &figures { (figure) }
    })
}

/// Returns readings, line, band and limit of a trend; `None` without a line.
fn plot(trend: &Trend, axis: Axis) -> Option<Panel> {
    let line = trend.line?;
    let (first, last) = (trend.points.first()?.x, trend.last()?);
    let (unit, scale) = trend.parameter.display_unit();
    let shown = |fitted: f64| scale * trend.parameter.shown(fitted);
    let ahead = match trend.urgency(axis) {
        Urgency::Reaches(at) => (1.1 * (at - last)).min(MAX_AHEAD * (last - first)),
        _ => 0.1 * (last - first),
    };
    let at = (0..=STEPS).map(|step| first + (last + ahead - first) * step as f64 / STEPS as f64);
    let at: Vec<f64> = at.collect();
    let ordered = |a: f64, b: f64| (a.min(b), a.max(b));
    let band = at.iter().map(|x| {
        let interval = line.at(*x);
        let (low, high) = ordered(shown(interval.low), shown(interval.high));
        (axis.plotted(*x), low, high)
    });
    let middle = at
        .iter()
        .map(|x| (axis.plotted(*x), shown(line.at(*x).value)));
    let readings = || trend.points.iter();
    let bars = readings().map(|point| {
        let (low, high) = ordered(
            shown(point.y - 2.0 * point.sd),
            shown(point.y + 2.0 * point.sd),
        );
        (axis.plotted(point.x), low, high)
    });
    let dots = readings().map(|point| (axis.plotted(point.x), shown(point.y)));
    // A mount that cannot be told from a rigid one has no upper end.
    let finite = |(x, low, high): (f64, f64, f64)| {
        (low.is_finite() && high.is_finite()).then_some((x, low, high))
    };
    let mut curves = vec![
        Curve::band("", RESULT, band.filter_map(finite)),
        Curve::new("line", RESULT, middle.filter(|(_, y)| y.is_finite())),
        Curve::bars("", RESULT, bars.filter_map(finite)),
        Curve::new("readings", RESULT, dots.filter(|(_, y)| y.is_finite())).dotted(),
    ];
    if let Some(limit) = trend.limit {
        let level = [first, last + ahead].map(|x| (axis.plotted(x), shown(limit.value)));
        curves.push(Curve::new("limit", LIMIT, level).dashed());
    }
    let label = match unit {
        "" => trend.parameter.name().to_owned(),
        unit => format!("{}, {unit}", trend.parameter.name()),
    };
    let mut panel = panel(axis.plot_label(), &label, curves);
    panel.keeps_to_values = true;
    Some(panel)
}

fn refusals(fleet: &Fleet) -> Markup {
    html! {
        div.wide.worded {
            table {
                thead { tr { th { "vehicle" } th.text { "damper" } th.text { "recording" } th.text { "reason" } } }
                @for (recorded, refusal) in fleet.refused() {
                    @let listed = &recorded.listed;
                    tr {
                        td { (listed.vehicle) }
                        td.text { (listed.damper) }
                        td.text { (listed.file.file_name().unwrap_or_default().to_string_lossy()) }
                        td.text { (refusal.reason()) }
                    }
                }
            }
        }
    }
}
