//! Several patches on one wheel: positions, loads, and continuity where patches appear or vanish.

use std::sync::Arc;

use dashpot_rail::contact::{
    ContactGeometry, Hertz, Installation, Motion, Pair, Steel, WheelsetContact, WheelsetForces,
};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::profile::{Profile, s1002, uic60};

use crate::common::{LEVEL, at_height_under_load, rolling};

fn contact(wheel: Profile, rail: &Profile) -> WheelsetContact<KalkerBook, ContactGeometry> {
    let pair = Pair::new(wheel, rail, Installation::default()).unwrap();
    let geometry = Arc::new(ContactGeometry::new(pair, Steel::default()).unwrap());
    WheelsetContact::new(geometry, KalkerBook::new(), Friction::default()).unwrap()
}

/// A profile with `change_mm` added to its depth at each position, mm.
fn changed(profile: &Profile, name: &str, change_mm: impl Fn(f64) -> f64) -> Profile {
    let points: Vec<[f64; 2]> = profile
        .points()
        .iter()
        .step_by(3)
        .map(|p| [p.y_m, p.z_m + 1e-3 * change_mm(1e3 * p.y_m)])
        .collect();
    Profile::through(name, &points, 0.0).unwrap()
}

/// A hump of `height_mm` at `at_mm`, which raises the surface of a rail.
fn hump(y_mm: f64, at_mm: f64, height_mm: f64) -> f64 {
    -height_mm * (-((y_mm - at_mm) / 3.0).powi(2)).exp()
}

#[test]
fn three_separate_contacts_carry_hertz_loads_and_press_each_other_down() {
    // A flat rail with three humps, under a wheel that is cylindrical outside its root.
    let wheel = changed(&s1002::profile(), "cylinder", |y| {
        if y > -25.0 {
            -s1002::depth_mm(y)
        } else {
            -s1002::depth_mm(-25.0)
        }
    });
    let rail = changed(&uic60::profile(), "humps", |y| {
        let flat = if y.abs() < 24.0 {
            0.6 - depth_of_uic60_mm(y)
        } else {
            0.6 - depth_of_uic60_mm(24.0)
        };
        flat + hump(y, -14.0, 1.0) + hump(y, 2.0, 1.0) + hump(y, 17.0, 1.0)
    });
    let installation = Installation::default().with_inclination(0.0);
    let pair = Pair::new(wheel, &rail, installation).unwrap();
    let geometry = Arc::new(ContactGeometry::new(pair, Steel::default()).unwrap());
    let contact = WheelsetContact::new(geometry, KalkerBook::new(), Friction::default()).unwrap();
    let motion = at_height_under_load(&contact, &rolling(20.0), 200e3);
    let forces = contact.forces(&motion, &LEVEL);
    let loaded: Vec<_> = forces.wheels[1].loaded_patches().collect();
    assert_eq!(loaded.len(), 3, "{loaded:?}");
    let steel = Steel::default();
    let elasticity =
        (1.0 - steel.poisson_ratio.powi(2)) / (std::f64::consts::PI * steel.young_modulus_pa);
    for patch in &loaded {
        // A hump exp(-(y/3)^2) of 1 mm height has a curvature of 2/9 per mm at its top.
        let hertz = Hertz::new(&steel, 1.0 / patch.rolling_radius_m, 2.0 / 9.0 * 1e3);
        // The other patches press both surfaces down by as much as point loads do (Boussinesq).
        let pressed_m: f64 = loaded
            .iter()
            .map(|other| {
                (
                    other.load_n,
                    (other.position_m[1] - patch.position_m[1]).abs(),
                )
            })
            .filter(|(_, distance_m)| *distance_m > 0.0)
            .map(|(load_n, distance_m)| 2.0 * elasticity * load_n / distance_m)
            .sum();
        let expected = hertz.load_n(patch.penetration_m - pressed_m);
        assert!(
            (patch.load_n / expected - 1.0).abs() < 0.1,
            "{patch:?} {expected}"
        );
        assert!(patch.load_n > 20e3, "{patch:?}");
    }
    let rest: f64 = loaded.iter().map(|patch| patch.load_n).sum();
    assert!((rest - 100e3).abs() < 1e3, "{rest}");
    // Four patches are evaluated in parallel; the third patch of a wheel is evaluated after them.
    let mut one_by_one = WheelsetForces::default();
    contact.update_with_derivatives(&motion, &LEVEL, &mut one_by_one);
    for k in 0..3 {
        let off = forces.wheels[1].force_n[k] - one_by_one.wheels[1].force_n[k];
        assert!(off.abs() < 1e-6 * 100e3, "{k}: {off}");
    }
}

fn depth_of_uic60_mm(y_mm: f64) -> f64 {
    1e3 * uic60::profile().at(y_mm * 1e-3).z_m
}

#[test]
fn a_chamfer_on_the_field_side_is_not_a_flange() {
    let plain = Pair::standard(Installation::default()).unwrap();
    let chamfered = changed(&s1002::profile(), "chamfer", |y| -1.5 * (y - 54.0).max(0.0));
    let steepest = chamfered
        .points()
        .iter()
        .map(|p| p.angle_rad)
        .fold(0.0, f64::min);
    assert!(chamfered.at(58e-3).angle_rad < -50_f64.to_radians() && steepest < -1.0);
    let pair = Pair::new(chamfered, &uic60::profile(), Installation::default()).unwrap();
    assert!((pair.tread_end_m() - plain.tread_end_m()).abs() < 1e-4);
    assert!((pair.steepest_flange_m() - plain.steepest_flange_m()).abs() < 1e-3);
}

#[test]
fn patches_of_worn_profiles_appear_and_vanish_without_a_jump() {
    let worn_wheel = changed(&s1002::profile(), "hollow", |y| hump(y, 4.0, 0.25) * 0.8);
    let worn_rail = changed(&uic60::profile(), "worn", |y| {
        hump(y, -6.0, 0.12) + hump(y, 9.0, 0.15) - hump(y, -18.0, 0.2)
    });
    let contact = contact(worn_wheel, &worn_rail);
    let (mut worst, mut most) = (0.0_f64, 0);
    let mut last: Option<[f64; 3]> = None;
    // Shifts in steps of 5 um, at the height of a wheel load of about 100 kN.
    for step in 0..2400 {
        let motion = Motion {
            lateral_m: -6e-3 + 5e-6 * f64::from(step),
            vertical_m: 0.05e-3,
            yaw_rad: 2e-3,
            ..rolling(20.0)
        };
        let wheel = contact.forces(&motion, &LEVEL).wheels[1];
        most = most.max(
            wheel
                .loaded_patches()
                .filter(|patch| patch.load_n > 1e3)
                .count(),
        );
        let load: f64 = wheel.loaded_patches().map(|patch| patch.load_n).sum();
        if load > 400e3 {
            break;
        }
        if let Some(last) = last {
            let jump: f64 = (0..3).map(|k| (wheel.force_n[k] - last[k]).powi(2)).sum();
            worst = worst.max(jump.sqrt() / (load + 20e3));
        }
        last = Some(wheel.force_n);
    }
    assert!(most >= 2, "{most} patches at most");
    assert!(worst < 0.05, "{worst} of the load for 5 um");
}
