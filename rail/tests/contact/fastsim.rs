//! FASTSIM compared with the closed form of the simplified theory, and its convergence.

use std::f64::consts::PI;

use dashpot_rail::creep::{CreepForces, CreepLaw, Creepage, Fastsim, LoadedContact};

use crate::common::contact;

/// Force of Kalker's simplified theory without spin, integrated along each strip in closed form.
fn simplified(contact: &LoadedContact, creepage: f64, c: f64) -> f64 {
    let (a, b) = (contact.a_m, contact.b_m);
    let flexibility = 8.0 * a / (3.0 * c * contact.shear_modulus_pa);
    let bound = 2.0 * contact.friction * contact.load_n / (PI * a * b * a * a);
    let strip = |y: f64| {
        let h = a * (1.0 - (y / b).powi(2)).sqrt();
        let grade = creepage / flexibility;
        // Adhesion from the leading edge until grade (h - x) = bound (h - x)(h + x).
        let x = (grade / bound - h).min(h);
        let adhesion = grade * (h - x).powi(2) / 2.0;
        let primitive = |x: f64| h * h * x - x.powi(3) / 3.0;
        adhesion + bound * (primitive(x) - primitive(-h))
    };
    // y = b sin t keeps the integrand smooth.
    let n = 20_000;
    let dt = PI / f64::from(n);
    (0..n)
        .map(|i| -PI / 2.0 + (f64::from(i) + 0.5) * dt)
        .map(|t| strip(b * t.sin()) * b * t.cos() * dt)
        .sum()
}

#[test]
fn fastsim_without_spin_agrees_with_the_closed_form() {
    let contact = contact(80e3, 6e-3, 4e-3, 0.3);
    let limit = contact.load_n * contact.friction;
    let fine = Fastsim::default().with_elements(200).with_strips(201);
    for creepage in [2e-4, 1e-3, 2e-3, 4e-3, 2e-2] {
        let forces = fine.forces(
            &contact,
            &Creepage {
                longitudinal: creepage,
                ..Creepage::default()
            },
        );
        let closed = simplified(&contact, creepage, contact.kalker.c11);
        assert!(
            (forces.longitudinal_n + closed).abs() < 1e-3 * limit,
            "{creepage}: {forces:?} {closed}"
        );
        let forces = fine.forces(
            &contact,
            &Creepage {
                lateral: -creepage,
                ..Creepage::default()
            },
        );
        let closed = simplified(&contact, creepage, contact.kalker.c22);
        assert!(
            (forces.lateral_n - closed).abs() < 1e-3 * limit,
            "{creepage}: {forces:?} {closed}"
        );
    }
}

#[test]
fn a_finer_mesh_converges() {
    let contact = contact(80e3, 6e-3, 4e-3, 0.3);
    let limit = contact.load_n * contact.friction;
    let meshes = [10, 20, 40, 80, 160, 320];
    for creepage in [
        (1e-3, 0.5e-3, 0.3),
        (0.0, 0.0, 0.8),
        (2e-3, -3e-3, 1.5),
        (0.2e-3, 0.1e-3, 0.05),
    ] {
        let creepage = Creepage {
            longitudinal: creepage.0,
            lateral: creepage.1,
            spin_per_m: creepage.2,
        };
        let all: Vec<CreepForces> = meshes
            .iter()
            .map(|&elements| {
                Fastsim::default()
                    .with_elements(elements)
                    .with_strips(elements + 1)
                    .forces(&contact, &creepage)
            })
            .collect();
        let finest = all[all.len() - 1];
        let off = |f: &CreepForces| {
            (f.longitudinal_n - finest.longitudinal_n).hypot(f.lateral_n - finest.lateral_n) / limit
        };
        let errors: Vec<f64> = all.iter().map(off).collect();
        println!("{creepage:?}: {errors:.5?}");
        assert!(errors[3] < 3e-3, "{errors:?}");
        assert!(errors[4] < 0.3 * errors[1] + 1e-4, "{errors:?}");
    }
}
