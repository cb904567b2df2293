//! Derivatives of the forces, compared with differences of the forces.

use dashpot_rail::contact::{
    MOTION_FIELDS, Motion, PatchSource, RailDisplacement, WheelsetContact, WheelsetForces,
};
use dashpot_rail::creep::{CreepLaw, Friction, ShenHedrickElkins};
use proptest::prelude::*;

use crate::common::{LEVEL, at_height_under_load, geometry, rolling, tables};

/// A field of `motion`, by its index in the declaration, and a step that moves the contact by 0.1 um or a few um/s.
/// That is above the noise of tables in single precision, and within their cells.
fn field(motion: &mut Motion, index: usize) -> (&mut f64, f64) {
    match index {
        0 => (&mut motion.speed_m_per_s, 1e-6),
        1 => (&mut motion.lateral_m, 3e-7),
        2 => (&mut motion.vertical_m, 1e-7),
        3 => (&mut motion.roll_rad, 3e-7),
        4 => (&mut motion.yaw_rad, 1e-5),
        5 => (&mut motion.lateral_velocity_m_per_s, 1e-6),
        6 => (&mut motion.vertical_velocity_m_per_s, 1e-6),
        7 => (&mut motion.roll_rate_rad_per_s, 1e-6),
        8 => (&mut motion.rotation_rad_per_s, 1e-6),
        _ => (&mut motion.yaw_rate_rad_per_s, 1e-6),
    }
}

/// Maximum errors of the derivatives of forces and of moments, relative to the maximum derivative with respect to the
/// same field: the distance between the interval of both one-sided differences and that of the derivatives at their
/// three ends. Either differ where a cell or one of its parts ends.
fn worst<L: CreepLaw, S: PatchSource>(
    contact: &WheelsetContact<L, S>,
    motion: &Motion,
    rails: &[RailDisplacement; 2],
) -> [f64; 2] {
    let differentiated = |motion: &Motion| {
        let mut forces = WheelsetForces::default();
        let derivatives = contact.update_with_derivatives(motion, rails, &mut forces);
        (forces, derivatives)
    };
    // The step reads the tables in single precision.
    let (forces, _) = differentiated(motion);
    let step = contact.forces(motion, rails);
    for (found, expected) in forces.wheels.iter().zip(&step.wheels) {
        assert_eq!(found.status, expected.status);
        let sum: f64 = expected.force_n.iter().map(|force| force.abs()).sum();
        let scale = 1e-6 * (1.0 + sum);
        for k in 0..3 {
            let off = found.force_n[k] - expected.force_n[k];
            assert!(off.abs() <= scale, "{found:?} {expected:?}");
        }
    }
    let mut worst = [0.0_f64; 2];
    for index in 0..MOTION_FIELDS {
        let (_, step) = field(&mut Motion::default(), index);
        let ends = [-1.0, 0.0, 1.0].map(|sign| {
            let mut moved = *motion;
            *field(&mut moved, index).0 += sign * step;
            (contact.forces(&moved, rails), differentiated(&moved).1)
        });
        for side in 0..2 {
            // Values and derivatives of the six components of force and moment at the three ends.
            let values = ends.each_ref().map(|(forces, _)| {
                let wheel = &forces.wheels[side];
                [wheel.force_n, wheel.moment_n_m]
            });
            let slopes = ends
                .each_ref()
                .map(|(_, derivatives)| [derivatives[side].force, derivatives[side].moment]);
            for kind in 0..2 {
                let here = slopes[1][kind].iter().map(|row| row[index].abs());
                let scale = here.fold(1.0, f64::max);
                for k in 0..3 {
                    let [before, here, after] = values.map(|value| value[kind][k]);
                    let slopes = slopes.map(|slope| slope[kind][k][index]);
                    let least = slopes.into_iter().fold(f64::INFINITY, f64::min);
                    let greatest = slopes.into_iter().fold(f64::NEG_INFINITY, f64::max);
                    let (left, right) = ((here - before) / step, (after - here) / step);
                    let below = least - left.max(right);
                    let above = left.min(right) - greatest;
                    worst[kind] = worst[kind].max(below.max(above) / scale);
                }
            }
        }
    }
    worst
}

fn damped<S: PatchSource>(source: std::sync::Arc<S>) -> WheelsetContact<ShenHedrickElkins, S> {
    let friction = Friction::constant(0.35)
        .with_residual_ratio(0.4)
        .with_decay_speed_m_per_s(2.0);
    WheelsetContact::new(source, ShenHedrickElkins, friction)
        .and_then(|contact| contact.with_normal_damping(3.0))
        .unwrap()
}

fn motions() -> impl Strategy<Value = (Motion, [RailDisplacement; 2])> {
    let pose = (-6e-3..6.9e-3_f64, -3e-3..3e-3_f64, -12e-3..12e-3_f64);
    let rates = (
        -0.05..0.05_f64,
        -0.02..0.02_f64,
        -0.02..0.02_f64,
        0.998..1.002_f64,
        -0.05..0.05_f64,
    );
    let rails = (-1e-3..1e-3_f64, -5e-3..5e-3_f64, -0.02..0.02_f64);
    (pose, rates, rails, 10.0..60.0_f64).prop_map(
        |((lateral_m, roll_rad, yaw_rad), (vy, vz, wx, slip, wz), (shift, roll, rate), speed)| {
            let motion = Motion {
                lateral_m,
                roll_rad,
                yaw_rad,
                lateral_velocity_m_per_s: vy,
                vertical_velocity_m_per_s: vz,
                roll_rate_rad_per_s: wx,
                rotation_rad_per_s: slip * speed / 0.625,
                yaw_rate_rad_per_s: wz,
                ..rolling(speed)
            };
            let rail = RailDisplacement {
                lateral_m: shift,
                vertical_m: 0.3 * shift,
                lateral_velocity_m_per_s: rate,
                vertical_velocity_m_per_s: 0.5 * rate,
                roll_rad: roll,
                roll_rate_rad_per_s: rate,
                yaw_rad: 0.1 * roll,
                friction_ratio: 1.0,
            };
            (motion, [rail, LEVEL[1]])
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]
    #[test]
    fn derivatives_are_those_of_the_forces((motion, rails) in motions(), load in 40e3..250e3_f64) {
        let contact = damped(tables());
        let motion = at_height_under_load(&contact, &motion, load);
        let [forces, moments] = worst(&contact, &motion, &rails);
        prop_assert!(forces < 2e-2, "forces: {}", forces);
        // The derivatives neglect the influence of `C33` on the spin moment: 7 % on a flange under 646 kN.
        prop_assert!(moments < 1e-1, "moments: {}", moments);
    }
}

#[test]
fn the_derivatives_of_the_geometry_are_those_of_its_forces() {
    let contact = damped(std::sync::Arc::new(geometry().clone()));
    for lateral_m in [-2e-3, 1e-3, 5e-3, 6.4e-3] {
        let motion = Motion {
            lateral_m,
            yaw_rad: 4e-3,
            lateral_velocity_m_per_s: 0.01,
            ..rolling(20.0)
        };
        let motion = at_height_under_load(&contact, &motion, 200e3);
        let off = worst(&contact, &motion, &LEVEL);
        assert!(off.iter().all(|off| *off < 2e-2), "{lateral_m}: {off:?}");
    }
}
