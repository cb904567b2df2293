//! Tilt of a rail profile: upright and laid, new and worn.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;

use dashpot_files::profile::{RailTilt, TiltBasis, rail_tilt};
use dashpot_rail::profile::measured::{self, Options};
use dashpot_rail::profile::{Body, Profile, uic60};

/// Wear of a head UIC 60, in the axes of the upright rail, mm.
struct Wear {
    /// Wear of the gauge side at 14 mm depth, and the angle of the worn face against the top, degrees.
    side_mm: f64,
    face_deg: f64,
    /// Wear of the top, the slope of the worn top (positive: deeper on the field side) and its radius.
    top_mm: f64,
    top_slope: f64,
    top_radius_mm: f64,
}

const NEW: Wear = Wear {
    side_mm: -10.0,
    face_deg: 70.0,
    top_mm: -10.0,
    top_slope: 0.0,
    top_radius_mm: 300.0,
};

/// What a profile gauge reads.
struct Gauge {
    tilt_rad: f64,
    spacing_mm: f64,
    noise_mm: f64,
    /// Depths to which the gauge and the field side are measured, mm.
    depths_mm: [f64; 2],
}

/// The points of a head in the axes of a profile, mm.
fn head(wear: &Wear, gauge: &Gauge, random: &mut fastrand::Rng) -> Vec<[f64; 2]> {
    let face = wear.face_deg.to_radians().tan();
    let top = |y: f64| wear.top_mm + wear.top_slope * y + y * y / (2.0 * wear.top_radius_mm);
    let (sin, cos) = gauge.tilt_rad.sin_cos();
    let mut noise = || gauge.noise_mm * (0..12).map(|_| random.f64() - 0.5).sum::<f64>();
    let steps = (60.0 / gauge.spacing_mm) as i32;
    (-steps..=steps)
        .filter_map(|step| {
            let [y, z] = uic60::position_mm(gauge.spacing_mm * f64::from(step.abs()));
            let y = f64::from(step.signum()) * y;
            let y = y.max(-36.0 + wear.side_mm - (z - 14.0) / face);
            let z = z.max(top(y));
            let [y, z] = [y * cos + z * sin, z * cos - y * sin];
            let end = gauge.depths_mm[usize::from(step > 0)];
            (z < end).then(|| [y + noise(), z + noise()])
        })
        .collect()
}

/// Reads a profile; `None` if the reader refuses it, as it does where noise folds an upright side.
fn read(points_mm: &[[f64; 2]]) -> Option<Profile> {
    let mut text = String::new();
    for [y, z] in points_mm {
        writeln!(text, "{y:.2} {z:.2}").unwrap();
    }
    let options = Options::default();
    let read = measured::parse("rail.csv", &text, Body::Rail, &options).ok()?;
    Some(read.0)
}

fn tilt(points_mm: &[[f64; 2]]) -> RailTilt {
    rail_tilt(&read(points_mm).unwrap()).unwrap()
}

const INCLINATIONS: [f64; 3] = [0.0, 1.0 / 40.0, 1.0 / 20.0];

#[test]
fn a_new_head_has_the_tilt_to_which_it_was_turned() {
    let mut random = fastrand::Rng::with_seed(1);
    for inclination in INCLINATIONS {
        let gauge = Gauge {
            tilt_rad: f64::atan(inclination),
            spacing_mm: 0.5,
            noise_mm: 0.0,
            depths_mm: [36.0, 30.0],
        };
        let found = tilt(&head(&NEW, &gauge, &mut random));
        let off_rad = found.tilt_rad - gauge.tilt_rad;
        assert!(off_rad.abs() < 2e-3, "{inclination}: {found:?}");
        assert!(found.uncertainty_rad < 0.012, "{found:?}");
        for laid in INCLINATIONS {
            // A rail at 1:40 is not yet a rail laid at 1:20; the halves between them are not tested.
            if inclination == 0.0 || laid == inclination || laid == 0.0 {
                assert_eq!(
                    found.contains(laid),
                    laid != 0.0 && inclination != 0.0,
                    "{found:?}"
                );
            }
        }
        assert!(found.contains(0.025) == (inclination > 0.0));
    }
    // The built-in profile, and both sides of it.
    let built_in = rail_tilt(&uic60::profile()).unwrap();
    assert_eq!(built_in.basis, TiltBasis::BothSides);
    assert!(built_in.tilt_rad.abs() < 1e-4, "{built_in:?}");
}

#[test]
fn both_sides_show_the_tilt_of_a_head_whose_sides_are_not_1_in_20() {
    // A head with sides of 1:30, turned by 1:40. With sides of 1:40, its gauge side would be upright, and the reader
    // removes upright sides.
    let (sin, cos) = f64::atan(0.025).sin_cos();
    let side_rad = FRAC_PI_2 - 1.0 / 30.0;
    let corner_rad = f64::asin(26.0 / 254.0);
    let corner_end = 14.0 * (side_rad - corner_rad);
    let half = (0..=120).map(|i| {
        let arc = 0.5 * f64::from(i);
        let start = [26.0, 254.0 * (1.0 - corner_rad.cos())];
        if arc < 26.0 {
            return [arc, 254.0 * (1.0 - f64::asin(arc / 254.0).cos())];
        }
        let angle = (corner_rad + (arc - 26.0) / 14.0).min(side_rad);
        let beyond = (arc - 26.0 - corner_end).max(0.0);
        [
            start[0] + 14.0 * (angle.sin() - corner_rad.sin()) + beyond * side_rad.cos(),
            start[1] + 14.0 * (corner_rad.cos() - angle.cos()) + beyond * side_rad.sin(),
        ]
    });
    let half: Vec<[f64; 2]> = half.filter(|point| point[1] < 34.0).collect();
    let left = half[1..].iter().rev().map(|[y, z]| [-y, *z]);
    let upright: Vec<[f64; 2]> = left.chain(half.iter().copied()).collect();
    let turned: Vec<[f64; 2]> = upright
        .iter()
        .map(|[y, z]| [y * cos + z * sin, z * cos - y * sin])
        .collect();
    let [found, upright] = [turned, upright].map(|points| tilt(&points));
    assert!((found.tilt_rad - 0.025).abs() < 5e-3, "{found:?}");
    assert_eq!(upright.basis, TiltBasis::BothSides);
    assert!(upright.tilt_rad.abs() < 1e-3, "{upright:?}");
}

/// Reads a family of worn heads, measured to at least `min_depth_mm` on both sides. Returns the share that is misjudged
/// for an inclination of 1:40, and the error of the tilt in units of its stated uncertainty, RMS.
fn misjudged(count: usize, min_depth_mm: f64) -> [f64; 2] {
    let mut random = fastrand::Rng::with_seed(11);
    let (mut wrong, mut squares, mut refused) = (0, 0.0, 0);
    for k in 0..count {
        let mut between = |low: f64, high: f64| low + (high - low) * random.f64();
        let wear = Wear {
            side_mm: between(0.0, 6.0),
            face_deg: between(62.0, 80.0),
            top_mm: between(0.0, 5.0),
            top_slope: between(-0.03, 0.03),
            top_radius_mm: between(120.0, 600.0),
        };
        let gauge = Gauge {
            tilt_rad: INCLINATIONS[k % 3].atan(),
            spacing_mm: between(0.2, 0.6),
            noise_mm: 0.02,
            depths_mm: [between(min_depth_mm, 36.0), between(min_depth_mm, 36.0)],
        };
        let points = head(&wear, &gauge, &mut random);
        let Some(rail) = read(&points) else {
            refused += 1;
            continue;
        };
        let found = rail_tilt(&rail).unwrap();
        let is_wrong = found.contains(0.025) != (k % 3 > 0);
        wrong += usize::from(is_wrong);
        squares += ((found.tilt_rad - gauge.tilt_rad) / found.uncertainty_rad).powi(2);
    }
    println!("refused: {refused} of {count}");
    let per_head = 1.0 / (count - refused) as f64;
    [wrong as f64 * per_head, (squares * per_head).sqrt()]
}

#[test]
fn worn_heads_are_rarely_misjudged() {
    let [share, relative_error] = misjudged(6000, 18.0);
    println!("misjudged: {share}, error / uncertainty: {relative_error}");
    // Heads that are measured down to 24 mm or more.
    let [deep_share, deep_error] = misjudged(3000, 24.0);
    println!("misjudged: {deep_share}, error / uncertainty: {deep_error}");
    assert!(share < 0.01, "{share}");
    assert!(relative_error < 1.5, "{relative_error}");
    assert!(deep_share < 2e-3, "{deep_share}");
    assert!(deep_error < 1.5, "{deep_error}");
}
