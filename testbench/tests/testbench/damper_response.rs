//! Frequency response of dampers, compared with closed forms.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::{DamperParameters, Element, Mount};

use dashpot_files::damper;
use dashpot_files::harmonic::Harmonic;
use dashpot_files::harmonic::HarmonicError;
use dashpot_testbench::TestbenchError;
use dashpot_testbench::bench_test::run_until_periodic;
use dashpot_testbench::response::{at_amplitude, linearised};

const DAMPING: f64 = 120e3;

/// A reduced damper whose limits the motions do not reach.
fn reduced(
    damping: f64,
    saturation_m_per_s: f64,
    stiffness: f64,
    clearance_m: f64,
) -> CheckedParameters {
    let mut mount = Mount::new(stiffness);
    mount.clearance_m = clearance_m;
    let mut parameters = DamperParameters::reduced(damping, saturation_m_per_s, mount);
    parameters.limits.force_n = 1e7;
    parameters.check().unwrap()
}

/// `C i w/(1 + i w C/K)`.
#[test]
fn without_saturation_and_clearance_a_reduced_damper_is_a_maxwell_element() {
    for stiffness in [2e6, 8e6, 40e6] {
        let damper = reduced(DAMPING, 10.0, stiffness, 0.0);
        for found in at_amplitude(&damper, 2e-3, &[0.2, 1.0, 5.0, 25.0]).unwrap() {
            let dashpot = DAMPING * TAU * found.frequency_hz;
            let ratio = dashpot / stiffness;
            let magnitude = dashpot / (1.0 + ratio * ratio).sqrt();
            assert!((found.stiffness_n_per_m() / magnitude - 1.0).abs() < 1e-3);
            assert!((found.phase_rad() - (FRAC_PI_2 - ratio.atan())).abs() < 1e-3);
            let damping = DAMPING / (1.0 + ratio * ratio);
            assert!((found.damping_n_s_per_m() / damping - 1.0).abs() < 1e-3);
            let over_velocity = magnitude / (TAU * found.frequency_hz);
            assert!((found.impedance_n_s_per_m() / over_velocity - 1.0).abs() < 1e-3);
        }
    }
}

/// With a nearly rigid dashpot, a spring `K` in series with a dead zone of half-width `a` has the stiffness
/// `K (1 - 2/pi (asin(a/A) + a/A sqrt(1 - (a/A)^2)))`, in phase with the displacement.
#[test]
fn a_clearance_is_a_dead_zone() {
    let (stiffness, half_m) = (1e6, 0.5e-3);
    let damper = reduced(1e9, 100.0, stiffness, 2.0 * half_m);
    for ratio in [0.9, 0.5, 0.25] {
        let found = at_amplitude(&damper, half_m / ratio, &[100.0]).unwrap()[0];
        let root = (1.0 - ratio * ratio).sqrt();
        let expected = stiffness * (1.0 - 2.0 / PI * (f64::asin(ratio) + ratio * root));
        assert!(
            (found.stiffness_n_per_m() / expected - 1.0).abs() < 1e-3,
            "{ratio}: {found:?} for {expected}"
        );
        assert!(found.phase_rad().abs() < 1e-3, "{found:?}");
    }
    // Within the clearance there is no force.
    let within = at_amplitude(&damper, 0.9 * half_m, &[100.0]).unwrap()[0];
    assert_eq!(within.stiffness_n_per_m(), 0.0);
    // With the clearance taken up, only the spring remains.
    let linear = linearised(&damper, &[100.0]).unwrap()[0];
    assert!((linear.stiffness_n_per_m() / stiffness - 1.0).abs() < 1e-3);
}

/// With a nearly rigid mount, a dashpot `C` that saturates at `V_r` has, at the peak velocity `V`, the damping
/// `C 2/pi (asin(V_r/V) + V_r/V sqrt(1 - (V_r/V)^2))`.
#[test]
fn a_saturation_is_a_relay_with_a_slope() {
    let (saturation, frequency) = (0.03, 2.0);
    let damper = reduced(DAMPING, saturation, 1e12, 0.0);
    for ratio in [0.95, 0.5, 0.1] {
        let amplitude = saturation / ratio / (TAU * frequency);
        let found = at_amplitude(&damper, amplitude, &[frequency]).unwrap()[0];
        let root = (1.0 - ratio * ratio).sqrt();
        let expected = DAMPING * 2.0 / PI * (f64::asin(ratio) + ratio * root);
        assert!(
            (found.damping_n_s_per_m() / expected - 1.0).abs() < 1e-3,
            "{ratio}: {found:?} for {expected}"
        );
        assert!((found.phase_rad() - FRAC_PI_2).abs() < 1e-2, "{found:?}");
    }
    let linear = linearised(&damper, &[frequency]).unwrap()[0];
    assert!((linear.damping_n_s_per_m() / DAMPING - 1.0).abs() < 1e-3);
}

/// Other harmonics do no work, so the energy per cycle is `pi A^2 K''` even for a damper with all laws.
#[test]
fn loss_stiffness_gives_the_energy_per_cycle() {
    let damper = damper::load("in-service", &[]).unwrap();
    assert!(matches!(damper.element, Element::Physical(_)));
    let motion = Harmonic {
        amplitude_m: 5e-3,
        frequency_hz: 1.5,
    };
    let found = at_amplitude(&damper, motion.amplitude_m, &[motion.frequency_hz]).unwrap()[0];
    let energy = PI * motion.amplitude_m.powi(2) * found.loss_n_per_m;
    let cycle = run_until_periodic(&damper, motion, 1e-4).unwrap();
    let expected = cycle.indices().energy_per_cycle_j;
    assert!(
        (energy / expected - 1.0).abs() < 1e-3,
        "{energy} for {expected}"
    );
    // The damper is nonlinear: its clearance makes it softer at small amplitudes.
    let less = at_amplitude(&damper, 1e-3, &[motion.frequency_hz]).unwrap()[0];
    assert!(less.stiffness_n_per_m() < 0.9 * found.stiffness_n_per_m());
}

#[test]
fn an_invalid_motion_is_rejected() {
    let damper = reduced(DAMPING, 0.03, 8e6, 0.0);
    assert!(matches!(
        at_amplitude(&damper, 0.0, &[1.0]),
        Err(TestbenchError::Motion(HarmonicError::Amplitude(_)))
    ));
    assert!(matches!(
        at_amplitude(&damper, 1e-3, &[f64::NAN]),
        Err(TestbenchError::Motion(HarmonicError::Frequency(_)))
    ));
    assert!(matches!(
        linearised(&damper, &[0.0]),
        Err(TestbenchError::Motion(HarmonicError::Frequency(_))
            | TestbenchError::Motion(HarmonicError::Amplitude(_)))
    ));
}
