//! Swept sine: compares it with closed forms and with single harmonic motions.

use std::f64::consts::{PI, TAU};

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::{DamperParameters, Mount};
use dashpot_files::damper;
use dashpot_files::harmonic::HarmonicError;
use dashpot_testbench::TestbenchError;
use dashpot_testbench::response::{Response, at_amplitude, frequencies};
use dashpot_testbench::swept_sine::responses;

fn reduced(damping: f64, stiffness: f64, clearance_m: f64) -> CheckedParameters {
    let mut mount = Mount::new(stiffness);
    mount.clearance_m = clearance_m;
    let mut parameters = DamperParameters::reduced(damping, 100.0, mount);
    parameters.limits.force_n = 1e7;
    parameters.check().unwrap()
}

/// `K' = K (w tau)^2/(1 + (w tau)^2)`, loss angle `atan(1/(w tau))`.
#[test]
fn a_maxwell_element_follows_its_closed_form() {
    let (damping, stiffness) = (120e3, 8e6);
    let damper = reduced(damping, stiffness, 0.0);
    let frequencies = frequencies(0.5, 30.0, 13);
    for found in responses(&damper, 1e-3, &frequencies, 2.0).unwrap() {
        let ratio = TAU * found.frequency_hz * damping / stiffness;
        let expected = Response {
            storage_n_per_m: stiffness * ratio * ratio / (1.0 + ratio * ratio),
            loss_n_per_m: stiffness * ratio / (1.0 + ratio * ratio),
            ..found
        };
        let difference = found.difference_from(&expected).unwrap();
        assert!(difference < 5e-4, "{found:?}: {difference:e}");
        let angle = (1.0 / ratio).atan().to_degrees();
        assert!((found.loss_angle_deg().unwrap() - angle).abs() < 0.03);
    }
}

/// Spring in series with a dead zone, as in `damper_response`.
#[test]
fn a_clearance_is_a_dead_zone() {
    let (stiffness, half_m) = (1e6, 0.5e-3);
    let damper = reduced(1e9, stiffness, 2.0 * half_m);
    for ratio in [0.9, 0.5, 0.25] {
        let found = responses(&damper, half_m / ratio, &[50.0, 100.0], 60.0).unwrap();
        let root = f64::sqrt(1.0 - ratio * ratio);
        let expected = stiffness * (1.0 - 2.0 / PI * (f64::asin(ratio) + ratio * root));
        for found in found {
            let error = (found.stiffness_n_per_m() / expected - 1.0).abs();
            assert!(error < 2e-3, "{ratio}: {found:?} for {expected}");
        }
    }
    let within = responses(&damper, 0.9 * half_m, &[50.0, 100.0], 60.0).unwrap();
    assert!(within.iter().all(|found| !found.has_force()));
    assert_eq!(within[0].loss_angle_deg(), None);
}

/// Checks the accuracy stated in docs/model.md.
///
/// The limit assumes that no preset has a stiffness that rises faster than the square of the frequency.
#[test]
fn sweeps_at_one_octave_per_minute_agree_with_harmonic_motions() {
    let frequencies = frequencies(0.1, 5.0, 13);
    for name in ["paper", "in-service", "reduced-vertical", "reduced-lateral"] {
        let damper = damper::load(name, &[]).unwrap();
        for amplitude_m in [1e-3, 5e-3] {
            let harmonic = at_amplitude(&damper, amplitude_m, &frequencies).unwrap();
            let swept = responses(&damper, amplitude_m, &frequencies, 1.0).unwrap();
            assert_eq!(swept.len(), harmonic.len());
            for (swept, harmonic) in swept.iter().zip(&harmonic) {
                let difference = swept.difference_from(harmonic).unwrap();
                let rise = std::f64::consts::LN_2 / 60.0 / harmonic.frequency_hz;
                let max = rise * rise / 6.0 + 1e-3;
                assert!(difference < max, "{name} {harmonic:?}: {difference:e}");
            }
        }
    }
}

#[test]
fn invalid_sweeps_are_rejected() {
    let damper = reduced(120e3, 8e6, 0.0);
    let sweep = |amplitude_m, frequencies_hz: &[f64], rate| {
        responses(&damper, amplitude_m, frequencies_hz, rate).unwrap_err()
    };
    for rate in [0.0, -1.0, f64::NAN, 1.5] {
        let refused = sweep(1e-3, &[0.1, 1.0], rate);
        assert!(
            matches!(refused, TestbenchError::SweepRate { .. }),
            "{rate}"
        );
    }
    let long = sweep(1e-3, &[0.1, 1000.0], 1e-3);
    assert!(matches!(long, TestbenchError::SweepSteps { .. }), "{long}");
    let large = sweep(2.0, &[1.0], 1.0);
    assert!(
        matches!(large, TestbenchError::Motion(HarmonicError::Amplitude(_))),
        "{large}"
    );
    let fast = sweep(0.1, &[1.0, 50.0], 1.0);
    assert!(matches!(fast, TestbenchError::Velocity { .. }), "{fast}");
    assert_eq!(responses(&damper, 1e-3, &[], 1.0).unwrap(), []);
}
