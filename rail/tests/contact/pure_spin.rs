//! Regression: in pure spin, which a freely rolling centred wheel has, the derivatives from Kalker's book of tables
//! were rounding errors divided by almost zero, up to 1e30 N.

use dashpot_rail::creep::{CreepLaw, Creepage, KalkerBook, KalkerTable, LoadedContact};

#[test]
fn the_derivatives_in_pure_spin_are_those_of_the_forces() {
    let book = KalkerBook::new();
    for a_over_b in [0.3, 1.0, 1.9, 6.0] {
        let contact = LoadedContact {
            load_n: 97e3,
            a_m: 8.5e-3,
            b_m: 8.5e-3 / a_over_b,
            shear_modulus_pa: 80.77e9,
            kalker: KalkerTable::new(0.28).unwrap().at(a_over_b),
            friction: 0.4,
        };
        let stiffness = contact.shear_modulus_pa * contact.a_m * contact.b_m;
        for spin_per_m in [0.0, -0.08, 0.5, 3.0] {
            for start in [0.0, 1e-12] {
                let at = Creepage {
                    longitudinal: start,
                    lateral: 0.0,
                    spin_per_m,
                };
                let found = book.forces_with_derivatives(&contact, &at);
                assert_eq!(found.forces, book.forces(&contact, &at));
                let step = 1e-5;
                for (column, row) in [(0, 0), (1, 1), (0, 1), (1, 0)] {
                    let moved = |sign: f64| {
                        let mut creepage = at;
                        *[&mut creepage.longitudinal, &mut creepage.lateral][column] += sign * step;
                        book.forces(&contact, &creepage).components()[row]
                    };
                    let difference = (moved(1.0) - moved(-1.0)) / (2.0 * step);
                    let off = (found.by_creepage[row][column] - difference).abs();
                    let scale = stiffness * contact.kalker.c11;
                    assert!(
                        off < 0.02 * scale,
                        "{a_over_b} {spin_per_m} {row} {column}: {off:e} of {scale:e}"
                    );
                }
            }
        }
    }
}
