//! Figures of the demo page.

use super::results::{Bench, LOOP_AMPLITUDES_M, Ride};
use dashpot_report::page::{Figure, panel};
use dashpot_report::plot::curves::{Curve, ramp};
use dashpot_report::plot::loops;
use dashpot_report::plot::style::{COMPARED, DIFFERENCE, RESULT};

/// Window of the ride shown in detail (s).
pub(super) const WINDOW_S: (f64, f64) = (1.0, 2.0);

/// Creates a figure with one panel whose curves fill the width.
fn single(x: &str, y: &str, height: u32, curves: Vec<Curve>) -> Figure {
    Figure {
        panels: vec![panel(x, y, curves)],
        height,
        cursor_group: None,
    }
}

/// Creates a figure with two panels, see [`loops::panels`].
fn loop_figure(displacement: Vec<Curve>, velocity: Vec<Curve>) -> Figure {
    Figure {
        panels: loops::panels(displacement, velocity),
        height: 380,
        cursor_group: None,
    }
}

/// Pairs the forces of a ride with their times (s).
fn over_time<'a>(ride: &Ride, forces: &'a [f64]) -> impl Iterator<Item = (f64, f64)> + 'a {
    let step_s = ride.step_s;
    (0_u32..)
        .map(move |tick| f64::from(tick) * step_s)
        .zip(forces.iter().copied())
}

/// Draws the forces of reference and fixed step over the window.
pub(super) fn force(ride: &Ride) -> Figure {
    let shown = |forces| -> Vec<(f64, f64)> {
        over_time(ride, forces)
            .map(|(time, force)| (time, force * 1e-3))
            .filter(|(time, _)| (WINDOW_S.0..=WINDOW_S.1).contains(time))
            .collect()
    };
    let curves = vec![
        Curve::new("reference", COMPARED, shown(&ride.reference_n)).wide(22),
        Curve::new("fixed step", RESULT, shown(&ride.fixed_step_n)).wide(6),
    ];
    single("time, s", "computed force, kN", 340, curves)
}

/// Draws the error of the fixed step over the whole ride.
pub(super) fn error(ride: &Ride) -> Figure {
    let errors = over_time(ride, &ride.fixed_step_n)
        .zip(&ride.reference_n)
        .map(|((time, force), reference)| (time, force - reference));
    let curve = Curve::new("", DIFFERENCE, errors).wide(4);
    single("time, s", "error, N", 240, vec![curve])
}

/// Draws force over displacement and velocity along the whole ride.
pub(super) fn ride_loops(ride: &Ride) -> Figure {
    let x = &ride.displacements_m;
    let forces = ride.fixed_step_n.iter().map(|force| force * 1e-3);
    let displacement = x.iter().map(|x| x * 1e3).zip(forces.clone());
    let velocity = x
        .windows(2)
        .map(|pair| (pair[1] - pair[0]) / ride.step_s)
        .zip(forces.skip(1));
    let thin = |points: Vec<(f64, f64)>| vec![Curve::new("", RESULT, points).wide(3)];
    loop_figure(thin(displacement.collect()), thin(velocity.collect()))
}

/// Draws settled loops of harmonic motions with increasing amplitude.
pub(super) fn bench_loops(bench: &Bench) -> Figure {
    let colours = ramp(bench.loops.len());
    let curves = bench.loops.iter().zip(colours).zip(LOOP_AMPLITUDES_M);
    let (displacement, velocity) = curves
        .map(|((cycle, colour), amplitude_m)| {
            loops::of_cycle(&format!("{} mm", amplitude_m * 1e3), colour, cycle)
        })
        .unzip();
    loop_figure(displacement, velocity)
}

/// Draws force over constant velocity for every damper.
pub(super) fn characteristics(benches: &[Bench]) -> Figure {
    let curves = benches
        .iter()
        .zip([COMPARED, RESULT])
        .map(|(bench, colour)| {
            let points = (-300..=300).map(|i| {
                let velocity = 0.5e-3 * f64::from(i);
                (velocity, bench.characteristic.force_n(velocity) * 1e-3)
            });
            Curve::new(bench.damper, colour, points).wide(10)
        });
    single("velocity, m/s", "computed force, kN", 360, curves.collect())
}
