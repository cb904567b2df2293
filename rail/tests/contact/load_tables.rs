//! Tables over the load: against exact theory, against the contact they were computed from, and their continuity.

use std::sync::OnceLock;

use dashpot_rail::contact::WheelPose;
use dashpot_rail::contact::elastic::{Fineness, Given, NormalContact, TurnedStrips};
use dashpot_rail::contact::load_tables::{LoadTables, LoadedPatch, LoadedWheel};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

use crate::exact::{LOADS, cases, geometry};

fn tables() -> &'static LoadTables {
    static TABLES: OnceLock<LoadTables> = OnceLock::new();
    TABLES.get_or_init(|| LoadTables::new(geometry()))
}

fn at_shift(lateral_m: f64) -> WheelPose {
    WheelPose {
        lateral_m,
        ..WheelPose::default()
    }
}

/// Mean over the patches, weighted by their loads.
fn mean(wheel: &LoadedWheel, quantity: impl Fn(&LoadedPatch) -> f64) -> f64 {
    let patches = || wheel.patches.iter().flatten();
    let share: f64 = patches().map(|patch| patch.share).sum();
    patches()
        .map(|patch| patch.share * quantity(patch))
        .sum::<f64>()
        / share
}

#[test]
fn one_set_of_tables_serves_every_load() {
    for text in LOADS {
        let (mut squares, mut count) = (0.0, 0.0);
        for case in cases(text)
            .iter()
            .filter(|case| case.lateral_m.abs() < 6.1e-3)
        {
            let wheel = tables().at(&at_shift(case.lateral_m), case.depth_m);
            let name = format!("{} m, {} N", case.lateral_m, case.normal_n);
            let load = wheel.load_n / case.normal_n;
            assert!((load - 1.0).abs() < 0.12, "{name}: {load} of the load");
            let root = wheel.load_n.cbrt();
            let peaks = wheel
                .patches
                .iter()
                .flatten()
                .map(|patch| patch.pressure_per_root * root);
            let pressure = peaks.fold(0.0, f64::max) / case.peak_pressure_pa;
            assert!(
                (pressure - 1.0).abs() < 0.12,
                "{name}: {pressure} of the pressure"
            );
            let position_m = 0.750 + case.lateral_m + mean(&wheel, |patch| patch.wheel_y_m);
            squares += (position_m - case.position_m).powi(2);
            count += 1.0;
        }
        let rms_mm = 1e3 * f64::sqrt(squares / count);
        assert!(rms_mm < 0.12, "{rms_mm} mm");
    }
}

#[test]
fn loads_and_positions_between_nodes_are_those_of_the_contact() {
    let geometry = geometry();
    let mut random = Pcg64Mcg::seed_from_u64(28);
    let mut within = |low: f64, high: f64| {
        low + (high - low) * (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut loads, mut positions) = (Vec::new(), Vec::new());
    for _ in 0..300 {
        let pose = WheelPose {
            lateral_m: within(-10e-3, 10e-3),
            roll_rad: within(-8e-3, 8e-3),
            yaw_rad: within(-20e-3, 20e-3),
        };
        let load_n = 10e3 * 20.0_f64.powf(within(0.0, 1.0));
        let strips = TurnedStrips::new(
            geometry.pair(),
            pose.roll_rad,
            pose.yaw_rad,
            Fineness::Medium,
        );
        let mut contact = NormalContact::default();
        let patches =
            geometry.elastic_patches(&strips, pose.lateral_m, Given::LoadN(load_n), &mut contact);
        let wheel = tables().at(&pose, contact.depth_m);
        assert!(wheel.is_inside);
        loads.push((wheel.load_n / load_n - 1.0).abs());
        let total: f64 = patches.iter().map(|patch| patch.load_n).sum();
        let position = patches
            .iter()
            .map(|patch| patch.load_n * patch.wheel_y_m)
            .sum::<f64>()
            / total;
        positions.push((mean(&wheel, |patch| patch.wheel_y_m) - position).abs());
    }
    loads.sort_by(f64::total_cmp);
    positions.sort_by(f64::total_cmp);
    let [loads, positions] = [&loads, &positions].map(|errors| [150, 270, 297].map(|k| errors[k]));
    assert!(
        loads[0] < 0.01 && loads[1] < 0.04 && loads[2] < 0.15,
        "{loads:?}"
    );
    assert!(
        positions[0] < 0.02e-3 && positions[1] < 0.2e-3 && positions[2] < 1e-3,
        "{positions:?}"
    );
}

/// The lateral force of a wheel that carries `vertical_n`, N, by the secant method from `depth_m`.
fn lateral_n(pose: &WheelPose, vertical_n: f64, depth_m: &mut f64) -> f64 {
    let force = |depth_m: f64| {
        let wheel = tables().at(pose, depth_m);
        let sine = mean(&wheel, |patch| patch.sine);
        let cosine = mean(&wheel, |patch| (1.0 - patch.sine * patch.sine).sqrt());
        if wheel.load_n > 0.0 {
            [wheel.load_n * sine, wheel.load_n * cosine]
        } else {
            [0.0, 0.0]
        }
    };
    let [mut low, mut high] = [*depth_m - 2e-4, *depth_m + 2e-4];
    for _ in 0..34 {
        let middle = 0.5 * (low + high);
        if force(middle)[1] < vertical_n {
            low = middle;
        } else {
            high = middle;
        }
    }
    *depth_m = high;
    force(high)[0]
}

#[test]
fn at_constant_load_a_micrometre_changes_the_force_little() {
    for yaw_rad in [0.0, 4e-3, 10e-3] {
        let mut depth_m = 0.05e-3;
        let mut before: Option<f64> = None;
        // From the tread up the flange, until the flange carries four times the load.
        for step in 0..3600 {
            let pose = WheelPose {
                yaw_rad,
                ..at_shift(3.3e-3 + 1e-6 * f64::from(step))
            };
            let now = lateral_n(&pose, 100e3, &mut depth_m);
            if let Some(before) = before {
                assert!((now - before).abs() < 4e3, "{pose:?}: {before} N, {now} N");
            }
            before = Some(now);
        }
        assert!(before.is_some_and(|force| force < -100e3), "{before:?}");
    }
}

#[test]
fn a_lifted_wheel_carries_nothing_and_poses_outside_are_flagged() {
    let lifted = tables().at(&WheelPose::default(), -1e-3);
    assert_eq!((lifted.load_n, lifted.is_inside), (0.0, true));
    let outside = tables().at(&at_shift(0.1), 0.0);
    assert!(!outside.is_inside);
    let rolled = WheelPose {
        roll_rad: 0.03,
        ..WheelPose::default()
    };
    assert!(!tables().at(&rolled, 0.0).is_inside);
}

#[test]
fn a_pair_takes_at_most_five_megabytes() {
    assert!(tables().bytes() <= 5_000_000, "{}", tables().bytes());
}
