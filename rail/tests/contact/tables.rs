//! The step with tables: against exact theory, against the contact that they were computed from, and its continuity.

use std::sync::{Arc, OnceLock};

use dashpot_rail::contact::{
    ContactGeometry, Motion, PatchForces, PatchSource, RailDisplacement, Status, WheelForces,
    WheelsetContact,
};
use dashpot_rail::creep::{CreepLaw, Friction, KalkerBook};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

use crate::common::{LEVEL, geometry, is_finite, rolling, tables};
use crate::exact::{LOADS, cases};

fn contact() -> &'static WheelsetContact<KalkerBook> {
    static CONTACT: OnceLock<WheelsetContact<KalkerBook>> = OnceLock::new();
    CONTACT.get_or_init(|| {
        WheelsetContact::new(tables(), KalkerBook::new(), Friction::default()).unwrap()
    })
}

/// The right wheel, with its tread datum `depth_m` below the rail's top.
fn at_depth(lateral_m: f64, depth_m: f64) -> WheelForces {
    let motion = Motion {
        lateral_m,
        vertical_m: depth_m,
        ..rolling(20.0)
    };
    contact().forces(&motion, &LEVEL).wheels[1]
}

fn load_n(wheel: &WheelForces) -> f64 {
    wheel.patches.iter().map(|patch| patch.load_n).sum()
}

/// Mean over the patches, weighted by their loads.
fn mean(wheel: &WheelForces, quantity: impl Fn(&PatchForces) -> f64) -> f64 {
    let weighted = |patch: &PatchForces| patch.load_n * quantity(patch);
    wheel.patches.iter().map(weighted).sum::<f64>() / load_n(wheel)
}

#[test]
fn one_set_of_tables_serves_every_load() {
    for text in LOADS {
        let (mut squares, mut count) = (0.0, 0.0);
        for case in cases(text)
            .iter()
            .filter(|case| case.lateral_m.abs() < 6.1e-3)
        {
            let wheel = at_depth(case.lateral_m, case.depth_m);
            let name = format!("{} m, {} N", case.lateral_m, case.normal_n);
            let load = load_n(&wheel) / case.normal_n;
            assert!((load - 1.0).abs() < 0.12, "{name}: {load} of the load");
            let peaks = wheel.patches.iter().map(|patch| patch.peak_pressure_pa);
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

/// `motion` at the height at which the right wheel carries `target_n`.
fn under_load<L: CreepLaw, S: PatchSource>(
    contact: &WheelsetContact<L, S>,
    motion: &Motion,
    target_n: f64,
) -> Motion {
    let (mut low, mut high) = (-20e-3, 5e-3);
    let at = |vertical_m: f64| Motion {
        vertical_m,
        ..*motion
    };
    for _ in 0..45 {
        let middle = 0.5 * (low + high);
        if load_n(&contact.forces(&at(middle), &LEVEL).wheels[1]) < target_n {
            low = middle;
        } else {
            high = middle;
        }
    }
    at(high)
}

/// Median, 90th and 99th percentile.
fn percentiles(mut errors: Vec<f64>) -> [f64; 3] {
    errors.sort_by(f64::total_cmp);
    [0.5, 0.9, 0.99].map(|part| errors[(part * errors.len() as f64) as usize])
}

#[test]
fn forces_between_nodes_are_those_of_the_contact() {
    let source: Arc<ContactGeometry> = Arc::new(geometry().clone());
    let exact = WheelsetContact::new(source, KalkerBook::new(), Friction::default()).unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(28);
    let mut within = |low: f64, high: f64| {
        low + (high - low) * (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut loads, mut forces, mut positions) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..200 {
        let motion = Motion {
            lateral_m: within(-8e-3, 7e-3),
            roll_rad: within(-2e-3, 2e-3),
            yaw_rad: within(-12e-3, 12e-3),
            lateral_velocity_m_per_s: within(-0.05, 0.05),
            ..rolling(20.0)
        };
        let load = 10e3 * 20.0_f64.powf(within(0.0, 1.0));
        let motion = under_load(contact(), &motion, load);
        let read = contact().forces(&motion, &LEVEL).wheels[1];
        let computed = exact.forces(&motion, &LEVEL).wheels[1];
        loads.push((load_n(&read) / load_n(&computed) - 1.0).abs());
        let place = |wheel: &WheelForces| mean(wheel, |patch| patch.wheel_y_m);
        positions.push((place(&read) - place(&computed)).abs());
        let share = |wheel: &WheelForces, k: usize| wheel.force_n[k] / load_n(wheel);
        let off = |k: usize| share(&read, k) - share(&computed, k);
        forces.push(off(0).hypot(off(1)));
    }
    let [loads, forces, positions] = [loads, forces, positions].map(percentiles);
    let all = format!("{loads:?} {forces:?} {positions:?}");
    assert!(
        loads[0] < 0.02 && loads[1] < 0.05 && loads[2] < 0.2,
        "{all}"
    );
    assert!(
        forces[0] < 0.005 && forces[1] < 0.025 && forces[2] < 0.15,
        "{all}"
    );
    assert!(
        positions[0] < 0.03e-3 && positions[1] < 0.3e-3 && positions[2] < 1e-3,
        "{all}"
    );
}

#[test]
fn at_constant_load_a_micrometre_changes_the_force_little() {
    for yaw_rad in [0.0, 4e-3, 10e-3] {
        let mut before: Option<f64> = None;
        // From the tread up the flange.
        for step in 0..3600 {
            let motion = Motion {
                lateral_m: 3.3e-3 + 1e-6 * f64::from(step),
                yaw_rad,
                ..rolling(20.0)
            };
            let motion = under_load(contact(), &motion, 100e3);
            let now = contact().forces(&motion, &LEVEL).wheels[1].force_n[1];
            if let Some(before) = before {
                assert!(
                    (now - before).abs() < 4e3,
                    "{motion:?}: {before} N, {now} N"
                );
            }
            before = Some(now);
        }
        assert!(before.is_some_and(|force| force < -60e3), "{before:?}");
    }
}

#[test]
fn motions_that_the_tables_do_not_cover_are_flagged() {
    let status = |motion: Motion, rail: RailDisplacement| {
        contact().forces(&motion, &[LEVEL[0], rail]).wheels[1].status
    };
    let lifted = Motion {
        vertical_m: -1e-3,
        ..rolling(20.0)
    };
    assert_eq!(status(lifted, LEVEL[1]), Status::Lifted);
    let aside = RailDisplacement {
        lateral_m: -0.07,
        ..LEVEL[1]
    };
    assert_eq!(status(rolling(20.0), aside), Status::OutsideTables);
    let rolled = RailDisplacement {
        roll_rad: 0.03,
        ..LEVEL[1]
    };
    assert_eq!(status(rolling(20.0), rolled), Status::OutsideTables);
    // Beyond the greatest load of the tables, 1 MN, patches grow as Hertz's do, up to a penetration of 2 mm.
    let pressed = under_load(contact(), &rolling(20.0), 2e6);
    assert_eq!(status(pressed, LEVEL[1]), Status::Rolling);
    let harder = Motion {
        vertical_m: pressed.vertical_m + 2e-3,
        ..pressed
    };
    assert_eq!(status(harder, LEVEL[1]), Status::OutsideTables);
}

#[test]
fn a_light_wheel_has_finite_forces_and_derivatives() {
    for step in 0..4000 {
        let motion = Motion {
            lateral_m: -8e-3 + 4e-6 * f64::from(step),
            yaw_rad: 2e-3,
            ..rolling(20.0)
        };
        let motion = under_load(contact(), &motion, 100.0);
        let mut forces = contact().forces(&motion, &LEVEL);
        assert!(is_finite(&forces));
        let derivatives = contact().update_with_derivatives(&motion, &LEVEL, &mut forces);
        for wheel in derivatives {
            let rows = wheel.force.iter().chain(&wheel.moment).flatten();
            assert!(
                rows.into_iter().all(|x| x.is_finite()),
                "{motion:?} {wheel:?}"
            );
        }
    }
}
