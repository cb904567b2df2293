//! Each creep law's error, measured, against the block of docs/contact.md that states it.
//!
//! `DASHPOT_BLESS=1 cargo test -p dashpot-rail --test contact laws` rewrites the block.

use std::fmt::Write;
use std::path::Path;

use dashpot_rail::contact::WheelPose;
use dashpot_rail::creep::{CreepLaw, Creepage, Fastsim, KalkerTable, LoadedContact, linear_forces};

use crate::common::{laws, tables};

const BEGIN: &str = "<!-- measured: begin -->";
const END: &str = "<!-- measured: end -->";
const CURVE: &str = include_str!("../../data/creep_curve.csv");

fn contact(ratio: f64, shear_modulus_pa: f64, poisson_ratio: f64, friction: f64) -> LoadedContact {
    let area = 6.304e-3 * 12.61e-3;
    LoadedContact {
        load_n: 106_700.0,
        a_m: (area * ratio).sqrt(),
        b_m: (area / ratio).sqrt(),
        shear_modulus_pa,
        kalker: KalkerTable::new(poisson_ratio).unwrap().at(ratio),
        friction,
    }
}

/// Greatest distance from exact theory over its value, pure longitudinal.
fn from_exact(law: &dyn CreepLaw) -> f64 {
    let contact = LoadedContact {
        a_m: 6.304e-3,
        b_m: 12.61e-3,
        ..contact(0.5, 82e9, 0.28, 0.33)
    };
    CURVE
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
        .map(|line| {
            let (creepage, exact) = line.split_once(',').unwrap();
            let (longitudinal, exact): (f64, f64) =
                (creepage.parse().unwrap(), exact.parse().unwrap());
            let creepage = Creepage {
                longitudinal,
                ..Creepage::default()
            };
            (law.forces(&contact, &creepage).longitudinal_n / exact + 1.0).abs()
        })
        .fold(0.0, f64::max)
}

/// RMS and greatest distance from a fine FASTSIM over the friction limit, creepages from a hundredth
/// to ten times what slides in linear theory, in eight directions, spin as `phi sqrt(ab)` over sliding creepage.
fn from_fastsim(law: &dyn CreepLaw, spins: &[f64]) -> (f64, f64) {
    let fine = Fastsim {
        elements: 200,
        strips: 201,
    };
    let (mut squares, mut count, mut worst) = (0.0, 0.0, 0.0_f64);
    for ratio in [0.3, 0.5, 1.0, 2.0] {
        let contact = contact(ratio, 80.77e9, 0.3, 0.4);
        let arm = (contact.a_m * contact.b_m).sqrt();
        let limit = contact.load_n * contact.friction;
        let one = Creepage {
            longitudinal: 1.0,
            ..Creepage::default()
        };
        let sliding = limit / linear_forces(&contact, &one).magnitude_n();
        for step in 0..7 {
            let size = sliding * 10f64.powf(-2.0 + 0.5 * f64::from(step));
            for turn in 0..8 {
                let angle = f64::from(turn) * std::f64::consts::TAU / 8.0 + 0.2;
                for spin in spins {
                    let creepage = Creepage {
                        longitudinal: size * angle.cos(),
                        lateral: size * angle.sin(),
                        spin_per_m: spin * sliding / arm,
                    };
                    let (a, b) = (
                        law.forces(&contact, &creepage),
                        fine.forces(&contact, &creepage),
                    );
                    let off = (a.longitudinal_n - b.longitudinal_n)
                        .hypot(a.lateral_n - b.lateral_n)
                        / limit;
                    squares += off * off;
                    count += 1.0;
                    worst = worst.max(off);
                }
            }
        }
    }
    (f64::sqrt(squares / count), worst)
}

/// Member `n` of a sequence that fills the unit interval evenly.
fn even(n: usize, irrational: f64) -> f64 {
    (n as f64 * irrational).fract()
}

/// RMS and greatest errors of the tables at evenly spread poses within 10 mm, 10 mrad roll, 30 mrad yaw.
fn table_errors() -> Vec<(&'static str, f64, f64)> {
    let tables = tables();
    let names = [
        "penetration, um",
        "rolling radius, um",
        "contact angle, mrad",
        "Hertz stiffness, %",
        "C22, %",
    ];
    let mut errors: Vec<(&str, f64, f64)> = names.map(|name| (name, 0.0, 0.0)).to_vec();
    let mut count = 0.0;
    for n in 0..1500 {
        let pose = WheelPose {
            lateral_m: -10e-3 + 20e-3 * even(n, 0.618_033_988),
            roll_rad: 10e-3 * (2.0 * even(n, 0.414_213_562) - 1.0),
            yaw_rad: 0.03 * (2.0 * even(n, 0.732_050_807) - 1.0),
        };
        let (read, inside) = tables.at(&pose);
        assert!(inside);
        let computed = tables.geometry().patches(&pose, &mut Vec::new());
        let summit = computed
            .iter()
            .filter(|patch| patch.load_fraction > 0.0)
            .fold(f64::MIN, |summit, patch| summit.max(patch.interpenetration_m));
        for (r, c) in read.iter().zip(&computed) {
            // A patch 0.3 mm or more above the other one carries no load.
            if c.load_fraction < 0.5 || c.interpenetration_m < summit - 0.3e-3 {
                continue;
            }
            let cos = 1.0 / (1.0 + c.slope * c.slope).sqrt();
            let off = [
                (r.interpenetration_m - c.interpenetration_m) * cos * 1e6,
                (r.wheel_z_m - c.wheel_z_m) * 1e6,
                (r.slope.atan() - c.slope.atan()) * 1e3,
                (r.hertz.stiffness_n_per_m_1_5 / c.hertz.stiffness_n_per_m_1_5 - 1.0) * 1e2,
                (r.kalker.c22 / c.kalker.c22 - 1.0) * 1e2,
            ];
            for (error, off) in errors.iter_mut().zip(off) {
                error.1 += off * off;
                error.2 = error.2.max(off.abs());
            }
            count += 1.0;
        }
    }
    for error in &mut errors {
        error.1 = (error.1 / count).sqrt();
    }
    errors
}

fn measured() -> String {
    let mut text = String::from(
        "| law | exact theory, greatest | no spin: RMS / greatest | spin 0.5: RMS / greatest | spin 2: RMS / greatest |\n\
         |---|---|---|---|---|\n",
    );
    for (name, law) in laws() {
        let _ = write!(
            text,
            "| {name} | {:.1} % ",
            from_exact(law.as_ref()) * 100.0
        );
        for spins in [&[0.0][..], &[0.5, -0.5], &[2.0, -2.0]] {
            let (rms, worst) = from_fastsim(law.as_ref(), spins);
            let _ = write!(text, "| {:.1} / {:.1} % ", rms * 100.0, worst * 100.0);
        }
        text.push_str("|\n");
    }
    text.push_str("\n| read from the tables | RMS error | greatest error |\n|---|---|---|\n");
    for (name, rms, worst) in table_errors() {
        let _ = writeln!(text, "| {name} | {rms:.2} | {worst:.1} |");
    }
    text
}

#[test]
fn the_document_states_what_is_measured() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/contact.md");
    let document = std::fs::read_to_string(&path).unwrap();
    let begin = document.find(BEGIN).expect("the block begins") + BEGIN.len();
    let end = document.find(END).expect("the block ends");
    let block = format!("\n{}", measured());
    if std::env::var_os("DASHPOT_BLESS").is_some() {
        let text = format!("{}{block}{}", &document[..begin], &document[end..]);
        std::fs::write(&path, text).unwrap();
        return;
    }
    assert_eq!(
        &document[begin..end],
        block,
        "run with DASHPOT_BLESS=1 to restate it"
    );
}

#[test]
fn tables_keep_their_bounds() {
    // A wheel's penetration is near 60 um and its radius matters to the conicity at 20 um.
    let errors = table_errors();
    assert!(errors[0].1 < 0.5 && errors[0].2 < 10.0, "{errors:?}");
    assert!(errors[1].1 < 80.0, "{errors:?}");
    assert!(errors[2].1 < 5.0, "{errors:?}");
}
