//! Figures of the page.

use plotters::style::RGBColor;

use super::history::{Forces, History};
use dashpot_report::page::{Figure, panel};
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::envelope::Envelope;
use dashpot_report::plot::sheet::{Panel, Scale};
use dashpot_report::plot::style::{AMBER_LINE, BLUE_LINE, PALE, RED_LINE};

/// Bars of a histogram at most.
const MOST_BARS: u64 = 40;
const TIME: &str = "time, s";

/// A curve over time of the samples in `envelope`, times `factor`.
fn curve(
    history: &History,
    name: &str,
    colour: RGBColor,
    envelope: &Envelope,
    factor: f64,
) -> Curve {
    let samples = envelope.samples();
    let points = samples.map(|(tick, value)| (history.time_s(tick), value * factor));
    Curve::new(name, colour, points.collect::<Vec<_>>())
}

/// Marks of faults made and of recoveries, where there were any.
fn marks(history: &History) -> Vec<Curve> {
    let kinds = [
        (AMBER_LINE, &history.faults_made),
        (RED_LINE, &history.recoveries),
    ];
    let times = |envelope: &Envelope| -> Vec<f64> {
        envelope.ticks().map(|tick| history.time_s(tick)).collect()
    };
    let marks = kinds
        .into_iter()
        .map(|(colour, envelope)| Curve::marks(colour, times(envelope)));
    marks
        .filter(|curve| curve.abscissas().next().is_some())
        .collect()
}

/// A panel over time with the marks.
fn over_time(history: &History, y: &str, scale: Scale, mut curves: Vec<Curve>) -> Panel {
    curves.extend(marks(history));
    Panel {
        scale,
        ..panel(TIME, y, curves)
    }
}

/// Forces of target and host at a place; beside them, where any differ, target less host.
pub(super) fn forces(history: &History, place: &Forces) -> Figure {
    let curves = vec![
        curve(history, "host", PALE, &place.host_n, 1e-3).wide(22),
        curve(history, "target", BLUE_LINE, &place.target_n, 1e-3).wide(6),
    ];
    let mut panels = vec![over_time(history, "force, kN", Scale::Linear, curves)];
    if place.differ {
        let error = curve(history, "", RED_LINE, &place.difference_n, 1.0);
        panels.push(panel(TIME, "target less host, N", vec![error.wide(6)]));
    }
    Figure {
        panels,
        height: 280,
        shares: Some(TIME),
    }
}

/// Clock ticks that a tick of the bank took: how often, and over time.
pub(super) fn clock_ticks(history: &History) -> Figure {
    let over = curve(history, "", BLUE_LINE, &history.clock_ticks, 1.0).wide(5);
    Figure {
        panels: vec![
            Panel {
                sides: true,
                ..panel("clock ticks", "ticks of the bank", vec![bars(history)])
            },
            over_time(history, "clock ticks", Scale::Linear, vec![over]),
        ],
        height: 340,
        shares: Some(TIME),
    }
}

/// The histogram's outline.
fn bars(history: &History) -> Curve {
    let spread = &history.clock_spread;
    let (least, most) = (spread.min(), spread.max());
    let width = (most - least + 1).div_ceil(MOST_BARS).max(1);
    let mut points = Vec::new();
    let bars = (most - least) / width + 1;
    for bar in 0..bars {
        let from = least + bar * width;
        let count = spread.count_between(from, from + width - 1) as f64;
        // A whole number stands in the middle of its bar.
        let (left, right) = (from as f64 - 0.5, (from + width) as f64 - 0.5);
        points.extend([(left, 0.0), (left, count), (right, count), (right, 0.0)]);
    }
    Curve::new("", BLUE_LINE, points).filled().wide(4)
}

/// Round trips over time, and the step where ticks were `paced`.
pub(super) fn round_trip(history: &History, paced: bool) -> Figure {
    let trips = curve(
        history,
        "round trip",
        BLUE_LINE,
        &history.round_trip_ns,
        1e-6,
    );
    let mut curves = vec![trips.wide(5)];
    if paced {
        let ends: Vec<f64> = curves[0].abscissas().collect();
        let step_ms = history.step_s() * 1e3;
        let step = [ends.first(), ends.last()].into_iter().flatten();
        let step = step.map(|time_s| (*time_s, step_ms));
        curves.push(Curve::new("one step", PALE, step).dashed());
    }
    Figure {
        panels: vec![over_time(history, "round trip, ms", Scale::Decades, curves)],
        height: 300,
        shares: Some(TIME),
    }
}
