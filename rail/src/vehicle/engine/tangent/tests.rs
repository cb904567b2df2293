//! Resistances of patches against the kinematics of a rigid body.

use fearless_simd::Level;

use super::*;
use crate::creep::Creepage;
use crate::math::dispatch::dispatch;
use crate::vehicle::engine::block::{Block, Vector, coordinates};

const SURFACE: SurfaceConstants = SurfaceConstants {
    shear_modulus_pa: 8e10,
    normal_damping_s_per_m: 5.0,
};
const WEIGHTS: Weights = Weights {
    stiffness: 2e-8,
    damping: 1e-4,
};
const SPEED: f64 = 20.0;
/// Motions of a wheelset: lateral, vertical, roll, pitch and yaw.
const MOTIONS: [Vector; 4] = [
    [1.0, 0.2, 0.3, 0.0, -0.7],
    [-0.4, 1.0, 0.9, 0.6, 0.1],
    [0.0, 0.0, 0.5, -1.0, 2.0],
    [0.3, -0.8, -1.1, 1.3, 0.4],
];

/// A patch of a right wheel towards its flange, with a creep force of 5 kN at a creepage of 1 per mille.
fn patch() -> PatchForces {
    PatchForces {
        load_n: 80e3,
        stiffness_n_per_m: 2e9,
        slope: 0.75,
        semi_axes_m: [6e-3, 4e-3],
        position_m: [0.02, 0.72, 0.6],
        creepage: Creepage {
            longitudinal: 8e-4,
            lateral: -6e-4,
            spin_per_m: 0.5,
        },
        creep: CreepForces {
            longitudinal_n: -3e3,
            lateral_n: 4e3,
            moment_n_m: 10.0,
        },
        ..PatchForces::default()
    }
}

/// The block of a wheelset with these patches, and the equations of its rails.
fn system(wheels: [&[PatchForces]; 2]) -> (Block, RailEquations) {
    let mut forces = WheelsetForces::default();
    for (wheel, patches) in forces.wheels.iter_mut().zip(wheels) {
        wheel.patches[..patches.len()].copy_from_slice(patches);
    }
    let (mut wheelset, mut rails) = (Block::ZERO, RailEquations::uncoupled([0.0; 4]));
    dispatch!(Level::new(), simd => {
        let under = Some(&mut rails);
        add_contact(simd, &mut wheelset, under, &forces, SURFACE, SPEED, WEIGHTS);
    });
    (wheelset, rails)
}

/// Returns `a block b`.
fn form(block: &Block, a: &Vector, b: &Vector) -> f64 {
    let row = dispatch!(Level::new(), simd => coordinates(block.product(simd, a)));
    row.iter().zip(b).map(|(row, b)| row * b).sum()
}

/// Weighted resistances of the patch against motion normal to it and along it.
fn resistances(patch: &PatchForces) -> [f64; 2] {
    let stiffness = patch.stiffness_n_per_m;
    let damping = SURFACE.normal_damping_s_per_m * patch.load_n;
    // 5 kN at a creepage of 1 per mille.
    let creep = 5e6 / SPEED;
    [
        WEIGHTS.stiffness * stiffness + WEIGHTS.damping * damping,
        WEIGHTS.damping * creep,
    ]
}

fn assert_equal(found: f64, expected: f64, scale: f64) {
    assert!(
        (found - expected).abs() < 1e-12 * scale,
        "{found} for {expected}"
    );
}

/// A point at r moves with `t + w x r`. The rail pushes a right wheel up and to the left.
#[test]
fn a_patch_resists_the_motion_of_its_point() {
    let patch = patch();
    let (found, _) = &system([&[], &[patch]]);
    // The slope is 3/4.
    let (normal, across) = ([0.0, -0.6, -0.8], [0.0, 0.8, -0.6]);
    let [x, y, z] = patch.position_m;
    let velocity = |[lateral, vertical, roll, pitch, yaw]: &Vector| {
        [
            pitch * z - yaw * y,
            lateral + yaw * x - roll * z,
            vertical + roll * y - pitch * x,
        ]
    };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let [stiff, creep] = resistances(&patch);
    for a in &MOTIONS {
        for b in &MOTIONS {
            let along = |direction: [f64; 3], motion: &Vector| dot(direction, velocity(motion));
            // A rotation about the axle does not move the wheel's surface out of itself.
            let closing = |[lateral, vertical, roll, _, yaw]: &Vector| {
                along(normal, &[*lateral, *vertical, *roll, 0.0, *yaw])
            };
            let sliding = |direction| along(direction, a) * along(direction, b);
            let expected = stiff * closing(a) * closing(b)
                + creep * (sliding(across) + sliding([1.0, 0.0, 0.0]));
            assert_equal(form(found, a, b), expected, stiff);
        }
    }
}

#[test]
fn a_left_wheel_is_the_mirror_image_of_a_right_wheel() {
    let right = patch();
    let [x, y, z] = right.position_m;
    let left = PatchForces {
        position_m: [x, -y, z],
        ..right
    };
    let [left, right] = [[&[left][..], &[]], [&[], &[right][..]]].map(|wheels| system(wheels).0);
    let mirror =
        |[lateral, vertical, roll, pitch, yaw]: Vector| [-lateral, vertical, -roll, pitch, -yaw];
    for a in MOTIONS {
        for b in MOTIONS {
            let expected = form(&right, &a, &b);
            assert_equal(
                form(&left, &mirror(a), &mirror(b)),
                expected,
                expected.abs().max(1.0),
            );
        }
    }
}

#[test]
fn patches_of_both_wheels_add_up() {
    let (one, mut other) = (patch(), patch());
    other.position_m = [-0.01, -0.75, 0.61];
    other.load_n = 30e3;
    let of = |wheels: [&[PatchForces]; 2]| system(wheels).0;
    let both = of([&[other, one], &[one]]);
    let single = [of([&[other], &[]]), of([&[one], &[]]), of([&[], &[one]])];
    for a in &MOTIONS {
        let expected: f64 = single.iter().map(|block| form(block, a, a)).sum();
        assert_equal(form(&both, a, a), expected, expected);
    }
}

/// A wheelset that moves sideways or down together with its rails meets no resistance.
#[test]
fn only_motion_relative_to_the_rails_is_resisted() {
    let left = PatchForces {
        position_m: [0.0, -0.75, 0.6],
        load_n: 50e3,
        ..patch()
    };
    let (wheelset, rails) = system([&[left], &[patch()]]);
    let power = |motion: &Vector, under: &[f64; 4]| {
        let coupling = rails.coupling.iter().zip(under);
        let between =
            coupling.map(|(row, u)| row.iter().zip(motion).map(|(c, v)| c * v * u).sum::<f64>());
        let [a, b, c, d] = *under;
        let own = [
            (&rails.lateral, [a, a, c, c]),
            (&rails.vertical, [b, b, d, d]),
        ];
        let own = own
            .iter()
            .flat_map(|(row, left)| row.iter().zip(left).zip(under));
        let own: f64 = own.map(|((row, left), right)| row * left * right).sum();
        form(&wheelset, motion, motion) + own + 2.0 * between.sum::<f64>()
    };
    for [y, z] in [[1.0, 0.0], [0.0, 1.0], [0.3, -2.0]] {
        let motion = [y, z, 0.0, 0.0, 0.0];
        let scale = power(&motion, &[0.0; 4]);
        assert!(scale > 0.1, "{scale}");
        assert_equal(power(&motion, &[y, z, y, z]), 0.0, scale);
    }
}

#[test]
fn the_creep_coefficient_is_at_most_that_of_kalker() {
    let limit = KALKER * SURFACE.shear_modulus_pa * 6e-3 * 4e-3;
    let coefficient = |force_n: f64, creepage: f64| {
        let patch = PatchForces {
            creepage: Creepage {
                longitudinal: 0.6 * creepage,
                lateral: 0.8 * creepage,
                spin_per_m: 0.0,
            },
            creep: CreepForces {
                longitudinal_n: -0.8 * force_n,
                lateral_n: 0.6 * force_n,
                moment_n_m: 0.0,
            },
            ..patch()
        };
        creep_coefficient_n(&patch, SURFACE.shear_modulus_pa)
    };
    // Sliding, then rolling with almost no creepage and with none.
    assert_equal(coefficient(20e3, 0.01), 2e6, 2e6);
    assert_equal(coefficient(20e3, 1e-4), limit, limit);
    assert_equal(coefficient(0.0, 0.0), limit, limit);
}
