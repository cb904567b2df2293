//! Inputs of ORVD's runs that Dashpot provides: both profiles and the irregularity.

use std::fmt::Write;

use dashpot::document;
use dashpot_rail::profile::{s1002, uic60};
use dashpot_rail::track::{Generation, Seeds, Spectrum};

use crate::FOLDER;

/// Ideal track before the irregularity begins, m: all wheelsets start on it, the first one at 9.1 m.
const START_M: f64 = 20.0;
/// Last distance of the irregularity, m; at 120 km/h the first wheelset reaches 676 m.
const END_M: f64 = 700.0;
/// Distance between rows, m.
const SPACING_M: f64 = 0.25;

/// Alignment and vertical profile of class 6, wavelengths of 3 to 80 m, with a ramp of 50 m.
fn irregularity() -> String {
    let generation = Generation::new(Spectrum::fra(6).unwrap())
        .with_seeds(Seeds::from(1))
        .with_length_m(END_M - START_M)
        .with_ramp_m(50.0)
        .with_spacing_m(Some(SPACING_M));
    let generated = generation.irregularity().unwrap();
    let mut text = "distance_m,vertical_mm,lateral_mm\n".to_owned();
    for row in 0..=(END_M / SPACING_M) as usize {
        let distance_m = SPACING_M * row as f64;
        let [channels, _] = generated.channels(distance_m - START_M);
        let [vertical, lateral] = if distance_m > START_M && distance_m < END_M {
            [channels.vertical, channels.lateral].map(|value_m| 1e3 * value_m)
        } else {
            [0.0; 2]
        };
        let _ = writeln!(text, "{distance_m:.2},{vertical:.6},{lateral:.6}");
    }
    text
}

/// Section of S1002 that ORVD uses, at intervals of 0.1 mm.
fn wheel() -> String {
    columns((-645..=345).map(|tenth_mm| {
        let y_mm = 0.1 * f64::from(tenth_mm);
        [y_mm, s1002::depth_mm(y_mm)]
    }))
}

/// Head of UIC 60 down to 33 mm, at intervals of 0.1 mm along its outline.
fn rail() -> String {
    let half: Vec<[f64; 2]> = (0..)
        .map(|tenth_mm| uic60::position_mm(0.1 * f64::from(tenth_mm)))
        .take_while(|[_, z_mm]| *z_mm < 33.0)
        .collect();
    let left = half[1..].iter().rev().map(|[y_mm, z_mm]| [-y_mm, *z_mm]);
    columns(left.chain(half.iter().copied()))
}

fn columns(points_mm: impl Iterator<Item = [f64; 2]>) -> String {
    let mut text = "# y to the field side, z down, mm\n".to_owned();
    for [y_mm, z_mm] in points_mm {
        let _ = writeln!(text, "{y_mm:.6} {z_mm:.6}");
    }
    text
}

#[test]
fn the_inputs_of_the_other_code_are_ours() {
    let file = |name: &str| format!("{FOLDER}/{name}");
    document::compare(&file("irregularity.csv"), &irregularity());
    document::compare(&file("wheel.txt"), &wheel());
    document::compare(&file("rail.txt"), &rail());
}
