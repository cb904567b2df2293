//! The shipped tables of `KalkerBook` against the solver that made them, between their nodes.

use dashpot_rail::creep::{CreepLaw, Creepage, KalkerBook, KalkerTable, LoadedContact};
use dashpot_reference::rolling_contact::RollingContact;

/// Member `n` of a sequence that fills the unit interval evenly.
fn even(n: u32, irrational: f64) -> f64 {
    (f64::from(n) * irrational).fract()
}

/// A contact and a creepage up to ten times sliding with spin up to four times.
fn case(n: u32) -> (LoadedContact, Creepage, f64) {
    let between = |from: f64, to: f64, irrational: f64| from + (to - from) * even(n, irrational);
    let a_over_b = between(0.1_f64.ln(), 10_f64.ln(), 0.618_033_988).exp();
    let poisson_ratio = between(0.25, 0.30, 0.259_921_05);
    let mean: f64 = 5e-3;
    let contact = LoadedContact {
        load_n: 80e3,
        a_m: mean * a_over_b.sqrt(),
        b_m: mean / a_over_b.sqrt(),
        shear_modulus_pa: 82e9,
        kalker: KalkerTable::new(poisson_ratio).unwrap().at(a_over_b),
        friction: between(0.05, 0.6, 0.414_213_562),
    };
    let limit = contact.load_n * contact.friction;
    let sliding = limit / (contact.shear_modulus_pa * mean * mean * contact.kalker.c11);
    let size = sliding * 10f64.powf(between(-1.5, 1.0, 0.732_050_808));
    let angle = between(0.0, std::f64::consts::TAU, 0.236_067_977);
    let creepage = Creepage {
        longitudinal: size * angle.cos(),
        lateral: size * angle.sin(),
        spin_per_m: sliding / mean * 4.0 * between(-1.0, 1.0, 0.645_751_311),
    };
    (contact, creepage, poisson_ratio)
}

#[test]
fn the_book_is_exact_theory_between_its_nodes() {
    let book = KalkerBook::new();
    let n: u32 = std::env::var("CASES").map_or(60, |t| t.parse().unwrap());
    let (mut squares, mut worst, mut sm, mut wm) = (0.0, 0.0_f64, 0.0, 0.0_f64);
    for n in 1..=n {
        let (contact, creepage, poisson_ratio) = case(n);
        let solver = RollingContact::new(contact.a_m / contact.b_m, poisson_ratio).unwrap();
        let exact = solver.creep_forces(&contact, &creepage).unwrap();
        let read = book.forces(&contact, &creepage);
        let limit = contact.load_n * contact.friction;
        let off = (read.longitudinal_n - exact.longitudinal_n)
            .hypot(read.lateral_n - exact.lateral_n)
            / limit;
        let m = (read.moment_n_m - exact.moment_n_m).abs() / limit / 5e-3;
        if off > 0.03 { println!("{off:.4} a/b {:.3} {creepage:?} mu {:.3} {exact:?} {read:?}", contact.a_m/contact.b_m, contact.friction); }
        squares += off * off;
        worst = worst.max(off);
        sm += m * m;
        wm = wm.max(m);
    }
    println!("{:.4} {worst:.4}, M {:.4} {wm:.4}", f64::sqrt(squares / f64::from(n)), f64::sqrt(sm / f64::from(n)));
}
