//! Figures of a sheet: loops, forces over velocity and over temperature.

use std::collections::BTreeMap;

use plotters::style::RGBColor;

use super::TestReport;
use crate::page::{Figure, panel};
use crate::plot::curves::{Curve, ramp};
use crate::plot::loops;
use crate::plot::sheet::Panel;
use crate::plot::style::{FIRST, LIMIT, SECOND};
use dashpot_files::harmonic::Harmonic;
use dashpot_files::sheet::Index;
use dashpot_files::study::format_number;
use dashpot_testbench::bench_test::Cycle;

/// Height of a panel (pixels).
const HEIGHT: u32 = 300;

/// Number of samples drawn per loop.
const SAMPLES: usize = 1200;

/// Maximum forces with name and colour.
const FORCES: [(Index, &str, RGBColor); 2] = [
    (Index::MaxExtensionForceN, "extension", FIRST),
    (Index::MaxCompressionForceN, "compression", SECOND),
];

/// Draws the loops of all tests.
pub(super) fn loops_of(tests: &[TestReport]) -> Figure {
    let curves = tests.iter().zip(ramp(tests.len()));
    let (displacement, velocity) = curves
        .map(|(test, colour)| loops::of_cycle(&test.name, colour, &thinned(&test.cycle)))
        .unzip();
    figure(loops::panels(displacement, velocity))
}

/// Returns the cycle reduced to the number of samples drawn.
fn thinned(cycle: &Cycle) -> Cycle {
    let ticks = cycle.forces_n.len();
    let at = |values: &[f64]| {
        let sample = |i: usize| values[(i * ticks).div_ceil(SAMPLES).clamp(1, ticks) - 1];
        (1..=SAMPLES).map(sample).collect()
    };
    Cycle {
        displacements_m: at(&cycle.displacements_m),
        forces_n: at(&cycle.forces_n),
        ..*cycle
    }
}

/// Returns the value of an index (kN), and half of its interval.
fn force_kn(test: &TestReport, index: Index) -> (f64, Option<f64>) {
    let of = |values: &BTreeMap<Index, Option<f64>>| {
        let value = values.get(&index).copied().flatten();
        value.map(|value| value * 1e-3)
    };
    let half_width = test.measured.as_ref();
    let half_width = half_width.and_then(|measured| of(&measured.half_widths));
    (of(&test.indices).unwrap_or(0.0), half_width)
}

/// Draws maximum forces over the number of the test, each with the limits of its own test, one panel each for extension
/// and compression.
pub(super) fn over_tests(tests: &[TestReport]) -> Figure {
    let numbered = || (1..).map(f64::from).zip(tests);
    let panels = FORCES.map(|(index, name, colour)| {
        let limits = numbered().flat_map(|(number, test)| {
            let of_index = test.limits.iter().filter(|limit| limit.index == index);
            of_index.map(move |limit| {
                // On a side without a limit, the bar ends at the point.
                let end = |end: Option<f64>| end.map_or(force_kn(test, index).0, |end| end * 1e-3);
                (number, end(limit.least), end(limit.most))
            })
        });
        let limits: Vec<(f64, f64, f64)> = limits.collect();
        let intervals = numbered().filter_map(|(number, test)| {
            let (force, half_width) = force_kn(test, index);
            let half_width = half_width?;
            Some((number, force - half_width, force + half_width))
        });
        let intervals: Vec<(f64, f64, f64)> = intervals.collect();
        let points = numbered().map(|(number, test)| (number, force_kn(test, index).0));
        let mut curves = Vec::new();
        if !limits.is_empty() {
            curves.push(Curve::bars("limits of the test", LIMIT, limits).wide(16));
        }
        if !intervals.is_empty() {
            curves.push(Curve::bars("", colour, intervals));
        }
        curves.push(Curve::new(name, colour, points).dotted());
        keeping_off_the_sides(panel(
            "number of the test",
            &format!("maximum force in {name}, kN"),
            curves,
        ))
    });
    figure(panels.into())
}

/// Draws maximum forces over peak velocity.
pub(super) fn over_speed(tests: &[TestReport]) -> Figure {
    let curves = FORCES.map(|(index, name, colour)| {
        let point = |test: &TestReport| (test.peak_velocity_m_per_s, force_kn(test, index).0);
        let mut points: Vec<(f64, f64)> = tests.iter().map(point).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Curve::new(name, colour, points).dotted()
    });
    figure(vec![keeping_off_the_sides(panel(
        "peak velocity, m/s",
        "maximum force, kN",
        curves.into(),
    ))])
}

/// Draws maximum forces over oil temperature for each motion tested at several temperatures; `None` if there is no such
/// motion.
pub(super) fn over_temperature(tests: &[TestReport]) -> Option<Figure> {
    let mut motions: Vec<(Harmonic, Vec<&TestReport>)> = Vec::new();
    for test in tests {
        let motion = test.cycle.motion;
        match motions
            .iter_mut()
            .find(|(other, _)| is_same(other, &motion))
        {
            Some((_, same)) => same.push(test),
            None => motions.push((motion, vec![test])),
        }
    }
    for (_, tests) in &mut motions {
        tests.retain(|test| test.temperature_c.is_some());
        tests.sort_by(|a, b| {
            let [a, b] = [a, b].map(|test| test.temperature_c.unwrap_or(0.0));
            a.total_cmp(&b)
        });
        tests.dedup_by_key(|test| test.temperature_c);
    }
    motions.retain(|(_, tests)| tests.len() > 1);
    if motions.is_empty() {
        return None;
    }
    let panels = FORCES.map(|(index, name, _)| {
        let curves = motions.iter().zip(ramp(motions.len()));
        let curves = curves.flat_map(|((motion, tests), colour)| {
            let points = tests
                .iter()
                .filter_map(|test| Some((test.temperature_c?, force_kn(test, index).0)));
            let points: Vec<(f64, f64)> = points.collect();
            let motion = format!(
                "±{} mm, {} m/s",
                format_number(motion.amplitude_m * 1e3),
                format_number((motion.peak_velocity_m_per_s() * 1e4).round() * 1e-4)
            );
            [
                Curve::new(motion, colour, points.clone()),
                Curve::new("", colour, points).dotted(),
            ]
        });
        let y = format!("maximum force in {name}, kN");
        Panel {
            keeps_to_values: true,
            ..keeping_off_the_sides(panel("oil temperature, °C", &y, curves.collect()))
        }
    });
    Some(figure(panels.into()))
}

/// True for motions that differ by at most 5 %, as measured ones of the same test do.
fn is_same(a: &Harmonic, b: &Harmonic) -> bool {
    let near = |a: f64, b: f64| (a / b - 1.0).abs() <= 0.05;
    near(a.amplitude_m, b.amplitude_m) && near(a.frequency_hz, b.frequency_hz)
}

fn keeping_off_the_sides(panel: Panel) -> Panel {
    Panel {
        sides: true,
        ..panel
    }
}

fn figure(panels: Vec<Panel>) -> Figure {
    Figure {
        panels,
        height: HEIGHT,
        cursor_group: None,
    }
}
