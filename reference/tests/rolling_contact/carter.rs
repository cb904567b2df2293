//! Compares a narrow ellipse, strip by strip, with Carter's closed form for two cylinders (Carter 1926).

use std::f64::consts::{FRAC_PI_2, PI};

use dashpot_reference::rolling_contact::RollingContact;

const POISSON_RATIO: f64 = 0.28;

/// Force over `mu N` of independent strips with `F/(mu P) = 1 - (1 - xi G/(2 mu p f))^2`, where `p` is the pressure at
/// the middle of the strip and `f` is `1 - nu` for longitudinal and 1 for lateral creepage.
fn carter(creepage: f64, flexibility: f64) -> f64 {
    let peak = 1.5 / PI;
    let count = 4000;
    // With y = b sin q, the load of a strip is 3/4 cos^2 q times its width, cos q dq.
    (0..count)
        .map(|index| {
            let angle = -FRAC_PI_2 + (f64::from(index) + 0.5) * PI / f64::from(count);
            let part = (creepage / (2.0 * peak * angle.cos() * flexibility)).min(1.0);
            0.75 * angle.cos().powi(3) * (1.0 - (1.0 - part).powi(2)) * PI / f64::from(count)
        })
        .sum()
}

#[test]
fn a_narrow_ellipse_is_carters_cylinder() {
    let contact = RollingContact::new(0.01, POISSON_RATIO).unwrap();
    for size in [0.05, 0.2, 0.4, 0.6, 0.9] {
        for (axis, flexibility) in [(0, 1.0 - POISSON_RATIO), (1, 1.0)] {
            let mut creepage = [0.0; 3];
            creepage[axis] = size;
            let computed = -contact.solve(creepage).unwrap()[axis];
            let closed = carter(size, flexibility);
            println!("{size} axis {axis}: {computed:.4} {closed:.4}");
            assert!((computed - closed).abs() < 0.005, "{computed} {closed}");
            assert!(
                (computed / closed - 1.0).abs() < 0.01,
                "{computed} {closed}"
            );
        }
    }
}
