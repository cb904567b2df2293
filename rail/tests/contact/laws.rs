//! Measured errors of the creep laws, compared with the block of docs/contact.md that states them.
//!
//! `DASHPOT_BLESS=1 cargo test -p dashpot-rail --test contact laws` rewrites the block.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use dashpot_rail::contact::{Motion, WheelForces, WheelsetContact};
use dashpot_rail::creep::{
    CreepLaw, Creepage, Fastsim, Friction, KalkerBook, LoadedContact, Polach, ShenHedrickElkins,
};

use crate::common::{
    LEVEL, at_height_under_load, contact, geometry, laws, polach, rolling, tables,
};

const BEGIN: &str = "<!-- measured: begin -->";
const END: &str = "<!-- measured: end -->";
const CURVE: &str = include_str!("../../data/creep_curve.csv");

const GRID: &str = include_str!("../../data/creep_exact_grid.csv");

/// Spins of the grid: `phi sqrt(ab) / s`, where `s = mu N / (G ab C11)` is the creepage of full sliding in linear
/// theory.
const SPINS: [f64; 4] = [0.0, 0.5, 1.0, 2.0];

/// The rows of a table, without comments and headers.
fn rows(text: &str) -> impl Iterator<Item = Vec<f64>> {
    let rows = text
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    rows.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
}

/// Maximum relative deviation from exact theory, for longitudinal creepage alone.
fn from_curve(law: &dyn CreepLaw) -> f64 {
    let contact = contact(106_700.0, 6.304e-3, 12.61e-3, 0.33);
    rows(CURVE)
        .map(|row| {
            let creepage = Creepage {
                longitudinal: row[0],
                ..Creepage::default()
            };
            (law.forces(&contact, &creepage).longitudinal_n / row[1] + 1.0).abs()
        })
        .fold(0.0, f64::max)
}

/// RMS and maximum deviation from exact theory, relative to the friction limit, for each of [`SPINS`].
fn from_grid(law: &dyn CreepLaw) -> [(f64, f64); 4] {
    let mut sums = [(0.0, 0.0, 0.0_f64); 4];
    for row in rows(GRID) {
        let [ratio, a, b, load, friction, shear] = [0, 1, 2, 3, 4, 5].map(|k| row[k]);
        let contact = LoadedContact {
            shear_modulus_pa: shear,
            ..contact(load, a, b, friction)
        };
        let limit = contact.load_n * contact.friction;
        let creepage = Creepage {
            longitudinal: row[7],
            lateral: row[8],
            spin_per_m: row[9],
        };
        let sliding = limit / (shear * a * b * contact.kalker.c11);
        let spin = creepage.spin_per_m * (a * b).sqrt() / sliding;
        let group = SPINS.iter().position(|of| (of - spin).abs() < 0.05);
        let group = group.unwrap_or_else(|| panic!("a/b {ratio}: spin {spin} s"));
        let forces = law.forces(&contact, &creepage);
        let off = (forces.longitudinal_n - row[10]).hypot(forces.lateral_n - row[11]) / limit;
        let (squares, count, worst) = &mut sums[group];
        *squares += off * off;
        *count += 1.0;
        *worst = worst.max(off);
    }
    sums.map(|(squares, count, worst)| (f64::sqrt(squares / count), worst))
}

/// Force on a wheelset of 206 kN divided by its friction: on the treads (3 mm, 2 mrad), and in flange contact (6.4 mm,
/// 6 mrad).
fn on_a_wheelset(law: impl CreepLaw) -> [[f64; 3]; 2] {
    let contact = WheelsetContact::new(tables(), law, Friction::default()).unwrap();
    [(3e-3, 2e-3), (6.4e-3, 6e-3)].map(|(lateral_m, yaw_rad)| {
        let motion = Motion {
            lateral_m,
            yaw_rad,
            ..rolling(20.0)
        };
        let motion = at_height_under_load(polach(), &motion, 206e3);
        let force = contact.forces(&motion, &LEVEL).force_n;
        force.map(|force| force / (0.4 * 206e3))
    })
}

/// Element `n` of a low-discrepancy sequence on the unit interval.
fn even(n: usize, irrational: f64) -> f64 {
    (n as f64 * irrational).fract()
}

/// Motion at an evenly spread pose (8 mm shift to one side, 7 mm to the other, 2 mrad roll, 12 mrad yaw) and load (10
/// to 200 kN on two wheels) of the right wheel.
fn spread(n: usize) -> Motion {
    let motion = Motion {
        lateral_m: -8e-3 + 15e-3 * even(n, 0.618_033_988),
        roll_rad: 2e-3 * (2.0 * even(n, 0.414_213_562) - 1.0),
        yaw_rad: 12e-3 * (2.0 * even(n, 0.732_050_807) - 1.0),
        ..rolling(20.0)
    };
    let load_n = 10e3 * 20f64.powf(even(n, 0.236_067_977));
    at_height_under_load(polach(), &motion, 2.0 * load_n)
}

/// RMS and maximum errors of the tables at evenly spread poses and loads: of the right wheel's patch with the greatest
/// load, which is computed again without tables.
fn table_errors() -> Vec<(&'static str, f64, f64)> {
    let source = Arc::new(geometry().clone());
    let computed = WheelsetContact::new(source, Polach, Friction::default()).unwrap();
    let names = [
        "load, %",
        "rolling radius, um",
        "contact angle, mrad",
        "semi-axis in the rolling direction, %",
        "semi-axis across, %",
        "peak pressure, %",
    ];
    let mut errors: Vec<(&str, f64, f64)> = names.map(|name| (name, 0.0, 0.0)).to_vec();
    let mut count = 0.0;
    for n in 0..300 {
        let motion = spread(n);
        let [read, computed] = [
            polach().forces(&motion, &LEVEL),
            computed.forces(&motion, &LEVEL),
        ]
        .map(|f| f.wheels[1]);
        let load = |wheel: &WheelForces| -> f64 { wheel.patches.iter().map(|p| p.load_n).sum() };
        // A flange at this height may carry more. The tables have no load between 200 kN and 1 MN.
        if load(&computed) > 200e3 {
            continue;
        }
        let mut patches = read.patches.iter().zip(&computed.patches);
        let Some((r, c)) = patches.find(|(_, c)| c.load_n > 0.5 * load(&computed)) else {
            continue;
        };
        let percent = |read: f64, computed: f64| (read / computed - 1.0) * 1e2;
        let off = [
            percent(load(&read), load(&computed)),
            (r.rolling_radius_m - c.rolling_radius_m) * 1e6,
            (r.contact_angle_rad() - c.contact_angle_rad()) * 1e3,
            percent(r.semi_axes_m[0], c.semi_axes_m[0]),
            percent(r.semi_axes_m[1], c.semi_axes_m[1]),
            percent(r.peak_pressure_pa, c.peak_pressure_pa),
        ];
        for (error, off) in errors.iter_mut().zip(off) {
            error.1 += off * off;
            error.2 = error.2.max(off.abs());
        }
        count += 1.0;
    }
    for error in &mut errors {
        error.1 = (error.1 / count).sqrt();
    }
    errors
}

fn measured() -> String {
    let mut text = String::from(
        "| law | curve: maximum | no spin: RMS / maximum | spin 0.5: RMS / maximum | spin 1: RMS / maximum \
         | spin 2: RMS / maximum |\n\
         |---|---|---|---|---|---|\n",
    );
    for (name, law) in laws() {
        let _ = write!(
            text,
            "| {name} | {:.1} % ",
            from_curve(law.as_ref()) * 100.0
        );
        for (rms, worst) in from_grid(law.as_ref()) {
            let _ = write!(text, "| {:.1} / {:.1} % ", rms * 100.0, worst * 100.0);
        }
        text.push_str("|\n");
    }
    text.push_str(
        "\n| law, difference from the book | treads (3 mm, 2 mrad) | flange (6.4 mm, 6 mrad) |\n\
         |---|---|---|\n",
    );
    let book = on_a_wheelset(KalkerBook::new());
    for (name, forces) in [
        ("FASTSIM 80 x 81", on_a_wheelset(Fastsim::default())),
        ("Polach", on_a_wheelset(Polach)),
        ("Shen-Hedrick-Elkins", on_a_wheelset(ShenHedrickElkins)),
    ] {
        let [tread, flange] = [0, 1].map(|place| {
            let square: f64 = (0..3)
                .map(|k| (forces[place][k] - book[place][k]).powi(2))
                .sum();
            square.sqrt() * 100.0
        });
        let _ = writeln!(text, "| {name} | {tread:.1} % | {flange:.1} % |");
    }
    text.push_str(
        "\n| quantity read from the tables | RMS error | maximum error |\n|---|---|---|\n",
    );
    for (name, rms, worst) in table_errors() {
        let _ = writeln!(text, "| {name} | {rms:.2} | {worst:.1} |");
    }
    text
}

#[test]
fn the_document_states_the_measured_errors() {
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
        "run with DASHPOT_BLESS=1 to update it"
    );
}

#[test]
fn the_recommended_law_is_exact_theory() {
    let [(_, book), ..] = laws();
    for (rms, worst) in from_grid(book.as_ref()) {
        assert!(rms < 0.01 && worst < 0.03, "{rms} {worst}");
    }
}

#[test]
fn tables_keep_their_bounds() {
    let errors = table_errors();
    let rms = [3.0, 60.0, 5.0, 10.0, 10.0, 10.0];
    for ((name, found, _), bound) in errors.iter().zip(rms) {
        assert!(*found < bound, "{name}: {found}, allowed {bound}");
    }
}
