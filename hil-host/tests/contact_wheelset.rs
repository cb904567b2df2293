//! Forces on a wheelset: statics, symmetry, continuity, energy, and every strange place.

use std::sync::OnceLock;

use dashpot_hil::contact::creepage::CreepLaw;
use dashpot_hil::contact::fastsim::Fastsim;
use dashpot_hil::contact::forces::{Status, WheelsetForces};
use dashpot_hil::contact::friction::Friction;
use dashpot_hil::contact::hertz::{Hertz, Steel};
use dashpot_hil::contact::motion::{Motion, Rail};
use dashpot_hil::contact::pair::{Installation, Pair};
use dashpot_hil::contact::polach::Polach;
use dashpot_hil::contact::shen_hedrick_elkins::ShenHedrickElkins;
use dashpot_hil::contact::table::{Grid, Tables};
use dashpot_hil::contact::wheelset::WheelsetContact;
use proptest::prelude::*;

fn tables() -> &'static Tables {
    static TABLES: OnceLock<Tables> = OnceLock::new();
    TABLES.get_or_init(|| {
        let pair = Pair::standard(Installation::default()).unwrap();
        Tables::new(pair, Steel::default(), Grid::default())
    })
}

fn polach() -> &'static WheelsetContact<Polach> {
    static CONTACT: OnceLock<WheelsetContact<Polach>> = OnceLock::new();
    CONTACT.get_or_init(|| WheelsetContact::new(tables().clone(), Polach, Friction::default()))
}

const LEVEL: [Rail; 2] = [Rail {
    lateral: 0.0,
    vertical: 0.0,
    lateral_rate: 0.0,
    vertical_rate: 0.0,
}; 2];

/// Depth of the centre at which the rails carry `load`, by bisection.
fn settle<L: CreepLaw>(contact: &WheelsetContact<L>, motion: &Motion, load: f64) -> Motion {
    let (mut low, mut high) = (-40e-3, 1e-3);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let motion = Motion {
            vertical: middle,
            ..*motion
        };
        if -contact.forces(&motion, &LEVEL).force[2] < load {
            low = middle;
        } else {
            high = middle;
        }
    }
    Motion {
        vertical: high,
        ..*motion
    }
}

fn rolling(speed: f64) -> Motion {
    Motion {
        speed,
        rotation: speed / 0.625,
        ..Motion::default()
    }
}

#[test]
fn a_centred_wheelset_stands_level_on_hertz_s_penetration() {
    let load = 206e3;
    let motion = settle(polach(), &rolling(20.0), load);
    let forces = polach().forces(&motion, &LEVEL);
    assert_eq!(forces.status, Status::Rolling);
    assert!((forces.force[2] + load).abs() < 1.0);
    assert!(forces.force[1].abs() < 1e-6 * load, "{forces:?}");
    let patch = &forces.wheels[1].patches[0];
    // The contact angle is 1.9 degrees there; the curvatures are the tread's own, 0.94 per m across.
    let steel = Steel::default();
    let across = tables()
        .pair()
        .patches(&Default::default(), 1e-5, &mut Vec::new())
        .tread
        .curvature;
    let hertz = Hertz::new(&steel, patch.angle().cos() / patch.radius, across);
    assert!(
        (hertz.load(patch.penetration) / patch.load - 1.0).abs() < 1e-5,
        "{patch:?}"
    );
    let vertical = patch.load * patch.angle().cos();
    assert!((vertical - load / 2.0).abs() < 0.02 * load, "{vertical}");
}

#[test]
fn a_shifted_wheelset_is_steered_back_and_yaw_meets_friction() {
    // Rolling freely at V / r, a shift right makes the right wheel the larger: its surface runs
    // backwards over the rail, pushing forward, the left one back; the moment turns the nose left.
    let contact = polach();
    let motion = settle(
        contact,
        &Motion {
            lateral: 3e-3,
            ..rolling(20.0)
        },
        206e3,
    );
    let forces = contact.forces(&motion, &LEVEL);
    assert!(forces.moment[2] < 0.0, "{forces:?}");
    // Yawed right and carried straight on, both wheels slide left over the rails and are pushed right.
    let motion = settle(
        contact,
        &Motion {
            yaw: 5e-3,
            ..rolling(20.0)
        },
        206e3,
    );
    let forces = contact.forces(&motion, &LEVEL);
    assert!(forces.force[1] > 0.3 * 0.4 * 206e3, "{forces:?}");
    // At 5 mrad the lateral creepage is 5e-3: nearly all of friction.
    for wheel in &forces.wheels {
        assert!(
            (wheel.patches[0].creepage.lateral.abs() - 5e-3).abs() < 3e-4,
            "{wheel:?}"
        );
    }
}

#[test]
fn small_creepages_give_kalker_s_forces_on_the_whole_wheelset() {
    // Both wheels turned 0.002 % too fast: twice G a b C11 xi, by hand from the patch's own ellipse.
    let contact = polach();
    let slow = settle(contact, &rolling(20.0), 206e3);
    let radius = contact.forces(&slow, &LEVEL).wheels[1].patches[0].radius;
    let at = |share: f64| {
        let motion = Motion {
            rotation: 20.0 / radius * share,
            ..slow
        };
        contact.forces(&motion, &LEVEL)
    };
    let (less, more) = (at(1.0 - 1e-6), at(1.0 + 1e-6));
    let patch = &less.wheels[1].patches[0];
    let k = dashpot_hil::contact::kalker::KalkerTable::new(0.3)
        .at(patch.semi_axes[0] / patch.semi_axes[1]);
    let expected = 2.0 * 80.769_230_769e9 * patch.semi_axes[0] * patch.semi_axes[1] * k.c11 * 2e-6;
    let pull = more.force[0] - less.force[0];
    // Spin takes part of the adhesion of Polach's law even here.
    assert!((pull / expected - 1.0).abs() < 0.25, "{pull} {expected}");
    let she = WheelsetContact::new(
        tables().clone(),
        ShenHedrickElkins,
        Friction {
            at_rest: 1e3,
            ..Friction::default()
        },
    );
    let of_she = |share: f64| {
        she.forces(
            &Motion {
                rotation: 20.0 / radius * share,
                ..slow
            },
            &LEVEL,
        )
        .force[0]
    };
    let pull = of_she(1.0 + 1e-6) - of_she(1.0 - 1e-6);
    assert!((pull / expected - 1.0).abs() < 1e-3, "{pull} {expected}");
}

#[test]
fn two_point_contact_is_continuous() {
    // The wheelset is pushed through flange contact at constant height and at constant load.
    let contact = polach();
    let step = 1e-6;
    let mut last: Option<WheelsetForces> = None;
    let (mut both, mut worst) = (0, 0.0_f64);
    for i in 0..9000 {
        let lateral = -1e-3 + f64::from(i) * step;
        let motion = Motion {
            lateral,
            vertical: -0.3e-3,
            yaw: 4e-3,
            ..rolling(20.0)
        };
        let forces = contact.forces(&motion, &LEVEL);
        let right = &forces.wheels[1];
        if right.patches.iter().all(|patch| patch.load > 1e3) {
            both += 1;
        }
        if let Some(last) = last {
            let jump = (0..3)
                .map(|k| (right.force[k] - last.wheels[1].force[k]).powi(2))
                .sum::<f64>()
                .sqrt();
            // The stiffest contact, a flange face at 1.4e9 N/m, moves 1.4 kN per um.
            let load = right.patches.iter().map(|patch| patch.load).sum::<f64>();
            worst = worst.max(jump / (load + 20e3));
        }
        last = Some(forces);
        if lateral > 7.2e-3 {
            break;
        }
    }
    println!(
        "two patches over {both} um, greatest change {:.2} % per um",
        worst * 100.0
    );
    assert!(both > 20, "{both}");
    assert!(worst < 0.06, "{worst}");
}

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

#[test]
fn reverse_running_is_forward_running_seen_from_the_other_end() {
    // Half a turn about the vertical axis: x and y change sign, and left with right.
    let contact = polach();
    let motion = Motion {
        speed: 15.0,
        lateral: 2e-3,
        vertical: -0.05e-3,
        roll: 0.3e-3,
        yaw: 3e-3,
        lateral_rate: 0.02,
        vertical_rate: 0.001,
        roll_rate: 0.01,
        rotation: 15.01 / 0.625,
        yaw_rate: 0.05,
    };
    let turned = Motion {
        speed: -15.0,
        lateral: -2e-3,
        roll: -0.3e-3,
        lateral_rate: -0.02,
        roll_rate: -0.01,
        rotation: -motion.rotation,
        ..motion
    };
    let (there, back) = (
        contact.forces(&motion, &LEVEL),
        contact.forces(&turned, &LEVEL),
    );
    for k in 0..3 {
        let sign = if k < 2 { -1.0 } else { 1.0 };
        assert!(
            (there.force[k] - sign * back.force[k]).abs() < 1e-6 * 200e3,
            "{there:?} {back:?}"
        );
        assert!(
            (there.moment[k] - sign * back.moment[k]).abs() < 1e-6 * 200e3,
            "{there:?} {back:?}"
        );
    }
}

#[test]
fn the_step_gives_the_same_bits_again() {
    let motion = Motion {
        lateral: 6.6e-3,
        vertical: -0.2e-3,
        yaw: 8e-3,
        ..rolling(27.0)
    };
    assert_eq!(
        polach().forces(&motion, &LEVEL),
        polach().forces(&motion, &LEVEL)
    );
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
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

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

/// Distance of Polach's and of Shen, Hedrick and Elkins' wheelset force from FASTSIM's, over friction.
fn from_fastsim(lateral: f64, yaw: f64) -> [f64; 2] {
    let fastsim = WheelsetContact::new(tables().clone(), Fastsim::default(), Friction::default());
    let she = WheelsetContact::new(tables().clone(), ShenHedrickElkins, Friction::default());
    let motion = settle(
        polach(),
        &Motion {
            lateral,
            yaw,
            ..rolling(20.0)
        },
        206e3,
    );
    let exact = fastsim.forces(&motion, &LEVEL).force;
    [
        polach().forces(&motion, &LEVEL).force,
        she.forces(&motion, &LEVEL).force,
    ]
    .map(|forces| {
        let off = (0..3)
            .map(|k| (forces[k] - exact[k]).powi(2))
            .sum::<f64>()
            .sqrt();
        off / (0.4 * 206e3)
    })
}

#[test]
fn fastsim_and_the_cheap_laws_agree_on_the_treads_and_part_on_the_flange() {
    let tread = from_fastsim(3e-3, 2e-3);
    let flange = from_fastsim(6.4e-3, 6e-3);
    println!("tread {tread:.3?}, flange {flange:.3?} of friction");
    assert!(tread.iter().all(|off| *off < 0.1), "{tread:?}");
    // The flange's spin is beyond both laws: what docs/contact.md states, no better.
    assert!(flange.iter().all(|off| *off < 0.2), "{flange:?}");
}
