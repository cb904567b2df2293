//! Equilibrium, symmetry and conicity of a wheelset under load.

use std::sync::Arc;

use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel};
use dashpot_rail::profile::{Profile, s1002, uic60};
use dashpot_study::loaded_wheelset::{LoadedShift, LoadedWheelset, LoadedWheelsetError, Running};
use dashpot_study::wheelset_geometry::{Conicity, WheelsetGeometry};

fn side(wheel: Profile, rail: &Profile) -> Arc<ContactGeometry> {
    let pair = Pair::new(wheel, rail, Installation::default()).unwrap();
    Arc::new(ContactGeometry::new(pair, Steel::default()).unwrap())
}

/// Profile through points in mm.
fn through(name: &str, range_mm: [f64; 2], depth_mm: impl Fn(f64) -> f64) -> Profile {
    let count = ((range_mm[1] - range_mm[0]) / 0.2) as i32;
    let points: Vec<[f64; 2]> = (0..=count)
        .map(|i| range_mm[0] + (range_mm[1] - range_mm[0]) * f64::from(i) / f64::from(count))
        .map(|y| [1e-3 * y, 1e-3 * depth_mm(y)])
        .collect();
    Profile::through(name, &points, 0.0).unwrap()
}

/// A tread with a cone of 0.05 and the flange of S1002.
fn cone() -> Profile {
    let inner = s1002::depth_mm(-30.0) - 1.5;
    through("cone", [-68.0, 60.0], move |y| {
        let cone = -0.05 * y;
        if y < -30.0 {
            s1002::depth_mm(y) - inner
        } else {
            cone
        }
    })
}

fn standard() -> Arc<ContactGeometry> {
    side(s1002::profile(), &uic60::profile())
}

fn loaded(sides: [Arc<ContactGeometry>; 2], running: Running, lateral_m: f64) -> LoadedShift {
    let wheelset = LoadedWheelset::new(sides, running).unwrap();
    wheelset.at(&[lateral_m]).unwrap().remove(0)
}

#[test]
fn both_wheels_carry_their_load_and_nothing_drives_the_wheelset() {
    let side = standard();
    for (lateral_m, yaw_rad, load_n) in [
        (0.0, 0.0, 50e3),
        (3e-3, 4e-3, 100e3),
        (-6.4e-3, -6e-3, 80e3),
    ] {
        let running = Running::default().with_load_n(load_n).with_yaw_rad(yaw_rad);
        let shift = loaded([Arc::clone(&side), Arc::clone(&side)], running, lateral_m);
        let mut driving = 0.0;
        for (_, wheel) in shift.wheels() {
            assert!(
                (wheel.vertical_force_n / load_n - 1.0).abs() < 2e-4,
                "{shift:?}"
            );
            let ratio = wheel.lateral_force_n / wheel.vertical_force_n;
            assert!((ratio - wheel.derailment_coefficient).abs() < 1e-9);
            for patch in &wheel.patches {
                driving += patch.longitudinal_creep_force_n * patch.rolling_radius_m;
                assert!(patch.dissipation_w >= 0.0);
                // The mean pressure of an ellipse is two thirds of its maximum.
                let area =
                    std::f64::consts::PI * patch.semi_axis_rolling_m * patch.semi_axis_across_m;
                let shape = patch.peak_pressure_pa * area / patch.load_n;
                assert!((1.2..2.2).contains(&shape), "{shape}: {patch:?}");
            }
        }
        assert!(driving.abs() < 0.01 * load_n, "{driving}");
    }
}

#[test]
fn opposite_shift_and_yaw_mirror_the_wheelset() {
    let side = standard();
    let at = |lateral_m, yaw_rad| {
        let running = Running::default().with_yaw_rad(yaw_rad);
        loaded([Arc::clone(&side), Arc::clone(&side)], running, lateral_m)
    };
    let (there, mirrored) = (at(4e-3, 3e-3), at(-4e-3, -3e-3));
    for (one, other) in [
        (&there.left, &mirrored.right),
        (&there.right, &mirrored.left),
    ] {
        let (one, other) = (one.as_ref().unwrap(), other.as_ref().unwrap());
        assert_eq!(one.patches.len(), other.patches.len());
        assert!((one.lateral_force_n - other.lateral_force_n).abs() < 20.0);
        for (p, q) in one.patches.iter().zip(&other.patches) {
            assert!((p.wheel_y_m - q.wheel_y_m).abs() < 2e-6, "{p:?} {q:?}");
            assert!((p.track_y_m - q.track_y_m).abs() < 2e-6, "{p:?} {q:?}");
        }
    }
}

#[test]
fn a_patch_lies_on_wheel_and_rail() {
    let side = standard();
    let shift = loaded(
        [Arc::clone(&side), Arc::clone(&side)],
        Running::default(),
        4e-3,
    );
    for (_, wheel) in shift.wheels() {
        for patch in &wheel.patches {
            let depth_m = side.pair().rail().at(patch.track_y_m).z_m;
            // They differ by the penetration, which is about 0.1 mm.
            assert!(
                (0.0..0.2e-3).contains(&(patch.track_z_m - depth_m)),
                "{patch:?} {depth_m}"
            );
        }
    }
}

#[test]
fn a_cone_has_its_conicity_under_any_load() {
    let side = side(cone(), &uic60::profile());
    for load_n in [10e3, 100e3] {
        let running = Running::default().with_load_n(load_n);
        let wheelset =
            LoadedWheelset::new([Arc::clone(&side), Arc::clone(&side)], running).unwrap();
        let rolling = wheelset.rolling_radius_difference().unwrap();
        for row in &Conicity::over_amplitude(&rolling, 0.625)[..6] {
            let value = row.equivalent_conicity.unwrap();
            assert!((value - 0.05).abs() < 2e-3, "{load_n} N: {row:?}");
        }
    }
}

#[test]
fn a_small_load_has_the_conicity_of_rigid_bodies_and_a_large_one_smooths_it() {
    let side = standard();
    let pair = side.pair();
    let rigid = WheelsetGeometry::new([pair, pair]).unwrap();
    let rigid = Conicity::over_amplitude(&rigid.rolling, 0.625);
    let elastic = |load_n: f64| {
        let running = Running::default().with_load_n(load_n);
        let wheelset =
            LoadedWheelset::new([Arc::clone(&side), Arc::clone(&side)], running).unwrap();
        Conicity::over_amplitude(&wheelset.rolling_radius_difference().unwrap(), 0.625)
    };
    let (light, heavy) = (elastic(1e3), elastic(100e3));
    let deviation = |elastic: &[Conicity]| {
        let pairs = elastic.iter().zip(&rigid).take(8);
        pairs
            .map(|(one, rigid)| {
                one.equivalent_conicity.unwrap() - rigid.equivalent_conicity.unwrap()
            })
            .fold(0.0, |max: f64, off| max.max(off.abs()))
    };
    println!("{} {}", deviation(&light), deviation(&heavy));
    assert!(
        deviation(&light) < 0.5 * deviation(&heavy),
        "{light:?} {heavy:?} {rigid:?}"
    );
}

#[test]
fn an_unequal_left_side_is_the_mirrored_right_side_of_the_opposite_wheelset() {
    let (standard, cone) = (standard(), side(cone(), &uic60::profile()));
    let running = Running::default();
    let mixed = loaded([Arc::clone(&cone), Arc::clone(&standard)], running, 2e-3);
    let opposite = loaded([standard, cone], running, -2e-3);
    for (one, other) in [
        (&mixed.left, &opposite.right),
        (&mixed.right, &opposite.left),
    ] {
        let [one, other] = [one, other].map(|wheel| wheel.as_ref().unwrap().patches[0]);
        assert!(
            (one.wheel_y_m - other.wheel_y_m).abs() < 2e-6,
            "{one:?} {other:?}"
        );
        assert!((one.longitudinal_creep_force_n - other.longitudinal_creep_force_n).abs() < 50.0);
    }
    let [left, right] = [&mixed.left, &mixed.right].map(|wheel| wheel.as_ref().unwrap());
    assert!((left.patches[0].wheel_y_m - right.patches[0].wheel_y_m).abs() > 1e-3);
}

#[test]
fn quantities_out_of_bounds_are_named() {
    let side = standard();
    let usual = Running::default();
    for (running, key) in [
        (usual.with_load_n(0.0), "load_n"),
        (usual.with_load_n(f64::NAN), "load_n"),
        (usual.with_speed_m_per_s(0.0), "speed_m_per_s"),
        (usual.with_yaw_rad(0.1), "yaw_rad"),
        (usual.with_friction(0.0), "friction"),
        (usual.with_roll_rad(Some(1.0)), "roll_rad"),
        (
            usual.with_rotation_rad_per_s(Some(f64::INFINITY)),
            "rotation_rad_per_s",
        ),
    ] {
        let sides = [Arc::clone(&side), Arc::clone(&side)];
        let Err(LoadedWheelsetError::OutOfBounds { key: found, .. }) =
            LoadedWheelset::new(sides, running)
        else {
            panic!("{key} was accepted");
        };
        assert_eq!(found, key);
    }
    let wheelset = LoadedWheelset::new([Arc::clone(&side), side], usual).unwrap();
    assert!(wheelset.at(&[0.0, 0.02]).is_err());
}
