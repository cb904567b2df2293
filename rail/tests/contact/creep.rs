//! Creep laws against exact theory, closed forms and each other; what every law must keep.

use std::f64::consts::PI;

use dashpot_rail::creep::creepage::{CreepForces, CreepLaw, Creepage, LoadedContact, linear};
use dashpot_rail::creep::fastsim::Fastsim;
use dashpot_rail::creep::friction::Friction;
use dashpot_rail::creep::kalker::KalkerTable;
use dashpot_rail::creep::polach::Polach;
use dashpot_rail::creep::shen_hedrick_elkins::ShenHedrickElkins;
use proptest::prelude::*;

const CURVE: &str = include_str!("../../../data/contact/creep_curve.csv");

fn contact(load: f64, a: f64, b: f64, friction: f64) -> LoadedContact {
    LoadedContact {
        load,
        a,
        b,
        shear: 82e9,
        kalker: KalkerTable::new(0.28).at(a / b),
        friction,
    }
}

fn laws() -> [(&'static str, Box<dyn CreepLaw>); 3] {
    [
        ("FASTSIM", Box::new(Fastsim::default())),
        ("Polach", Box::new(Polach)),
        ("Shen-Hedrick-Elkins", Box::new(ShenHedrickElkins)),
    ]
}

#[test]
fn the_creep_curve_of_exact_theory() {
    let contact = contact(106_700.0, 6.304e-3, 12.61e-3, 0.33);
    let limit = contact.load * contact.friction;
    for (name, law) in laws() {
        let mut worst = 0.0_f64;
        for line in CURVE
            .lines()
            .filter(|l| l.starts_with(|c: char| c.is_ascii_digit()))
        {
            let (creepage, exact) = line.split_once(',').unwrap();
            let creepage = Creepage {
                longitudinal: creepage.parse().unwrap(),
                ..Creepage::default()
            };
            let exact: f64 = exact.parse().unwrap();
            let forces = law.forces(&contact, &creepage);
            assert!(forces.lateral.abs() < 1e-6 * limit);
            let off = -forces.longitudinal / exact - 1.0;
            println!("{name} {}: {:+.2} %", creepage.longitudinal, off * 100.0);
            worst = worst.max(off.abs());
        }
        println!("{name}: within {:.1} % of exact theory", worst * 100.0);
        // The literature's "about 5 %". Each law's own formula sets its error, at any mesh for FASTSIM
        // (its closed form is below); of the friction limit it is 4.2, 5.5 and 3.6 %.
        let known = match name {
            "FASTSIM" => 0.054,
            "Polach" => 0.059,
            _ => 0.05,
        };
        assert!(worst < known + 0.0005, "{name}: {worst}");
    }
}

/// Force of Kalker's simplified theory without spin, strips integrated in closed form.
fn simplified(contact: &LoadedContact, creepage: f64, c: f64) -> f64 {
    let (a, b) = (contact.a, contact.b);
    let flexibility = 8.0 * a / (3.0 * c * contact.shear);
    let bound = 2.0 * contact.friction * contact.load / (PI * a * b * a * a);
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
fn fastsim_without_spin_is_the_closed_form() {
    let contact = contact(80e3, 6e-3, 4e-3, 0.3);
    let limit = contact.load * contact.friction;
    let fine = Fastsim {
        along: 200,
        strips: 201,
    };
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
            (forces.longitudinal + closed).abs() < 1e-3 * limit,
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
            (forces.lateral - closed).abs() < 1e-3 * limit,
            "{creepage}: {forces:?} {closed}"
        );
    }
}

#[test]
fn small_creepages_are_linear() {
    for (a, b) in [(6e-3, 4e-3), (3e-3, 9e-3)] {
        let contact = contact(80e3, a, b, 0.3);
        for (name, law) in laws() {
            let cases = [
                (1e-7, 0.0, 0.0),
                (0.0, -1e-7, 0.0),
                // Polach mixes sliding and spin; alone, each is linear.
                (0.0, 0.0, 1e-5),
            ];
            for (longitudinal, lateral, spin) in cases {
                let creepage = Creepage {
                    longitudinal,
                    lateral,
                    spin,
                };
                let (computed, expected) =
                    (law.forces(&contact, &creepage), linear(&contact, &creepage));
                let off = (computed.longitudinal - expected.longitudinal)
                    .hypot(computed.lateral - expected.lateral);
                // FASTSIM's flexibilities reproduce the coefficients only as its mesh rises.
                assert!(
                    off <= 2e-3 * expected.magnitude(),
                    "{name} {creepage:?} {computed:?} {expected:?}"
                );
            }
        }
    }
}

#[test]
fn a_rising_mesh_settles() {
    let contact = contact(80e3, 6e-3, 4e-3, 0.3);
    let limit = contact.load * contact.friction;
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
            spin: creepage.2,
        };
        let all: Vec<CreepForces> = meshes
            .iter()
            .map(|&along| {
                Fastsim {
                    along,
                    strips: along + 1,
                }
                .forces(&contact, &creepage)
            })
            .collect();
        let finest = all[all.len() - 1];
        let off = |f: &CreepForces| {
            (f.longitudinal - finest.longitudinal).hypot(f.lateral - finest.lateral) / limit
        };
        let errors: Vec<f64> = all.iter().map(off).collect();
        println!("{creepage:?}: {errors:.5?}");
        assert!(errors[3] < 3e-3, "{errors:?}");
        assert!(errors[4] < 0.3 * errors[1] + 1e-4, "{errors:?}");
    }
}

#[test]
fn full_sliding_is_friction_against_the_sliding() {
    let contact = contact(80e3, 6e-3, 4e-3, 0.3);
    let limit = 0.3 * 80e3;
    for (name, law) in laws() {
        let creepage = Creepage {
            longitudinal: 0.3,
            lateral: -0.4,
            spin: 0.0,
        };
        let forces = law.forces(&contact, &creepage);
        // The linear stiffnesses steer the direction of every law but Polach's.
        let (x, y) = if name == "Polach" {
            (0.3, -0.4)
        } else {
            (0.3 * contact.kalker.c11, -0.4 * contact.kalker.c22)
        };
        let (x, y) = (-x / x.hypot(y) * limit, -y / x.hypot(y) * limit);
        let off = (forces.longitudinal - x).hypot(forces.lateral - y);
        assert!(off < 0.01 * limit, "{name} {forces:?} for {x} {y}");
    }
}

#[test]
fn pure_spin_turns_and_pushes_within_friction() {
    let contact = contact(80e3, 6e-3, 6e-3, 0.3);
    for (name, law) in laws() {
        for spin in [1e-3, 0.1, 1.0, 10.0, 1e4] {
            let creepage = Creepage {
                spin,
                ..Creepage::default()
            };
            let forces = law.forces(&contact, &creepage);
            assert!(forces.longitudinal.abs() < 1e-9 * 24e3, "{name} {forces:?}");
            assert!(
                forces.lateral < 0.0 && forces.moment < 0.0,
                "{name} {spin} {forces:?}"
            );
        }
    }
}

#[test]
fn strange_contacts_give_no_force() {
    let good = contact(80e3, 6e-3, 4e-3, 0.3);
    let creepage = Creepage {
        longitudinal: 1e-3,
        lateral: 1e-3,
        spin: 0.1,
    };
    for strange in [
        LoadedContact { load: 0.0, ..good },
        LoadedContact { load: -5.0, ..good },
        LoadedContact {
            load: f64::NAN,
            ..good
        },
        LoadedContact { a: 0.0, ..good },
        LoadedContact {
            friction: 0.0,
            ..good
        },
    ] {
        for (name, law) in laws() {
            assert_eq!(
                law.forces(&strange, &creepage),
                CreepForces::default(),
                "{name}"
            );
        }
    }
    for (name, law) in laws() {
        assert_eq!(
            law.forces(&good, &Creepage::default()),
            CreepForces::default(),
            "{name}"
        );
        let lost = Creepage {
            longitudinal: f64::NAN,
            lateral: f64::INFINITY,
            spin: f64::NEG_INFINITY,
        };
        let forces = law.forces(&good, &lost);
        assert!(
            forces.magnitude() <= 24e3 * (1.0 + 1e-12) && forces.moment.is_finite(),
            "{name}"
        );
    }
}

#[test]
fn friction_falls_as_its_law_says() {
    let friction = Friction {
        at_rest: 0.36,
        rest: 0.4,
        speed: 2.0,
    };
    assert!((friction.at(0.0) - 0.36).abs() < 1e-15);
    assert!((friction.at(1e9) - 0.144).abs() < 1e-15);
    assert!((friction.at(2.0) - 0.36 * (0.6 / std::f64::consts::E + 0.4)).abs() < 1e-15);
    assert!((Friction::default().at(30.0) - 0.4).abs() < 1e-15);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn every_law_stays_within_friction_creates_no_energy_and_has_a_mirror(
        load in 1.0..3e5_f64,
        a in 0.5e-3..15e-3_f64,
        b in 0.5e-3..15e-3_f64,
        friction in 0.05..0.6_f64,
        size in -7.0..2.0_f64,
        direction in 0.0..std::f64::consts::TAU,
        spin in -6.0..3.0_f64,
        sign in prop::bool::ANY,
    ) {
        let contact = contact(load, a, b, friction);
        let size = 10f64.powf(size);
        let creepage = Creepage {
            longitudinal: size * direction.cos(),
            lateral: size * direction.sin(),
            spin: 10f64.powf(spin) * if sign { 1.0 } else { -1.0 },
        };
        let mirror = Creepage { lateral: -creepage.lateral, spin: -creepage.spin, ..creepage };
        let backward = Creepage { longitudinal: -creepage.longitudinal, ..creepage };
        for (name, law) in laws() {
            let forces = law.forces(&contact, &creepage);
            let limit = friction * load;
            prop_assert!(forces.magnitude() <= limit * (1.0 + 1e-9), "{name} {forces:?}");
            let scale = limit * (size + creepage.spin.abs() * a.max(b));
            prop_assert!(forces.loss(&creepage) >= -1e-12 * scale, "{name} {forces:?} {}", forces.loss(&creepage));
            let other = law.forces(&contact, &mirror);
            prop_assert!((other.longitudinal - forces.longitudinal).abs() <= 1e-9 * limit, "{name}");
            prop_assert!((other.lateral + forces.lateral).abs() <= 1e-9 * limit, "{name}");
            prop_assert!((other.moment + forces.moment).abs() <= 1e-9 * limit * a.max(b), "{name}");
            let back = law.forces(&contact, &backward);
            prop_assert!((back.longitudinal + forces.longitudinal).abs() <= 1e-6 * limit, "{name}");
        }
    }
}
