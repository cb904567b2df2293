//! At displacements far from zero, the rounding of `f32` stays within the promise up to 0.25 m.

use dashpot::accuracy::{displacements_m, stepped};
use dashpot::damper;
use dashpot_files::Scalar;
use dashpot_reference::damper::Reference;
use dashpot_reference::deviation::nrmse;
use dashpot_testbench::accuracy_limits::ACCURACY_LIMITS;
use dashpot_testbench::excitation::Excitation;

const STEP_S: f64 = 1e-4;

/// NRMSE of the step in `f32` at 10 kHz about an offset (m), relative to the motion before rounding.
fn error_about(preset: &str, offset_m: f64) -> f64 {
    let parameters = damper(preset, &[]);
    let displacements: Vec<f64> = displacements_m(Excitation::Ride, STEP_S)
        .iter()
        .map(|x| x + offset_m)
        .collect();
    let times: Vec<f64> = (0..displacements.len())
        .map(|tick| tick as f64 * STEP_S)
        .collect();
    let reference = Reference::new(&parameters)
        .and_then(|mut reference| reference.forces(&times, &displacements))
        .expect("the reference solves every preset");
    nrmse(
        &stepped::<f32>(&parameters, STEP_S, &displacements),
        &reference,
    )
}

#[test]
fn the_promise_holds_up_to_a_quarter_of_a_metre() {
    let promised = ACCURACY_LIMITS[0].nrmse(STEP_S, Scalar::F32).unwrap();
    for preset in [
        "paper",
        "calibrated",
        "in-service",
        "reduced-vertical",
        "reduced-lateral",
    ] {
        for offset_m in [-0.25, 0.2] {
            let error = error_about(preset, offset_m);
            assert!(error < promised, "{preset} about {offset_m} m: {error:.1e}");
        }
    }
    // Rounding limits the accuracy: farther from zero the error grows with the unit in the last place.
    let (near, far) = (error_about("paper", 0.25), error_about("paper", 2.5));
    assert!(far > 4.0 * near, "{near:.1e}, {far:.1e}");
}
