//! Figures of the page of a PIL run.

use plotters::style::RGBColor;

use super::history::{Forces, History};
use dashpot_report::page::{Figure, panel};
use dashpot_report::plot::curves::Curve;
use dashpot_report::plot::envelope::Envelope;
use dashpot_report::plot::sheet::{Panel, Scale};
use dashpot_report::plot::style::{
    AMBER_LINE, COMPARED, DIFFERENCE, LIMIT, RED_LINE, RESULT, SEVERAL,
};

/// Maximum number of bars in a histogram.
const MAX_BARS: u64 = 40;
const TIME: &str = "time, s";

/// Draws the samples in `envelope` over time, scaled by `factor`.
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

/// Returns marks at injected faults and recoveries; empty if there were none.
fn marks(history: &History) -> Vec<Curve> {
    let kinds = [
        ("injected fault", AMBER_LINE, &history.faults_made),
        ("recovery", RED_LINE, &history.recoveries),
    ];
    let times = |envelope: &Envelope| -> Vec<f64> {
        envelope.ticks().map(|tick| history.time_s(tick)).collect()
    };
    let marks = kinds.into_iter().map(|(name, colour, envelope)| Curve {
        name: name.into(),
        ..Curve::marks(colour, times(envelope))
    });
    marks
        .filter(|curve| curve.abscissas().next().is_some())
        .collect()
}

/// Creates a panel over time with the marks.
fn over_time(history: &History, y: &str, scale: Scale, mut curves: Vec<Curve>) -> Panel {
    curves.extend(marks(history));
    Panel {
        scale,
        ..panel(TIME, y, curves)
    }
}

/// Draws the forces of slots on the target, with the names of their dampers.
pub(super) fn forces(history: &History, slots: &[(usize, &str)]) -> Figure {
    let curves = slots.iter().zip(SEVERAL).map(|((slot, damper), colour)| {
        let name = format!("slot {slot}: {damper}");
        curve(
            history,
            &name,
            colour,
            &history.places[*slot].target_n,
            1e-3,
        )
        .wide(6)
    });
    let panel = over_time(history, "force, kN", Scale::Linear, curves.collect());
    Figure {
        panels: vec![panel],
        height: 280,
        cursor_group: Some(TIME),
    }
}

/// Draws target minus host for a slot whose forces differ, next to the forces.
pub(super) fn difference(history: &History, slot: &Forces) -> Figure {
    let error = curve(history, "", DIFFERENCE, &slot.difference_n, 1.0);
    let forces = vec![
        curve(history, "host", COMPARED, &slot.host_n, 1e-3).wide(22),
        curve(history, "target", RESULT, &slot.target_n, 1e-3).wide(6),
    ];
    Figure {
        panels: vec![
            panel(TIME, "target minus host, N", vec![error.wide(6)]),
            over_time(history, "force, kN", Scale::Linear, forces),
        ],
        height: 280,
        cursor_group: Some(TIME),
    }
}

/// Draws the clock ticks per tick of the bank: histogram and course over time.
pub(super) fn clock_ticks(history: &History) -> Figure {
    let over = curve(history, "", RESULT, &history.clock_ticks, 1.0).wide(5);
    Figure {
        panels: vec![
            Panel {
                sides: true,
                ..panel("clock ticks", "ticks of the bank", vec![bars(history)])
            },
            over_time(history, "clock ticks", Scale::Linear, vec![over]),
        ],
        height: 340,
        cursor_group: Some(TIME),
    }
}

/// Returns the outline of the histogram.
fn bars(history: &History) -> Curve {
    let spread = &history.clock_spread;
    let (min, max) = (spread.min(), spread.max());
    let width = (max - min + 1).div_ceil(MAX_BARS).max(1);
    let mut points = Vec::new();
    let bars = (max - min) / width + 1;
    for bar in 0..bars {
        let from = min + bar * width;
        let count = spread.count_between(from, from + width - 1) as f64;
        // Each integer is at the middle of its bar.
        let (left, right) = (from as f64 - 0.5, (from + width) as f64 - 0.5);
        points.extend([(left, 0.0), (left, count), (right, count), (right, 0.0)]);
    }
    Curve::new("", RESULT, points).filled().wide(4)
}

/// Draws round-trip times over time, with a line at one step if the ticks were `paced`.
pub(super) fn round_trip(history: &History, paced: bool) -> Figure {
    let trips = curve(history, "round trip", RESULT, &history.round_trip_ns, 1e-6);
    let mut curves = vec![trips.wide(5)];
    if paced {
        let ends: Vec<f64> = curves[0].abscissas().collect();
        let step_ms = history.step_s() * 1e3;
        let step = [ends.first(), ends.last()].into_iter().flatten();
        let step = step.map(|time_s| (*time_s, step_ms));
        curves.push(Curve::new("one step", LIMIT, step).dashed());
    }
    Figure {
        panels: vec![over_time(history, "round trip, ms", Scale::Decades, curves)],
        height: 300,
        cursor_group: Some(TIME),
    }
}
