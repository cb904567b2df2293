//! Compares the shipped tables of `KalkerBook` with the solver that computed them.

use dashpot_rail::creep::{CreepLaw, Creepage, KalkerBook, KalkerTable, LoadedContact};
use dashpot_reference::kalker_book::provenance;
use dashpot_reference::rolling_contact::RollingContact;

const MEAN_AXIS_M: f64 = 5e-3;

/// Returns a contact with `a/b` between two limits, a creepage up to ten times that of sliding (spin up to four times),
/// and Poisson's ratio: member `n` of a sequence that fills these ranges evenly.
fn case(n: u32, [min, max]: [f64; 2]) -> (LoadedContact, Creepage, f64) {
    let between = |from: f64, to: f64, irrational: f64| {
        from + (to - from) * (f64::from(n) * irrational).fract()
    };
    let a_over_b = between(min.ln(), max.ln(), 0.618_033_988).exp();
    let poisson_ratio = between(0.25, 0.30, 0.259_921_05);
    let contact = LoadedContact {
        load_n: 80e3,
        a_m: MEAN_AXIS_M * a_over_b.sqrt(),
        b_m: MEAN_AXIS_M / a_over_b.sqrt(),
        shear_modulus_pa: 82e9,
        kalker: KalkerTable::new(poisson_ratio).unwrap().at(a_over_b),
        friction: between(0.05, 0.6, 0.414_213_562),
    };
    let stiffness = contact.shear_modulus_pa * MEAN_AXIS_M.powi(2) * contact.kalker.c11;
    let sliding = contact.load_n * contact.friction / stiffness;
    let size = sliding * 10f64.powf(between(-1.5, 1.0, 0.732_050_808));
    let angle = between(0.0, std::f64::consts::TAU, 0.236_067_977);
    let creepage = Creepage {
        longitudinal: size * angle.cos(),
        lateral: size * angle.sin(),
        spin_per_m: sliding / MEAN_AXIS_M * between(-4.0, 4.0, 0.645_751_311),
    };
    (contact, creepage, poisson_ratio)
}

/// RMS and largest error of the book over cases with `a/b` between limits, for the force over `mu N` and for the moment
/// over `mu N sqrt(a b)`.
fn errors(cases: impl Iterator<Item = u32>, limits: [f64; 2]) -> [[f64; 2]; 2] {
    let book = KalkerBook::new();
    let (mut squares, mut worst, mut count) = ([0.0; 2], [0.0_f64; 2], 0.0);
    for n in cases {
        let (contact, creepage, poisson_ratio) = case(n, limits);
        let solver = RollingContact::new(contact.a_m / contact.b_m, poisson_ratio).unwrap();
        let exact = solver.creep_forces(&contact, &creepage).unwrap();
        let read = book.forces(&contact, &creepage);
        let limit = contact.load_n * contact.friction;
        let [x, y, m] = [
            read.longitudinal_n - exact.longitudinal_n,
            read.lateral_n - exact.lateral_n,
            read.moment_n_m - exact.moment_n_m,
        ];
        let off = [x.hypot(y) / limit, m.abs() / (limit * MEAN_AXIS_M)];
        if off[0] > 0.02 {
            println!(
                "{n}: {:.3} of friction, {contact:?} {creepage:?}: {exact:?}",
                off[0]
            );
        }
        for k in 0..2 {
            squares[k] += off[k] * off[k];
            worst[k] = worst[k].max(off[k]);
        }
        count += 1.0;
    }
    [0, 1].map(|k| [f64::sqrt(squares[k] / count), worst[k]])
}

#[test]
fn the_book_is_exact_theory_between_its_nodes() {
    let [force, moment] = errors(1..=100, [0.1, 10.0]);
    println!("force {force:.4?}, moment {moment:.4?}");
    assert!(force[0] < 0.003 && force[1] < 0.02, "{force:?}");
    assert!(moment[0] < 0.004 && moment[1] < 0.02, "{moment:?}");
}

#[test]
fn the_book_is_exact_theory_of_slender_contacts() {
    for limits in [[0.04, 0.1], [10.0, 25.0]] {
        let [force, moment] = errors(1..=40, limits);
        println!("a/b {limits:?}: force {force:.4?}, moment {moment:.4?}");
        // In the worst cases nearly the whole contact slides, and the pole of spin is near an end of the ellipse.
        // Moments have an arm of up to 5 `sqrt(a b)`, the longer semi-axis.
        assert!(force[0] < 0.01 && force[1] < 0.03, "{force:?}");
        assert!(moment[0] < 0.03 && moment[1] < 0.15, "{moment:?}");
    }
}

#[test]
fn the_shipped_tables_are_those_of_their_provenance() {
    let bytes = include_bytes!("../../../rail/data/kalker_book.bin");
    let text = include_str!("../../../rail/data/kalker_book.txt");
    assert_eq!(text, provenance(bytes), "run cargo xtask kalker-book");
}
