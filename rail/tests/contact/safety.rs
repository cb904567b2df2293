//! Invariants of the forces on a wheelset: energy, mirror symmetry, finite numbers and status.

use dashpot_rail::contact::{Motion, RailDisplacement, Status, WheelsetContact};
use dashpot_rail::creep::CreepLaw;
use proptest::prelude::*;

use crate::common::{LEVEL, at_height_under_load, is_finite, polach, rolling};

#[test]
fn flange_climbing_ends_past_the_tip_with_a_status() {
    let contact = polach();
    let mut seen = Vec::new();
    for i in 0..=700 {
        let lateral = f64::from(i) * 0.1e-3;
        let motion = at_height_under_load(
            contact,
            &Motion {
                lateral_m: lateral,
                roll_rad: -lateral * 0.2,
                ..rolling(10.0)
            },
            100e3,
        );
        let forces = contact.forces(&motion, &LEVEL);
        assert!(is_finite(&forces));
        if seen.last() != Some(&forces.wheels[1].status) {
            seen.push(forces.wheels[1].status);
        }
    }
    assert!(seen.contains(&Status::Rolling), "{seen:?}");
    assert!(seen.contains(&Status::Climbing), "{seen:?}");
    assert_eq!(seen.last(), Some(&Status::OutsideTables), "{seen:?}");
    let over = Motion {
        lateral_m: 62e-3,
        vertical_m: -27.9e-3,
        ..rolling(10.0)
    };
    let wide = Motion {
        lateral_m: 66e-3,
        vertical_m: -27.95e-3,
        ..over
    };
    assert!(contact.forces(&over, &LEVEL).wheels[1].status >= Status::Climbing);
    assert_eq!(
        contact.forces(&wide, &LEVEL).wheels[1].status,
        Status::OutsideTables
    );
}

#[test]
fn lifted_stationary_and_lost_wheelsets_have_their_status() {
    let contact = polach();
    let lifted = Motion {
        vertical_m: -5e-3,
        ..rolling(20.0)
    };
    let forces = contact.forces(&lifted, &LEVEL);
    assert_eq!(forces.status, Status::Lifted);
    assert_eq!((forces.force_n, forces.moment_n_m), ([0.0; 3], [0.0; 3]));
    assert_eq!(forces.derailment_coefficients(), [0.0; 2]);
    let standing = at_height_under_load(contact, &Motion::default(), 206e3);
    let forces = contact.forces(&standing, &LEVEL);
    assert!(
        forces.force_n[0] == 0.0 && forces.force_n[1].abs() < 1e-6,
        "{forces:?}"
    );
    // Pushed at 1 mm/s while stationary: the creep force opposes the motion, within the friction limit.
    let pushed = Motion {
        lateral_velocity_m_per_s: 1e-3,
        ..standing
    };
    let drag = contact.forces(&pushed, &LEVEL).force_n[1];
    assert!(drag < 0.0 && drag > -0.4 * 206e3 * 1.001, "{drag}");
    for not_accepted in [
        Motion {
            yaw_rad: f64::NAN,
            ..standing
        },
        Motion {
            speed_m_per_s: f64::INFINITY,
            ..standing
        },
        Motion {
            vertical_m: 1e300,
            ..standing
        },
    ] {
        let forces = contact.forces(&not_accepted, &LEVEL);
        assert_eq!(forces.status, Status::NotFinite);
        assert_eq!(forces.force_n, [0.0; 3]);
    }
}

fn power_is_taken<L: CreepLaw>(
    contact: &WheelsetContact<L>,
    motion: &Motion,
    rails: &[RailDisplacement; 2],
) {
    let forces = contact.forces(motion, rails);
    let mut friction_power = 0.0;
    let mut normal_power = 0.0;
    for (side, wheel) in forces.wheels.iter().enumerate() {
        assert!(
            wheel
                .force_n
                .iter()
                .chain(&wheel.moment_n_m)
                .all(|x| x.is_finite()),
            "{motion:?} {wheel:?}"
        );
        for patch in &wheel.patches {
            assert!(
                patch.dissipation_w >= -1e-9 * (1.0 + patch.load_n),
                "{motion:?} {patch:?}"
            );
            assert!(
                patch.creep.magnitude_n() <= 0.4 * patch.load_n * (1.0 + 1e-9),
                "{patch:?}"
            );
            friction_power += patch.dissipation_w;
            if patch.load_n > 0.0 {
                // Power of the normal force: the force times the velocity of its point, computed independently in track
                // axes.
                let mirror = if side == 0 { -1.0 } else { 1.0 };
                let normal = [
                    0.0,
                    -mirror * patch.contact_angle_rad().sin(),
                    -patch.contact_angle_rad().cos(),
                ];
                let (sr, cr) = motion.roll_rad.sin_cos();
                let (sy, cy) = motion.yaw_rad.sin_cos();
                let axle = [-sy, cy * cr, cy * sr];
                let turn = [
                    motion.roll_rate_rad_per_s - motion.rotation_rad_per_s * axle[0],
                    -motion.rotation_rad_per_s * axle[1],
                    motion.yaw_rate_rad_per_s - motion.rotation_rad_per_s * axle[2],
                ];
                let p = patch.position_m;
                let v = [
                    motion.speed_m_per_s + turn[1] * p[2] - turn[2] * p[1],
                    motion.lateral_velocity_m_per_s + turn[2] * p[0] - turn[0] * p[2],
                    motion.vertical_velocity_m_per_s + turn[0] * p[1] - turn[1] * p[0],
                ];
                normal_power += patch.load_n * (0..3).map(|k| normal[k] * v[k]).sum::<f64>();
            }
        }
    }
    // Power of the resultant force and moment on the moving wheelset, which must equal that of the patches.
    let (sr, cr) = motion.roll_rad.sin_cos();
    let (sy, cy) = motion.yaw_rad.sin_cos();
    let turn = [
        motion.roll_rate_rad_per_s + motion.rotation_rad_per_s * sy,
        -motion.rotation_rad_per_s * cy * cr,
        motion.yaw_rate_rad_per_s - motion.rotation_rad_per_s * cy * sr,
    ];
    let v = [
        motion.speed_m_per_s,
        motion.lateral_velocity_m_per_s,
        motion.vertical_velocity_m_per_s,
    ];
    let whole: f64 = (0..3)
        .map(|k| forces.force_n[k] * v[k] + forces.moment_n_m[k] * turn[k])
        .sum();
    let scale: f64 = (0..3)
        .map(|k| (forces.force_n[k] * v[k]).abs() + (forces.moment_n_m[k] * turn[k]).abs())
        .sum();
    if motion.speed_m_per_s.abs() > 5.0 && forces.status <= Status::Climbing {
        // Creepages are divided by hypot(V, 0.05 m/s) instead of V. At 5 m/s the two differ by a fraction of 5e-5.
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
                (speed_m_per_s, lateral_m, vertical_m, roll_rad, yaw_rad),
                (
                    lateral_velocity_m_per_s,
                    vertical_velocity_m_per_s,
                    roll_rate_rad_per_s,
                    slip,
                    yaw_rate_rad_per_s,
                ),
            )| Motion {
                speed_m_per_s,
                lateral_m,
                vertical_m,
                roll_rad,
                yaw_rad,
                lateral_velocity_m_per_s,
                vertical_velocity_m_per_s,
                roll_rate_rad_per_s,
                rotation_rad_per_s: slip * speed_m_per_s / 0.625,
                yaw_rate_rad_per_s,
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
    fn friction_dissipates_the_power_of_the_resultants(motion in motions()) {
        power_is_taken(polach(), &motion, &LEVEL);
    }

    #[test]
    fn the_mirror_image_has_mirrored_forces(
        motion in motions(),
        left in -5e-3..5e-3_f64,
        right in -5e-3..5e-3_f64,
        down in -1e-3..1e-3_f64,
    ) {
        let rail = |lateral: f64, vertical: f64| RailDisplacement {
            friction_ratio: 1.0 + 100.0 * lateral.abs(),
            roll_rad: 0.5 * lateral,
            roll_rate_rad_per_s: lateral,
            yaw_rad: 2.0 * lateral,
            lateral_m: lateral,
            vertical_m: vertical,
            lateral_velocity_m_per_s: 10.0 * lateral,
            vertical_velocity_m_per_s: vertical,
        };
        let rails = [rail(left, down), rail(right, 0.0)];
        let image = Motion {
            lateral_m: -motion.lateral_m, roll_rad: -motion.roll_rad, yaw_rad: -motion.yaw_rad,
            lateral_velocity_m_per_s: -motion.lateral_velocity_m_per_s,
            roll_rate_rad_per_s: -motion.roll_rate_rad_per_s,
            yaw_rate_rad_per_s: -motion.yaw_rate_rad_per_s,
            ..motion
        };
        let image_rails = [rail(-right, 0.0), rail(-left, down)];
        let (here, there) = (polach().forces(&motion, &rails), polach().forces(&image, &image_rails));
        let scale = 1e-9 * (1.0 + here.force_n.iter().chain(&here.moment_n_m).map(|x| x.abs()).sum::<f64>());
        for k in 0..3 {
            let force_sign = if k == 1 { -1.0 } else { 1.0 };
            prop_assert!((here.force_n[k] - force_sign * there.force_n[k]).abs() <= scale);
            prop_assert!((here.moment_n_m[k] + force_sign * there.moment_n_m[k]).abs() <= scale);
        }
        prop_assert_eq!(here.wheels[0].status, there.wheels[1].status);
    }

    #[test]
    fn no_input_causes_a_panic(numbers in prop::collection::vec(anything(), 18)) {
        let n = &numbers;
        let motion = Motion {
            speed_m_per_s: n[0], lateral_m: n[1], vertical_m: n[2], roll_rad: n[3], yaw_rad: n[4],
            lateral_velocity_m_per_s: n[5],
            vertical_velocity_m_per_s: n[6],
            roll_rate_rad_per_s: n[7],
            rotation_rad_per_s: n[8],
            yaw_rate_rad_per_s: n[9],
        };
        let rail = RailDisplacement {
            lateral_m: n[10],
            vertical_m: n[11],
            lateral_velocity_m_per_s: n[12],
            vertical_velocity_m_per_s: n[13],
            roll_rad: n[14],
            roll_rate_rad_per_s: n[15],
            friction_ratio: n[16],
            yaw_rad: n[17],
        };
        let forces = polach().forces(&motion, &[rail, RailDisplacement::default()]);
        prop_assert!(is_finite(&forces), "{:?}", forces);
        for patch in forces.wheels.iter().flat_map(|wheel| wheel.patches) {
            prop_assert!(patch.dissipation_w.is_finite() && patch.load_n.is_finite(), "{:?}", patch);
        }
    }
}
