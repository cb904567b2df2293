//! What the forces on a wheelset keep everywhere: energy, mirror image, finite numbers, a status.

use crate::common::{LEVEL, polach, rolling, settle};
use dashpot_rail::contact::forces::Status;
use dashpot_rail::contact::motion::{Motion, Rail};
use dashpot_rail::contact::wheelset::WheelsetContact;
use dashpot_rail::creep::creepage::CreepLaw;
use proptest::prelude::*;

#[test]
fn flange_climbing_ends_past_the_tip_with_a_status() {
    let contact = polach();
    let mut seen = Vec::new();
    for i in 0..=700 {
        let lateral = f64::from(i) * 0.1e-3;
        let motion = settle(
            contact,
            &Motion {
                lateral,
                roll: -lateral * 0.2,
                ..rolling(10.0)
            },
            100e3,
        );
        let forces = contact.forces(&motion, &LEVEL);
        assert!(
            forces
                .force
                .iter()
                .chain(&forces.moment)
                .all(|x| x.is_finite())
        );
        if seen.last() != Some(&forces.wheels[1].status) {
            seen.push(forces.wheels[1].status);
        }
    }
    assert!(seen.contains(&Status::Rolling), "{seen:?}");
    assert!(seen.contains(&Status::Climbing), "{seen:?}");
    assert_eq!(seen.last(), Some(&Status::OutsideTables), "{seen:?}");
    let over = Motion {
        lateral: 62e-3,
        vertical: -27.9e-3,
        ..rolling(10.0)
    };
    let wide = Motion {
        lateral: 66e-3,
        vertical: -27.95e-3,
        ..over
    };
    assert!(contact.forces(&over, &LEVEL).wheels[1].status >= Status::Climbing);
    assert_eq!(
        contact.forces(&wide, &LEVEL).wheels[1].status,
        Status::OutsideTables
    );
}

#[test]
fn lifted_standing_and_lost_wheelsets() {
    let contact = polach();
    let lifted = Motion {
        vertical: -5e-3,
        ..rolling(20.0)
    };
    let forces = contact.forces(&lifted, &LEVEL);
    assert_eq!(forces.status, Status::Lifted);
    assert_eq!((forces.force, forces.moment), ([0.0; 3], [0.0; 3]));
    assert_eq!(forces.wheels[0].derailment_coefficient(-1.0), 0.0);
    let standing = settle(contact, &Motion::default(), 206e3);
    let forces = contact.forces(&standing, &LEVEL);
    assert!(
        forces.force[0] == 0.0 && forces.force[1].abs() < 1e-6,
        "{forces:?}"
    );
    // Pushed at 1 mm/s while standing, friction drags against it, within its limit.
    let pushed = Motion {
        lateral_rate: 1e-3,
        ..standing
    };
    let drag = contact.forces(&pushed, &LEVEL).force[1];
    assert!(drag < 0.0 && drag > -0.4 * 206e3 * 1.001, "{drag}");
    for strange in [
        Motion {
            yaw: f64::NAN,
            ..standing
        },
        Motion {
            speed: f64::INFINITY,
            ..standing
        },
        Motion {
            vertical: 1e300,
            ..standing
        },
    ] {
        let forces = contact.forces(&strange, &LEVEL);
        assert_eq!(forces.status, Status::NotFinite);
        assert_eq!(forces.force, [0.0; 3]);
    }
}

fn power_is_taken<L: CreepLaw>(contact: &WheelsetContact<L>, motion: &Motion, rails: &[Rail; 2]) {
    let forces = contact.forces(motion, rails);
    let mut friction_power = 0.0;
    let mut normal_power = 0.0;
    for (side, wheel) in forces.wheels.iter().enumerate() {
        assert!(
            wheel
                .force
                .iter()
                .chain(&wheel.moment)
                .all(|x| x.is_finite()),
            "{motion:?} {wheel:?}"
        );
        for patch in &wheel.patches {
            assert!(
                patch.loss >= -1e-9 * (1.0 + patch.load),
                "{motion:?} {patch:?}"
            );
            assert!(
                patch.creep.magnitude() <= 0.4 * patch.load * (1.0 + 1e-9),
                "{patch:?}"
            );
            friction_power += patch.loss;
            if patch.load > 0.0 {
                // Normal force times the speed of its own point, all by hand in track axes.
                let mirror = if side == 0 { -1.0 } else { 1.0 };
                let normal = [0.0, -mirror * patch.angle().sin(), -patch.angle().cos()];
                let (sr, cr) = motion.roll.sin_cos();
                let (sy, cy) = motion.yaw.sin_cos();
                let axle = [-sy, cy * cr, cy * sr];
                let turn = [
                    motion.roll_rate - motion.rotation * axle[0],
                    -motion.rotation * axle[1],
                    motion.yaw_rate - motion.rotation * axle[2],
                ];
                let p = patch.point;
                let v = [
                    motion.speed + turn[1] * p[2] - turn[2] * p[1],
                    motion.lateral_rate + turn[2] * p[0] - turn[0] * p[2],
                    motion.vertical_rate + turn[0] * p[1] - turn[1] * p[0],
                ];
                normal_power += patch.load * (0..3).map(|k| normal[k] * v[k]).sum::<f64>();
            }
        }
    }
    // The same power from the resultants on the moving body.
    let (sr, cr) = motion.roll.sin_cos();
    let (sy, cy) = motion.yaw.sin_cos();
    let turn = [
        motion.roll_rate + motion.rotation * sy,
        -motion.rotation * cy * cr,
        motion.yaw_rate - motion.rotation * cy * sr,
    ];
    let v = [motion.speed, motion.lateral_rate, motion.vertical_rate];
    let whole: f64 = (0..3)
        .map(|k| forces.force[k] * v[k] + forces.moment[k] * turn[k])
        .sum();
    let scale: f64 = (0..3)
        .map(|k| (forces.force[k] * v[k]).abs() + (forces.moment[k] * turn[k]).abs())
        .sum();
    if motion.speed.abs() > 5.0 && forces.status <= Status::Climbing {
        // Creepages are taken over hypot(V, 0.05 m/s): 5e-5 at 5 m/s.
        assert!(
            (whole - normal_power + friction_power).abs() < 1e-4 * scale + 1e-3,
            "{motion:?}: {whole} {normal_power} {friction_power}"
        );
    }
}

fn motions() -> impl Strategy<Value = Motion> {
    (
        (
            -60.0..60.0_f64,
            -20e-3..20e-3_f64,
            -3e-3..0.4e-3_f64,
            -8e-3..8e-3_f64,
            -30e-3..30e-3_f64,
        ),
        (
            -0.3..0.3_f64,
            -0.1..0.1_f64,
            -0.2..0.2_f64,
            0.9..1.1_f64,
            -0.5..0.5_f64,
        ),
    )
        .prop_map(
            |(
                (speed, lateral, vertical, roll, yaw),
                (lateral_rate, vertical_rate, roll_rate, slip, yaw_rate),
            )| Motion {
                speed,
                lateral,
                vertical,
                roll,
                yaw,
                lateral_rate,
                vertical_rate,
                roll_rate,
                rotation: slip * speed / 0.625,
                yaw_rate,
            },
        )
}

fn anything() -> impl Strategy<Value = f64> {
    prop_oneof![
        -1e-2..1e-2_f64,
        -100.0..100.0_f64,
        prop::num::f64::ANY,
        Just(0.0),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn friction_only_takes_energy_and_resultants_carry_it(motion in motions()) {
        power_is_taken(polach(), &motion, &LEVEL);
    }

    #[test]
    fn the_mirror_image_has_mirrored_forces(motion in motions(), left in -5e-3..5e-3_f64, right in -5e-3..5e-3_f64, down in -1e-3..1e-3_f64) {
        let rail = |lateral: f64, vertical: f64| Rail { lateral, vertical, lateral_rate: 10.0 * lateral, vertical_rate: vertical };
        let rails = [rail(left, down), rail(right, 0.0)];
        let image = Motion {
            lateral: -motion.lateral, roll: -motion.roll, yaw: -motion.yaw,
            lateral_rate: -motion.lateral_rate, roll_rate: -motion.roll_rate, yaw_rate: -motion.yaw_rate,
            ..motion
        };
        let image_rails = [rail(-right, 0.0), rail(-left, down)];
        let (here, there) = (polach().forces(&motion, &rails), polach().forces(&image, &image_rails));
        let scale = 1e-9 * (1.0 + here.force.iter().chain(&here.moment).map(|x| x.abs()).sum::<f64>());
        for k in 0..3 {
            let force_sign = if k == 1 { -1.0 } else { 1.0 };
            prop_assert!((here.force[k] - force_sign * there.force[k]).abs() <= scale);
            prop_assert!((here.moment[k] + force_sign * there.moment[k]).abs() <= scale);
        }
        prop_assert_eq!(here.wheels[0].status, there.wheels[1].status);
    }

    #[test]
    fn no_number_makes_it_panic(numbers in prop::collection::vec(anything(), 14)) {
        let n = &numbers;
        let motion = Motion {
            speed: n[0], lateral: n[1], vertical: n[2], roll: n[3], yaw: n[4],
            lateral_rate: n[5], vertical_rate: n[6], roll_rate: n[7], rotation: n[8], yaw_rate: n[9],
        };
        let rail = Rail { lateral: n[10], vertical: n[11], lateral_rate: n[12], vertical_rate: n[13] };
        let forces = polach().forces(&motion, &[rail, Rail::default()]);
        prop_assert!(forces.force.iter().chain(&forces.moment).all(|x| x.is_finite()), "{:?}", forces);
        for patch in forces.wheels.iter().flat_map(|wheel| wheel.patches) {
            prop_assert!(patch.loss.is_finite() && patch.load.is_finite(), "{:?}", patch);
        }
    }
}
