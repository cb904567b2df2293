//! Compares full sliding with direct quadrature of friction, for any position of the pole of spin.

use std::f64::consts::PI;

use dashpot_reference::rolling_contact::{RollingContact, Tractions, full_sliding};

#[test]
fn large_creepages_slide_fully() {
    for a_over_b in [0.2, 1.0, 3.0] {
        // There are enough strips to resolve the pole of spin, where the traction reverses.
        let contact = RollingContact::with_mesh(a_over_b, 0.28, 30, 40).unwrap();
        for creepage in [
            [300.0, 0.0, 0.0],
            [-300.0, 400.0, 0.0],
            [0.0, 0.0, 500.0],
            [100.0, 100.0, 400.0],
            [-200.0, 0.0, -400.0],
            [0.0, 300.0, 300.0],
        ] {
            let mut tractions = Tractions::default();
            let rolling = contact.solve_from(creepage, &mut tractions).unwrap();
            let sliding = full_sliding(a_over_b, creepage);
            println!("a/b {a_over_b} {creepage:?}: {rolling:.4?} {sliding:.4?}");
            for (rolling, sliding) in rolling.iter().zip(sliding) {
                assert!((rolling - sliding).abs() < 0.01, "{a_over_b} {creepage:?}");
            }
            let used = contact.max_utilisation(&tractions);
            assert!(used <= 1.0 + 1e-9, "{used}");
        }
    }
}

#[test]
fn full_sliding_has_known_moments_and_forces() {
    // For a circle, the arm is 3 pi / 16 of its radius.
    let [x, y, moment] = full_sliding(1.0, [0.0, 0.0, -2.0]);
    assert!(x.hypot(y) < 1e-9 && (moment - 3.0 * PI / 16.0).abs() < 1e-4);
    // For a very long ellipse, the arm is the mean distance from its middle, 3/8 of the longer semi-axis.
    let [.., moment] = full_sliding(1e-4, [0.0, 0.0, 1.0]);
    assert!((moment / -100.0 - 0.375).abs() < 1e-3, "{moment}");
    let [x, y, moment] = full_sliding(0.3, [3.0, -4.0, 0.0]);
    assert!((x + 0.6).abs() < 1e-4 && (y - 0.8).abs() < 1e-4 && moment.abs() < 1e-9);
}
