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

/// Maximum error of the derivatives, relative to the maximum derivative with respect to the same field. The error is
/// the distance from the interval between the two one-sided differences, which differ at the edge of a cell.
fn worst<L: CreepLaw, S: PatchSource>(
    contact: &WheelsetContact<L, S>,
    motion: &Motion,
    rails: &[RailDisplacement; 2],
) -> f64 {
    let mut forces = WheelsetForces::default();
    let derivatives = contact.update_with_derivatives(motion, rails, &mut forces);
    assert_eq!(forces, contact.forces(motion, rails));
    let mut worst = 0.0_f64;
    for index in 0..MOTION_FIELDS {
        let at = |sign: f64| {
            let mut moved = *motion;
            let (field, step) = field(&mut moved, index);
            *field += sign * step;
            contact.forces(&moved, rails)
        };
        let (before, here, after) = (at(-1.0), at(0.0), at(1.0));
        let (_, step) = field(&mut Motion::default(), index);
        for (side, d) in derivatives.iter().enumerate() {
            let [b, h, a] = [&before, &here, &after].map(|forces| &forces.wheels[side]);
            let rows = |of: fn(&dashpot_rail::contact::WheelForces) -> [f64; 3],
                        by: &[[f64; MOTION_FIELDS]; 3]| {
                let (b, h, a) = (of(b), of(h), of(a));
                let scale = by.iter().map(|row| row[index].abs()).fold(1.0, f64::max);
                (0..3)
                    .map(|k| {
                        let (left, right) = ((h[k] - b[k]) / step, (a[k] - h[k]) / step);
                        let nearest = by[k][index].clamp(left.min(right), left.max(right));
                        (by[k][index] - nearest).abs() / scale
                    })
                    .fold(0.0, f64::max)
            };
            worst = worst
                .max(rows(|wheel| wheel.force_n, &d.force))
                .max(rows(|wheel| wheel.moment_n_m, &d.moment));
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
        let off = worst(&contact, &motion, &rails);
        prop_assert!(off < 2e-2, "{}", off);
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
        assert!(off < 2e-2, "{lateral_m}: {off}");
    }
}
