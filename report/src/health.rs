//! The page of a damper's health over a run.

use dashpot_core::health::{Estimate, HealthReading};
use maud::{Markup, html};

use super::DrawError;
use super::page::{Figure, document, figure, footer, panel, tiles};
use super::plot::curves::Curve;
use super::plot::sheet::Panel;
use super::plot::style::{AMBER_LINE, BLUE_LINE, PALE};
use dashpot_testbench::health::{
    History, alarm_in_words, doubts_in_words, in_words, stiffness_in_words,
};

/// Deviations that a band is wide on either side.
const BAND: f64 = 2.0;

/// What is known by its compliance.
const STIFFNESS: &str = "stiffness";

/// One parameter: how it is shown, where it lies in a reading, and what it is compared with.
struct Shown {
    label: &'static str,
    unit: &'static str,
    /// By what it is multiplied to be in that unit.
    scale: f64,
    of: fn(&HealthReading) -> Estimate,
    baseline: Option<f64>,
    limits: Option<[f64; 2]>,
}

/// The run as HTML: each parameter with a band of two standard deviations, its baseline and its limits.
///
/// # Errors
/// A figure cannot be drawn.
pub fn page(title: &str, history: &History) -> Result<String, DrawError> {
    let shown = shown(history);
    let panels = shown.iter().map(|parameter| plot(history, parameter));
    let plots = Figure {
        panels: panels.collect(),
        height: 260,
        shares: Some("time"),
    };
    let caption = html! {
        "Blue: estimate with a band of two standard deviations. Dashed: baseline. Amber: limits of an alarm, which \
         an estimate must leave by " (history.model.limits().deviations) " standard deviations too."
    };
    let body = html! {
        h1 { "Health of a damper" }
        p.lead { (title) "." }
        (headline(history, &shown))
        (alarms(history))
        h2 { "Estimates" }
        (figure(&plots, &caption)?)
        (footer(&html! { "Flow over the nominal one at the same force: its inverse is the damping factor." }))
    };
    Ok(document("Dashpot: health of a damper", &body))
}

fn shown(history: &History) -> [Shown; 6] {
    let (baseline, limits) = (history.model.baseline(), history.model.limits());
    let around = |centre: f32, limit: f32| {
        let (centre, limit) = (f64::from(centre), f64::from(limit));
        limit
            .is_finite()
            .then_some([centre - limit, centre + limit])
    };
    let compliance = f64::from(baseline.compliance_m_per_n);
    let part = f64::from(limits.compliance);
    let stiffness_at = |part: f64| 1.0 / (compliance * (1.0 + part));
    [
        Shown {
            label: "flow factor",
            unit: "1",
            scale: 1.0,
            of: |reading| reading.flow_factor,
            baseline: Some(f64::from(baseline.flow_factor)),
            limits: around(baseline.flow_factor, limits.flow_factor),
        },
        Shown {
            label: STIFFNESS,
            unit: "MN/m",
            scale: 1e-6,
            of: |reading| reading.stiffness_n_per_m,
            baseline: Some(1.0 / compliance),
            limits: (part < 1.0).then(|| [stiffness_at(part), stiffness_at(-part)]),
        },
        Shown {
            label: "clearance 2a",
            unit: "mm",
            scale: 1e3,
            of: |reading| reading.clearance_m,
            baseline: Some(f64::from(baseline.clearance_m)),
            limits: around(baseline.clearance_m, limits.clearance_m),
        },
        Shown {
            label: "lag of the force",
            unit: "ms",
            scale: 1e3,
            of: |reading| reading.lag_s,
            baseline: None,
            limits: None,
        },
        Shown {
            label: "zero of the force",
            unit: "N",
            scale: 1.0,
            of: |reading| reading.force_zero_n,
            baseline: None,
            limits: None,
        },
        Shown {
            label: "added friction",
            unit: "N",
            scale: 1.0,
            of: |reading| reading.added_friction_n,
            baseline: None,
            limits: None,
        },
    ]
}

fn plot(history: &History, shown: &Shown) -> Panel {
    let at = |reading: &HealthReading| {
        let Estimate { value, sd } = (shown.of)(reading);
        (shown.scale * f64::from(value), shown.scale * f64::from(sd))
    };
    let readings = || history.readings.iter();
    // At first next to nothing is known, which is no reason to show nothing of what comes.
    let shows = |value: f64| match shown.limits {
        Some([low, high]) => {
            let beyond = 2.0 * (high - low);
            value.clamp(shown.scale * (low - beyond), shown.scale * (high + beyond))
        }
        None => value,
    };
    let band = readings().map(|point| {
        let (value, sd) = at(&point.reading);
        (
            point.time_s,
            shows(value - BAND * sd),
            shows(value + BAND * sd),
        )
    });
    let line = readings().map(|point| (point.time_s, shows(at(&point.reading).0)));
    let ends = || {
        let ends = [history.readings.first(), history.readings.last()];
        ends.into_iter().flatten().map(|point| point.time_s)
    };
    let level = |value: f64| -> Vec<(f64, f64)> {
        ends().map(|time_s| (time_s, shown.scale * value)).collect()
    };
    let mut curves = vec![
        Curve::band("", BLUE_LINE, band),
        Curve::new(shown.label, BLUE_LINE, line),
    ];
    let baseline = shown
        .baseline
        .map(|value| Curve::new("baseline", PALE, level(value)).dashed());
    curves.extend(baseline);
    let limits = shown.limits.into_iter().flatten();
    curves.extend(limits.map(|value| Curve::new("", AMBER_LINE, level(value))));
    let mut panel = panel("time, s", &label(shown), curves);
    panel.keeps_to_values = true;
    panel
}

/// Name and unit of a parameter.
fn label(shown: &Shown) -> String {
    match shown.unit {
        "1" => shown.label.into(),
        unit => format!("{}, {unit}", shown.label),
    }
}

fn headline(history: &History, shown: &[Shown]) -> Markup {
    let last = history.last();
    let values: Vec<(Markup, String)> = shown
        .iter()
        .filter_map(|parameter| {
            let last = last?;
            let told = match parameter.label {
                STIFFNESS => stiffness_in_words(last.stiffness_n_per_m, last.compliance_m_per_n),
                _ => in_words((parameter.of)(last), parameter.scale as f32),
            };
            let unit = parameter.unit.trim_start_matches('1');
            let meaning = format!(
                "{} at the end, with its standard deviation",
                parameter.label
            );
            Some((html! { (told) " " (unit) }, meaning))
        })
        .collect();
    tiles(&values)
}

fn alarms(history: &History) -> Markup {
    html! {
        @if history.alarms.is_empty() {
            p { "No alarm." }
        } @else {
            ul {
                @for (alarm, time_s) in &history.alarms {
                    @if let Some(last) = history.last() {
                        li { "Alarm: " (alarm_in_words(*alarm, last)) ", since " (format!("{time_s:.2}")) " s." }
                    }
                }
            }
        }
        @if let Some(last) = history.last() {
            @for doubt in doubts_in_words(last.status) {
                p { "At the end: " (doubt) "." }
            }
            p {
                (last.samples) " samples told something: both ends in contact, not yielding. " (last.rejected)
                " were not finite or not credible."
            }
        }
    }
}
