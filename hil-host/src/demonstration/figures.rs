//! Figures of the page.

use plotters::prelude::SeriesLabelPosition;
use plotters::style::RGBColor;

use super::{Bench, LOOP_AMPLITUDES_M, Ride};
use crate::failure::Outcome;
use crate::plot::curves::{Curve, Panel, ramp, sheet};
use crate::plot::style::{BLUE_LINE, RED_LINE};

const PALE: RGBColor = RGBColor(160, 168, 176);

/// The window of the ride shown large (s).
pub(super) const WINDOW_S: (f64, f64) = (1.0, 2.0);

fn panel(x: &str, y: &str, legend: Option<SeriesLabelPosition>, curves: Vec<Curve>) -> Panel {
    Panel {
        title: String::new(),
        x_label: x.into(),
        y_label: y.into(),
        legend,
        sides: false,
        curves,
    }
}

/// Forces of a ride with their times (s).
fn over_time<'a>(ride: &Ride, forces: &'a [f64]) -> impl Iterator<Item = (f64, f64)> + 'a {
    let step_s = ride.step_s;
    (0_u32..)
        .map(move |tick| f64::from(tick) * step_s)
        .zip(forces.iter().copied())
}

/// Two panels side by side: force (kN) over displacement (mm) and over velocity (m/s). The legend, if
/// there is one, stands in the second, whose upper left is free.
fn loops(
    displacement: Vec<Curve>,
    velocity: Vec<Curve>,
    legend: Option<SeriesLabelPosition>,
) -> Outcome<String> {
    let panel = |x, legend, curves| Panel {
        sides: true,
        ..panel(x, "force, kN", legend, curves)
    };
    sheet(
        1040,
        400,
        &[
            panel("displacement, mm", None, displacement),
            panel("velocity, m/s", legend, velocity),
        ],
    )
}

/// Force of reference and fixed step over the window.
pub(super) fn force(ride: &Ride) -> Outcome<String> {
    let shown = |forces| -> Vec<(f64, f64)> {
        over_time(ride, forces)
            .map(|(time, force)| (time, force * 1e-3))
            .filter(|(time, _)| (WINDOW_S.0..=WINDOW_S.1).contains(time))
            .collect()
    };
    let curves = vec![
        Curve::new("reference", PALE, shown(&ride.reference_n)).wide(22),
        Curve::new(
            "fixed step, 1 kHz, f32",
            BLUE_LINE,
            shown(&ride.fixed_step_n),
        )
        .wide(6),
    ];
    let legend = Some(SeriesLabelPosition::UpperRight);
    sheet(1040, 360, &[panel("time, s", "force, kN", legend, curves)])
}

/// Error of the fixed step over the whole ride.
pub(super) fn error(ride: &Ride) -> Outcome<String> {
    let errors = over_time(ride, &ride.fixed_step_n)
        .zip(&ride.reference_n)
        .map(|((time, force), reference)| (time, force - reference));
    let curve = Curve::new("error", RED_LINE, errors).wide(4);
    sheet(
        1040,
        260,
        &[panel("time, s", "error, N", None, vec![curve])],
    )
}

/// Force over displacement and velocity along the whole ride.
pub(super) fn ride_loops(ride: &Ride) -> Outcome<String> {
    let x = &ride.displacements_m;
    let forces = ride.fixed_step_n.iter().map(|force| force * 1e-3);
    let displacement = x.iter().map(|x| x * 1e3).zip(forces.clone());
    let velocity = x
        .windows(2)
        .map(|pair| (pair[1] - pair[0]) / ride.step_s)
        .zip(forces.skip(1));
    let thin = |points: Vec<(f64, f64)>| vec![Curve::new("ride", BLUE_LINE, points).wide(3)];
    loops(thin(displacement.collect()), thin(velocity.collect()), None)
}

/// Settled loops of harmonic motions of rising amplitude.
pub(super) fn bench_loops(bench: &Bench) -> Outcome<String> {
    let colours = ramp(bench.loops.len());
    let (mut displacement, mut velocity) = (Vec::new(), Vec::new());
    for ((cycle, colour), amplitude) in bench.loops.iter().zip(colours).zip(LOOP_AMPLITUDES_M) {
        let name = format!("{} mm", amplitude * 1e3);
        let (x, forces) = (&cycle.displacements_m, &cycle.forces_n);
        let ticks = x.len();
        let at = |tick: usize| (x[tick % ticks], forces[tick % ticks] * 1e-3);
        displacement.push(Curve::new(
            &name,
            colour,
            (0..=ticks).map(|tick| (at(tick).0 * 1e3, at(tick).1)),
        ));
        let speed = |tick: usize| (at(tick + 1).0 - at(tick + ticks - 1).0) / (2.0 * cycle.step_s);
        velocity.push(Curve::new(
            &name,
            colour,
            (0..=ticks).map(|tick| (speed(tick), at(tick).1)),
        ));
    }
    let legend = Some(SeriesLabelPosition::UpperLeft);
    loops(displacement, velocity, legend)
}

/// Force over constant velocity of every damper.
pub(super) fn characteristics(benches: &[Bench]) -> Outcome<String> {
    let curves = benches
        .iter()
        .zip([PALE, BLUE_LINE])
        .map(|(bench, colour)| {
            let points = (-300..=300).map(|i| {
                let velocity = 0.5e-3 * f64::from(i);
                (velocity, bench.characteristic.force_n(velocity) * 1e-3)
            });
            Curve::new(bench.damper, colour, points).wide(10)
        });
    let legend = Some(SeriesLabelPosition::UpperLeft);
    sheet(
        1040,
        400,
        &[panel(
            "velocity, m/s",
            "force, kN",
            legend,
            curves.collect(),
        )],
    )
}
