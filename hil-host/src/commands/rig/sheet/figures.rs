//! Figures of a sheet: loops, forces over velocity and over temperature.

use plotters::style::RGBColor;

use dashpot_files::harmonic::Harmonic;
use dashpot_files::sheet::Index;
use dashpot_files::study::format_number;
use dashpot_report::page::{Figure, panel};
use dashpot_report::plot::curves::{Curve, ramp};
use dashpot_report::plot::loops;
use dashpot_report::plot::sheet::Panel;
use dashpot_report::plot::style::{FIRST, LIMIT, SECOND};
use dashpot_testbench::bench_sheet::{Tested, index_value};
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
pub(super) fn loops_of(tested: &[Tested<'_>]) -> Figure {
    let curves = tested.iter().zip(ramp(tested.len()));
    let (displacement, velocity) = curves
        .map(|(tested, colour)| loops::of_cycle(&tested.test.name, colour, &thinned(&tested.cycle)))
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

/// Draws maximum forces over peak velocity with their limits, one panel each for extension and compression.
pub(super) fn over_speed(tested: &[Tested<'_>]) -> Figure {
    let at = |tested: &Tested<'_>, index: Index| {
        let velocity = tested.cycle.motion.peak_velocity_m_per_s();
        (
            velocity,
            index_value(&tested.cycle, index).unwrap_or(0.0) * 1e-3,
        )
    };
    let panels = FORCES.map(|(index, name, colour)| {
        let mut points: Vec<(f64, f64)> = tested.iter().map(|tested| at(tested, index)).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let limits: Vec<(f64, f64, f64)> = tested
            .iter()
            .flat_map(|tested| {
                let of_index = tested.test.limits.iter().filter(|l| l.index == index);
                of_index.map(|limit| {
                    let (velocity, force) = at(tested, index);
                    // On a side without a limit, the bar ends at the point.
                    let end = |end: Option<f64>| end.map_or(force, |end| end * 1e-3);
                    (velocity, end(limit.min), end(limit.max))
                })
            })
            .collect();
        let mut curves = vec![Curve::new(name, colour, points).dotted()];
        if !limits.is_empty() {
            curves.insert(0, Curve::bars("limits", LIMIT, limits).wide(16));
        }
        keeping_off_the_sides(panel(
            "peak velocity, m/s",
            &format!("maximum force in {name}, kN"),
            curves,
        ))
    });
    figure(panels.into())
}

/// Draws maximum forces over oil temperature for each motion tested at several temperatures; `None` if there is no such
/// motion.
pub(super) fn over_temperature(tested: &[Tested<'_>]) -> Option<Figure> {
    let mut motions: Vec<(Harmonic, Vec<&Tested<'_>>)> = Vec::new();
    for tested in tested {
        let motion = tested.cycle.motion;
        match motions.iter_mut().find(|(other, _)| *other == motion) {
            Some((_, same)) => same.push(tested),
            None => motions.push((motion, vec![tested])),
        }
    }
    for (_, tests) in &mut motions {
        tests.retain(|tested| tested.temperature_c.is_some());
        tests.sort_by(|a, b| {
            let [a, b] = [a, b].map(|tested| tested.temperature_c.unwrap_or(0.0));
            a.total_cmp(&b)
        });
        tests.dedup_by_key(|tested| tested.temperature_c);
    }
    motions.retain(|(_, tests)| tests.len() > 1);
    if motions.is_empty() {
        return None;
    }
    let panels = FORCES.map(|(index, name, _)| {
        let curves = motions.iter().zip(ramp(motions.len()));
        let curves = curves.flat_map(|((motion, tests), colour)| {
            let points = tests.iter().filter_map(|tested| {
                let force = index_value(&tested.cycle, index)?;
                Some((tested.temperature_c?, force * 1e-3))
            });
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
