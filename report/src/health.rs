//! Page about a damper's health during a run.

use dashpot_core::health::{Estimate, HealthReading};
use maud::{Markup, html};

use super::DrawError;
use super::page::{Figure, document, figure, footer, judged, panel, tiles};
use super::plot::curves::Curve;
use super::plot::sheet::Panel;
use super::plot::style::{COMPARED, LIMIT, RESULT};
use dashpot_testbench::health::{
    History, alarm_in_words, doubts_in_words, in_words, stiffness_in_words,
};

/// Half width of the bands in standard deviations.
const BAND_DEVIATIONS: f64 = 2.0;

/// Label of the stiffness; the estimator estimates its inverse, the compliance.
const STIFFNESS: &str = "stiffness";

/// An estimated parameter: how to read, display and judge it.
struct Parameter {
    label: &'static str,
    unit: &'static str,
    /// Factor from SI units to `unit`.
    scale: f64,
    /// Reads the estimate, in SI units.
    estimate: fn(&HealthReading) -> Estimate,
    /// Value of the healthy damper, in SI units.
    baseline: Option<f64>,
    /// Limits of the alarm, in SI units.
    limits: Option<Limits>,
}

/// Limits of an alarm, in SI units.
#[derive(Clone, Copy)]
struct Limits {
    low: f64,
    high: f64,
}

/// What may have changed, for the page.
#[derive(Debug, Clone)]
pub struct LikelyCauses {
    /// Causes in words with their probabilities, the most likely first.
    pub causes: Vec<(String, f64)>,
    /// What a reader has to know about them.
    pub remarks: Vec<String>,
}

/// Returns an HTML page: each parameter over time with a band of two standard deviations, its baseline and its limits;
/// the force, the share of time in contact, and the likely causes of a change if they are known.
///
/// # Errors
/// Returns an error if a figure cannot be drawn.
pub fn page(
    title: &str,
    history: &History,
    causes: Option<&LikelyCauses>,
) -> Result<String, DrawError> {
    let parameters = parameters(history);
    let panels = parameters.iter().map(|parameter| plot(history, parameter));
    let plots = Figure {
        panels: panels.collect(),
        height: 260,
        cursor_group: Some("time"),
    };
    let caption = html! {
        "The band around an estimate is two standard deviations. An alarm is raised when an estimate exceeds a limit \
         by " (history.model.limits().deviations) " standard deviations."
    };
    let body = html! {
        h1 { "Health of a damper" }
        p.lead { (title) "." }
        (headline(history, &parameters))
        (alarms(history))
        @if let Some(causes) = causes { (likely(causes)) }
        h2 { "Estimates" }
        (figure(&plots, &caption)?)
        h2 { "Force" }
        (figure(&force_and_contact(history), &html! {
            "The band reaches from the least to the greatest force between two readings. Only samples with the mount "
            "in contact and the damper not saturated tell about its condition."
        })?)
        (footer(&html! {
            "Flow factor: flow divided by the nominal flow at the same force. Its inverse is the damping factor."
        }))
    };
    Ok(document("Dashpot: health of a damper", &body))
}

/// Lists the likely causes of a change.
fn likely(likely: &LikelyCauses) -> Markup {
    html! {
        h2 { "Likely cause" }
        div.wide.worded {
            table {
                thead { tr { th { "cause" } th { "probability" } } }
                @for (cause, probability) in &likely.causes {
                    tr { td { (cause) } td { (format!("{:.0} %", 100.0 * probability)) } }
                }
            }
        }
        @for remark in &likely.remarks { p { (remark) "." } }
        p.note {
            "Each cause was fitted to the end of the recording on its own, on the computer that wrote this page; the "
            "estimates below are those of the target's filter."
        }
    }
}

fn force_and_contact(history: &History) -> Figure {
    let readings = || history.readings.iter();
    let end = |end: usize| readings().map(move |point| (point.time_s, point.force_n[end] * 1e-3));
    let band = end(0).zip(end(1));
    let band = band.map(|((time_s, least), (_, greatest))| (time_s, least, greatest));
    let force = vec![
        Curve::band("", RESULT, band),
        Curve::new("", RESULT, end(0)),
        Curve::new("force", RESULT, end(1)),
    ];
    let share = readings().map(|point| (point.time_s, 100.0 * point.used_share));
    let panels = [
        panel("time, s", "force, kN", force),
        panel(
            "time, s",
            "samples used, %",
            vec![Curve::new("used", RESULT, share)],
        ),
    ];
    Figure {
        panels: panels.into_iter().map(beginning_at_values).collect(),
        height: 260,
        cursor_group: Some("time"),
    }
}

/// Returns the panel with axes that begin and end near the values.
fn beginning_at_values(panel: Panel) -> Panel {
    Panel {
        keeps_to_values: true,
        sides: true,
        ..panel
    }
}

fn parameters(history: &History) -> [Parameter; 6] {
    let (baseline, limits) = (history.model.baseline(), history.model.limits());
    let around = |centre: f32, limit: f32| {
        let (centre, limit) = (f64::from(centre), f64::from(limit));
        limit.is_finite().then_some(Limits {
            low: centre - limit,
            high: centre + limit,
        })
    };
    let compliance = f64::from(baseline.compliance_m_per_n);
    let change = f64::from(limits.compliance);
    let stiffness_at = |change: f64| 1.0 / (compliance * (1.0 + change));
    [
        Parameter {
            label: "flow factor",
            unit: "1",
            scale: 1.0,
            estimate: |reading| reading.flow_factor,
            baseline: Some(f64::from(baseline.flow_factor)),
            limits: around(baseline.flow_factor, limits.flow_factor),
        },
        Parameter {
            label: STIFFNESS,
            unit: "MN/m",
            scale: 1e-6,
            estimate: |reading| reading.stiffness_n_per_m,
            baseline: Some(1.0 / compliance),
            limits: (change < 1.0).then(|| Limits {
                low: stiffness_at(change),
                high: stiffness_at(-change),
            }),
        },
        Parameter {
            label: "clearance 2a",
            unit: "mm",
            scale: 1e3,
            estimate: |reading| reading.clearance_m,
            baseline: Some(f64::from(baseline.clearance_m)),
            limits: around(baseline.clearance_m, limits.clearance_m),
        },
        Parameter {
            label: "lag of the force",
            unit: "ms",
            scale: 1e3,
            estimate: |reading| reading.lag_s,
            baseline: None,
            limits: None,
        },
        Parameter {
            label: "zero of the force",
            unit: "N",
            scale: 1.0,
            estimate: |reading| reading.force_zero_n,
            baseline: None,
            limits: None,
        },
        Parameter {
            label: "added friction",
            unit: "N",
            scale: 1.0,
            estimate: |reading| reading.added_friction_n,
            baseline: None,
            limits: None,
        },
    ]
}

fn plot(history: &History, parameter: &Parameter) -> Panel {
    let at = |reading: &HealthReading| {
        let Estimate { value, sd } = (parameter.estimate)(reading);
        (
            parameter.scale * f64::from(value),
            parameter.scale * f64::from(sd),
        )
    };
    let readings = || history.readings.iter();
    // The first estimates are very uncertain, so they are clipped to keep them from setting the range of the axis.
    let clip = |value: f64| match parameter.limits {
        Some(Limits { low, high }) => {
            let margin = 2.0 * (high - low);
            value.clamp(
                parameter.scale * (low - margin),
                parameter.scale * (high + margin),
            )
        }
        None => value,
    };
    let band = readings().map(|point| {
        let (value, sd) = at(&point.reading);
        (
            point.time_s,
            clip(value - BAND_DEVIATIONS * sd),
            clip(value + BAND_DEVIATIONS * sd),
        )
    });
    let line = readings().map(|point| (point.time_s, clip(at(&point.reading).0)));
    let ends = || {
        let ends = [history.readings.first(), history.readings.last()];
        ends.into_iter().flatten().map(|point| point.time_s)
    };
    let level = |value: f64| -> Vec<(f64, f64)> {
        ends()
            .map(|time_s| (time_s, parameter.scale * value))
            .collect()
    };
    let mut curves = vec![
        Curve::band("", RESULT, band),
        Curve::new("estimate", RESULT, line),
    ];
    let baseline = parameter
        .baseline
        .map(|value| Curve::new("baseline", COMPARED, level(value)).dashed());
    curves.extend(baseline);
    let limits = parameter.limits.into_iter();
    let limits = limits.flat_map(|limits| [("", limits.low), ("alarm limits", limits.high)]);
    curves.extend(limits.map(|(name, value)| Curve::new(name, LIMIT, level(value)).dashed()));
    beginning_at_values(panel("time, s", &label(parameter), curves))
}

/// Returns the name and unit of a parameter.
fn label(parameter: &Parameter) -> String {
    match parameter.unit {
        "1" => parameter.label.into(),
        unit => format!("{}, {unit}", parameter.label),
    }
}

fn headline(history: &History, parameters: &[Parameter]) -> Markup {
    let last = history.last();
    let values: Vec<(Markup, String)> = parameters
        .iter()
        .filter_map(|parameter| {
            let last = last?;
            let value = match parameter.label {
                STIFFNESS => stiffness_in_words(last.stiffness_n_per_m, last.compliance_m_per_n),
                _ => in_words((parameter.estimate)(last), parameter.scale as f32),
            };
            let unit = parameter.unit.trim_start_matches('1');
            let meaning = format!("{} at the end, with standard deviation", parameter.label);
            Some((html! { (value) " " (unit) }, meaning))
        })
        .collect();
    tiles(&values)
}

fn alarms(history: &History) -> Markup {
    html! {
        @if history.alarms.is_empty() {
            p { (judged(true, "No alarm.")) }
        } @else {
            ul {
                @for (alarm, time_s) in &history.alarms {
                    @if let Some(last) = history.last() {
                        li {
                            (judged(false, &format!("Alarm: {}", alarm_in_words(*alarm, last))))
                            ", since " (format!("{time_s:.2}")) " s."
                        }
                    }
                }
            }
        }
        @if let Some(last) = history.last() {
            @for doubt in doubts_in_words(last) {
                p { "At the end: " (doubt) "." }
            }
            p {
                (last.samples) " samples were usable (mount in contact, damper not saturated); " (last.rejected)
                " were rejected as not finite or not credible."
            }
        }
    }
}
