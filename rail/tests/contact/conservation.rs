//! A wheel that slides on its flange without friction gives back the work that was done on it.
//!
//! With one normal for each patch, as in the theory of half-spaces, the wheelset gained energy in every cycle and
//! bounced on its flange.

use dashpot_rail::contact::{Motion, WheelsetContact};
use dashpot_rail::creep::{Friction, KalkerBook};

use crate::common::{LEVEL, rolling, tables};

/// Steps along each side of a cycle.
const STEPS: u32 = 200;

/// Work that the rail does on the right wheel around a rectangle of lateral and vertical positions, m, divided by the
/// work along its sides regardless of sign.
fn gained(yaw_rad: f64, roll_rad: f64, lateral_m: [f64; 2], vertical_m: [f64; 2]) -> f64 {
    let contact =
        WheelsetContact::new(tables(), KalkerBook::new(), Friction::constant(1e-3)).unwrap();
    let force_n = |[lateral_m, vertical_m]: [f64; 2]| {
        let motion = Motion {
            lateral_m,
            vertical_m,
            yaw_rad,
            roll_rad,
            ..rolling(20.0)
        };
        let [_, y, z] = contact.forces(&motion, &LEVEL).wheels[1].force_n;
        [y, z]
    };
    let [left, right] = lateral_m;
    let [up, down] = vertical_m;
    let corners = [
        [left, up],
        [right, up],
        [right, down],
        [left, down],
        [left, up],
    ];
    let (mut gained_j, mut exchanged_j) = (0.0, 0.0_f64);
    for side in corners.windows(2) {
        for step in 0..STEPS {
            // The midpoint rule.
            let part = (f64::from(step) + 0.5) / f64::from(STEPS);
            let at = [0, 1].map(|k| side[0][k] + part * (side[1][k] - side[0][k]));
            let force = force_n(at);
            let work: f64 = (0..2)
                .map(|k| force[k] * (side[1][k] - side[0][k]) / f64::from(STEPS))
                .sum();
            gained_j += work;
            exchanged_j += work.abs();
        }
    }
    assert!(exchanged_j > 0.1, "the wheel touches the rail");
    gained_j / exchanged_j
}

#[test]
fn a_cycle_on_the_flange_gains_no_energy() {
    for (yaw_rad, roll_rad) in [(0.0, 0.0), (10e-3, -0.7e-3), (5e-3, -0.7e-3), (-10e-3, 0.0)] {
        for lateral_m in [[6.05e-3, 6.10e-3], [6.10e-3, 6.15e-3], [6.15e-3, 6.2e-3]] {
            let gained = gained(yaw_rad, roll_rad, lateral_m, [-0.25e-3, -0.1e-3]);
            assert!(
                gained.abs() < 0.06,
                "{yaw_rad} {roll_rad} {lateral_m:?}: {gained}"
            );
        }
    }
}
