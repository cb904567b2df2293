//! The creep law of the book of tables: smoothness, derivatives and layout.

use dashpot_rail::creep::{CreepForces, CreepLaw, Creepage, KalkerBook, LoadedContact};
use proptest::prelude::*;

use crate::common::contact;

fn numbers(forces: CreepForces) -> [f64; 3] {
    [forces.longitudinal_n, forces.lateral_n, forces.moment_n_m]
}

fn creepage([longitudinal, lateral, spin_per_m]: [f64; 3]) -> Creepage {
    Creepage {
        longitudinal,
        lateral,
        spin_per_m,
    }
}

/// Dimensionless derivatives with respect to the creepages. The scales are `mu N` for forces, `mu N sqrt(a b)` for the
/// moment, `s = mu N / (G a b C22)` for creepages and `s / sqrt(a b)` for spin.
fn scaled_derivatives(contact: &LoadedContact, at: [f64; 3]) -> [[f64; 3]; 3] {
    let (limit, length) = (
        contact.friction * contact.load_n,
        (contact.a_m * contact.b_m).sqrt(),
    );
    let unit = limit / (contact.shear_modulus_pa * length * length * contact.kalker.c22);
    let by = KalkerBook::new()
        .forces_with_derivatives(contact, &creepage(at))
        .by_creepage;
    let (of, per) = ([limit, limit, limit * length], [unit, unit, unit / length]);
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| by[i][j] * per[j] / of[i]))
}

/// Contacts with creepages from small to full sliding, in any direction.
fn cases() -> impl Strategy<Value = (LoadedContact, [f64; 3])> {
    let shape = (-2.0..2.0_f64, 0.1..0.6_f64);
    let creepages = (-2.0..1.0_f64, 0.0..std::f64::consts::TAU, -1.5..1.5_f64);
    (shape, creepages).prop_map(|((ratio, friction), (size, angle, spin))| {
        let root = (0.5 * ratio).exp();
        let contact = contact(80e3, 5e-3 * root, 5e-3 / root, friction);
        let unit = friction * 80e3 / (82e9 * 25e-6 * contact.kalker.c22);
        let size = 10f64.powf(size) * unit;
        let (sin, cos) = spin.sin_cos();
        (
            contact,
            [
                size * cos * angle.cos(),
                size * cos * angle.sin(),
                size * sin / 5e-3,
            ],
        )
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn derivatives_are_those_of_the_forces((contact, at) in cases()) {
        let book = KalkerBook::new();
        let derivatives = book.forces_with_derivatives(&contact, &creepage(at));
        let forces = numbers(book.forces(&contact, &creepage(at)));
        let limit = contact.friction * contact.load_n;
        let length = (contact.a_m * contact.b_m).sqrt();
        let of = [limit, limit, limit * length];
        for k in 0..3 {
            prop_assert!((forces[k] - numbers(derivatives.forces)[k]).abs() < 1e-6 * of[k]);
        }
        let unit = limit / (contact.shear_modulus_pa * length * length * contact.kalker.c22);
        let size = (at[0].hypot(at[1]).hypot(at[2] * length) / unit).min(1.0);
        for j in 0..3 {
            let step = 1e-3 * size * if j == 2 { unit / length } else { unit };
            let moved = |sign: f64| {
                let mut moved = at;
                moved[j] += sign * step;
                numbers(book.forces(&contact, &creepage(moved)))
            };
            let (ahead, behind) = (moved(1.0), moved(-1.0));
            for k in 0..3 {
                let difference = (ahead[k] - behind[k]) / of[k];
                let derived = derivatives.by_creepage[k][j] * 2.0 * step / of[k];
                // Tolerance for rounding to f32 and for the change of slope over the step.
                prop_assert!((difference - derived).abs() < 1e-6 + 2e-5 * size, "{k} {j}: {difference} {derived}");
            }
        }
    }

    #[test]
    fn the_derivative_by_load_lets_the_ellipse_grow((contact, at) in cases()) {
        let book = KalkerBook::new();
        let derivatives = book.forces_with_derivatives(&contact, &creepage(at));
        let loaded = |factor: f64| {
            let grown = LoadedContact {
                load_n: contact.load_n * factor,
                a_m: contact.a_m * factor.cbrt(),
                b_m: contact.b_m * factor.cbrt(),
                ..contact
            };
            numbers(book.forces(&grown, &creepage(at)))
        };
        let (more, less) = (loaded(1.001), loaded(0.999));
        let limit = contact.friction * contact.load_n;
        for k in 0..3 {
            let of = if k == 2 { limit * 5e-3 } else { limit };
            let difference = (more[k] - less[k]) / of;
            let derived = derivatives.by_load[k] * 0.002 * contact.load_n / of;
            prop_assert!((difference - derived).abs() < 2e-6, "{k}: {difference} {derived}");
        }
    }

    #[test]
    fn derivatives_have_no_jump((contact, at) in cases(), towards in prop::array::uniform3(-1.0..1.0_f64)) {
        // Over a short distance, possibly across the edge of a cell, derivatives change only a little.
        let length = 5e-3;
        let size = at[0].hypot(at[1]).hypot(at[2] * length);
        let moved = |way: f64| {
            let step = |k: usize| at[k] + way * size * towards[k] / if k == 2 { length } else { 1.0 };
            scaled_derivatives(&contact, [step(0), step(1), step(2)])
        };
        let (here, near) = (moved(0.0), moved(1e-5));
        for (here, near) in here.as_flattened().iter().zip(near.as_flattened()) {
            prop_assert!((here - near).abs() < 2e-3, "{here} {near}");
        }
    }
}
