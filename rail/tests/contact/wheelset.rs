//! Forces on a wheelset: statics, steering, small creepages, continuity, direction of travel, comparison of laws.

use dashpot_rail::contact::{
    Hertz, Motion, PatchForces, Status, Steel, WheelForces, WheelPose, WheelsetContact,
    WheelsetForces,
};
use dashpot_rail::creep::{
    CreepForces, CreepLaw, Creepage, Friction, KalkerBook, KalkerTable, LoadedContact, Polach,
    ShenHedrickElkins, linear_forces,
};

use crate::common::{LEVEL, at_height_under_load, geometry, polach, rolling, tables};

/// The only loaded patch of a wheel.
fn single_patch(wheel: &WheelForces) -> &PatchForces {
    let mut loaded = wheel.loaded_patches();
    let patch = loaded.next().expect("a loaded patch");
    assert!(loaded.next().is_none(), "{wheel:?}");
    patch
}

#[test]
fn a_centred_wheelset_rests_level_near_hertz_s_penetration() {
    let load = 206e3;
    let motion = at_height_under_load(polach(), &rolling(20.0), load);
    let forces = polach().forces(&motion, &LEVEL);
    assert_eq!(forces.status, Status::Rolling);
    assert!((forces.force_n[2] + load).abs() < 1.0);
    assert!(forces.force_n[1].abs() < 1e-6 * load, "{forces:?}");
    let patch = single_patch(&forces.wheels[1]);
    // The profiles are not parabolas: their curvatures differ within the patch.
    let point = geometry()
        .pair()
        .deepest(&WheelPose::default(), &mut Vec::new());
    let hertz = Hertz::new(
        &Steel::default(),
        patch.contact_angle_rad().cos() / patch.rolling_radius_m,
        point.curvature_per_m,
    );
    let penetration_m = hertz.penetration_m(patch.load_n);
    assert!(
        (patch.penetration_m / penetration_m - 1.0).abs() < 0.15,
        "{patch:?} {penetration_m}"
    );
    // The peak pressure of a Hertzian ellipse is 1.5 times the mean. This patch is not quite one.
    let [a, b] = patch.semi_axes_m;
    let mean_pa = patch.load_n / (std::f64::consts::PI * a * b);
    assert!(
        (patch.peak_pressure_pa / mean_pa / 1.5 - 1.0).abs() < 0.3,
        "{patch:?}"
    );
    let vertical = patch.load_n * patch.contact_angle_rad().cos();
    assert!((vertical - load / 2.0).abs() < 0.02 * load, "{vertical}");
}

#[test]
fn a_shifted_wheelset_is_steered_back_and_friction_opposes_yaw() {
    // In free rolling at V / r, a shift to the right gives the right wheel the larger radius. Its surface slides
    // backwards on the rail and is pushed forwards; the left wheel is pushed backwards. The moment therefore turns the
    // nose to the left.
    let contact = polach();
    let motion = at_height_under_load(
        contact,
        &Motion {
            lateral_m: 3e-3,
            ..rolling(20.0)
        },
        206e3,
    );
    let forces = contact.forces(&motion, &LEVEL);
    assert!(forces.moment_n_m[2] < 0.0, "{forces:?}");
    // Yawed to the right and moving straight ahead, both wheels slide to the left and are pushed to the right.
    let motion = at_height_under_load(
        contact,
        &Motion {
            yaw_rad: 5e-3,
            ..rolling(20.0)
        },
        206e3,
    );
    let forces = contact.forces(&motion, &LEVEL);
    assert!(forces.force_n[1] > 0.3 * 0.4 * 206e3, "{forces:?}");
    // At 5 mrad the lateral creepage is 5e-3, which nearly exhausts friction.
    for wheel in &forces.wheels {
        assert!(
            (single_patch(wheel).creepage.lateral.abs() - 5e-3).abs() < 3e-4,
            "{wheel:?}"
        );
    }
}

/// Kalker's linear theory.
struct Linear;

impl CreepLaw for Linear {
    fn unlimited_forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        linear_forces(contact, creepage)
    }
}

#[test]
fn small_creepages_give_kalker_s_force_on_a_wheel() {
    // If the wheelset rotates faster by xi = 2e-6, the force changes by G a b C11 xi, with the ellipse of the patch.
    // The rails are apart, where the pressure has one summit.
    let contact = polach();
    let mut rails = LEVEL;
    (rails[0].lateral_m, rails[1].lateral_m) = (-3e-3, 3e-3);
    let slow = Motion {
        vertical_m: 0.32e-3,
        ..rolling(20.0)
    };
    let wheel = contact.forces(&slow, &rails).wheels[1];
    let radius = wheel.loaded_patches().next().unwrap().rolling_radius_m;
    let at = |ratio: f64| Motion {
        rotation_rad_per_s: 20.0 / radius * ratio,
        ..slow
    };
    let (less, more) = (at(1.0 - 1e-6), at(1.0 + 1e-6));
    let wheel = contact.forces(&less, &rails).wheels[1];
    let load: f64 = wheel.loaded_patches().map(|patch| patch.load_n).sum();
    assert!((60e3..200e3).contains(&load), "{load}");
    let table = KalkerTable::new(0.3).unwrap();
    // Patches in several zones are parts of one ellipse.
    let stiffness = wheel.loaded_patches().map(|patch| {
        let [a, b] = patch.semi_axes_m;
        patch.load_n / load * 80.769_230_769e9 * a * b * table.at(a / b).c11
    });
    let expected = stiffness.sum::<f64>() * 2e-6;
    let force = |forces: WheelsetForces| forces.wheels[1].force_n[0];
    let pull = force(contact.forces(&more, &rails)) - force(contact.forces(&less, &rails));
    // In Polach's law, the spin reduces the adhesion even at this small creepage.
    assert!((pull / expected - 1.0).abs() < 0.25, "{pull} {expected}");
    let linear = WheelsetContact::new(tables(), Linear, Friction::default()).unwrap();
    let pull = force(linear.forces(&more, &rails)) - force(linear.forces(&less, &rails));
    assert!((pull / expected - 1.0).abs() < 1e-3, "{pull} {expected}");
}

#[test]
fn two_point_contact_is_continuous() {
    // Moves the wheelset through flange contact at constant height and at constant load.
    let contact = polach();
    let step = 1e-6;
    let mut last: Option<WheelsetForces> = None;
    let (mut both, mut worst) = (0, 0.0_f64);
    for i in 0..9000 {
        let lateral = -1e-3 + f64::from(i) * step;
        let motion = Motion {
            lateral_m: lateral,
            vertical_m: -0.3e-3,
            yaw_rad: 4e-3,
            ..rolling(20.0)
        };
        let forces = contact.forces(&motion, &LEVEL);
        let right = &forces.wheels[1];
        if right
            .patches
            .iter()
            .filter(|patch| patch.load_n > 1e3)
            .count()
            > 1
        {
            both += 1;
        }
        if let Some(last) = last {
            let jump = (0..3)
                .map(|k| (right.force_n[k] - last.wheels[1].force_n[k]).powi(2))
                .sum::<f64>()
                .sqrt();
            // The stiffest contact, a flange face with 1.4e9 N/m, changes by 1.4 kN per um.
            let load = right.patches.iter().map(|patch| patch.load_n).sum::<f64>();
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
fn reverse_running_is_forward_running_rotated_by_180_degrees() {
    // A rotation by 180 degrees about the vertical axis reverses x and y, and swaps left and right.
    let contact = polach();
    let motion = Motion {
        speed_m_per_s: 15.0,
        lateral_m: 2e-3,
        vertical_m: -0.05e-3,
        roll_rad: 0.3e-3,
        yaw_rad: 3e-3,
        lateral_velocity_m_per_s: 0.02,
        vertical_velocity_m_per_s: 0.001,
        roll_rate_rad_per_s: 0.01,
        rotation_rad_per_s: 15.01 / 0.625,
        yaw_rate_rad_per_s: 0.05,
    };
    let turned = Motion {
        speed_m_per_s: -15.0,
        lateral_m: -2e-3,
        roll_rad: -0.3e-3,
        lateral_velocity_m_per_s: -0.02,
        roll_rate_rad_per_s: -0.01,
        rotation_rad_per_s: -motion.rotation_rad_per_s,
        ..motion
    };
    let (there, back) = (
        contact.forces(&motion, &LEVEL),
        contact.forces(&turned, &LEVEL),
    );
    for k in 0..3 {
        let sign = if k < 2 { -1.0 } else { 1.0 };
        assert!(
            (there.force_n[k] - sign * back.force_n[k]).abs() < 1e-6 * 200e3,
            "{there:?} {back:?}"
        );
        assert!(
            (there.moment_n_m[k] - sign * back.moment_n_m[k]).abs() < 1e-6 * 200e3,
            "{there:?} {back:?}"
        );
    }
}

#[test]
fn the_step_is_bitwise_reproducible() {
    let motion = Motion {
        lateral_m: 6.6e-3,
        vertical_m: -0.2e-3,
        yaw_rad: 8e-3,
        ..rolling(27.0)
    };
    assert_eq!(
        polach().forces(&motion, &LEVEL),
        polach().forces(&motion, &LEVEL)
    );
}

#[test]
fn the_closed_form_laws_are_close_to_exact_theory_on_the_treads() {
    let motion = Motion {
        lateral_m: 3e-3,
        yaw_rad: 2e-3,
        ..rolling(20.0)
    };
    let motion = at_height_under_load(polach(), &motion, 206e3);
    let force = |law: Box<dyn CreepLaw>| {
        let contact = WheelsetContact::new(tables(), law, Friction::default()).unwrap();
        contact.forces(&motion, &LEVEL).force_n
    };
    let exact = force(Box::new(KalkerBook::new()));
    let others: [Box<dyn CreepLaw>; 2] = [Box::new(Polach), Box::new(ShenHedrickElkins)];
    for law in others {
        let found = force(law);
        let off: f64 = (0..3).map(|k| (found[k] - exact[k]).powi(2)).sum();
        assert!(off.sqrt() < 0.1 * 0.4 * 206e3, "{found:?} {exact:?}");
    }
}
