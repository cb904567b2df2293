//! Checks that the yardstick of the benches solves the same damper; otherwise its time would be meaningless.

use dashpot::damper;
use dashpot::newton::NewtonDamper;
use dashpot_reference::damper::Reference;
use dashpot_reference::deviation::nrmse;
use dashpot_testbench::excitation::Excitation;

/// NRMSE against the reference over one second of random ride at 1 kHz: a plain SDIRK2 has 3e-4 in double precision
/// over 5 s.
#[test]
fn plain_newton_agrees_with_the_reference() {
    const STEP_S: f64 = 1e-3;
    let motion = &Excitation::Ride.displacements_m(STEP_S)[..=1000];
    let times: Vec<f64> = (0..=1000).map(|tick| f64::from(tick) * STEP_S).collect();
    let paper = damper("paper", &[]);
    let expected = Reference::new(&paper)
        .unwrap()
        .forces(&times, motion)
        .unwrap();
    let mut newton = NewtonDamper::new(&paper, STEP_S).unwrap();
    let found: Vec<f64> = motion
        .iter()
        .map(|&x| f64::from(newton.step(x as f32)))
        .collect();
    let nrmse = nrmse(&found, &expected);
    assert!(nrmse < 2e-3, "NRMSE {nrmse}");
}
