//! Energy per cycle of power-law dampers. For `F = c v^n` under a harmonic motion, `E = 4 F x0 W(n + 1)`, where `W(m)`
//! is Wallis' integral of cos^m over a quarter turn. The energy factor is `E/(pi F x0) = 4 W(n + 1)/pi`.

use std::f64::consts::PI;

use dashpot::bench_test::{Harmonic, settled_cycle};
use dashpot::damper;

/// The paper's nominal motion (Table 5).
const NOMINAL: Harmonic = Harmonic {
    amplitude_m: 24.875e-3,
    frequency_hz: 0.64,
};

/// Springs so stiff that the piston follows the whole motion of the seats.
const STIFF: &str = "mount.stiffness_n_per_m=1e10";

/// `4 W(n + 1)/pi` with `W(m) = sqrt(pi)/2 Gamma((m + 1)/2)/Gamma(m/2 + 1)`.
fn factor(exponent: f64) -> f64 {
    let m = exponent + 1.0;
    2.0 / PI.sqrt() * libm::tgamma(0.5 * (m + 1.0)) / libm::tgamma(0.5 * m + 1.0)
}

fn measured(preset: &str, overrides: &[&str]) -> f64 {
    let parameters = damper(preset, overrides);
    settled_cycle(&parameters, NOMINAL, 1e-4).energy_factor(NOMINAL.amplitude_m)
}

#[test]
fn the_closed_form_has_the_known_values() {
    let known = [
        (0.6, 1.087),
        (2.0 / 3.0, 1.071),
        (0.8, 1.041),
        (0.9, 1.020),
        (1.0, 1.000),
        (1.18, 0.967),
    ];
    for (exponent, expected) in known {
        assert!((factor(exponent) - expected).abs() < 6e-4, "n = {exponent}");
    }
    assert!((factor(2.0) - 8.0 / (3.0 * PI)).abs() < 1e-14);
}

#[test]
fn orifice_alone_is_square_in_velocity() {
    let closed_valves = [
        STIFF,
        "valves.piston_extension.edge_compliance_m_per_pa=0.0",
        "valves.piston_compression.edge_compliance_m_per_pa=0.0",
        "valves.foot_compression.edge_compliance_m_per_pa=0.0",
        "orifice.diameter_m=6e-3",
    ];
    let found = measured("paper", &closed_valves);
    assert!((found / factor(2.0) - 1.0).abs() < 2e-5, "{found}");
}

#[test]
fn shim_valves_alone_go_with_velocity_to_two_thirds() {
    // Q ~ P^1.5, so F ~ v^(2/3).
    let found = measured("paper", &[STIFF, "orifice.diameter_m=0.0"]);
    assert!((found / factor(2.0 / 3.0) - 1.0).abs() < 2e-5, "{found}");
}

#[test]
fn leakage_alone_is_linear() {
    let found = measured(
        "paper",
        &[
            STIFF,
            "orifice.diameter_m=0.0",
            "valves.piston_extension.edge_compliance_m_per_pa=0.0",
            "valves.piston_compression.edge_compliance_m_per_pa=0.0",
            "valves.foot_compression.edge_compliance_m_per_pa=0.0",
            "leakage.radial_clearance_m=1e-4",
            "leakage.length_m=0.03",
        ],
    );
    assert!((found - 1.0).abs() < 2e-5, "{found}");
}

#[test]
fn the_reduced_element_is_linear_below_saturation() {
    let found = measured(
        "reduced-vertical",
        &[
            STIFF,
            "mount.clearance_m=0.0",
            "reduced.saturation_velocity_m_per_s=0.2",
        ],
    );
    assert!((found - 1.0).abs() < 2e-5, "{found}");
}

#[test]
fn a_saturated_element_dissipates_a_trapezium() {
    // C = 120 kN s/m and V_r = 0.03 m/s, driven at v0 = 0.1 m/s. With s = V_r/v0,
    // E = 4 F_r x0 [cos(asin s) + (asin s - s cos(asin s))/(2 s)].
    let velocity = 2.0 * PI * NOMINAL.frequency_hz * NOMINAL.amplitude_m;
    let share = 0.03 / velocity;
    let angle = share.asin();
    let expected = 4.0 / PI * (angle.cos() + (angle - share * angle.cos()) / (2.0 * share));
    let found = measured("reduced-vertical", &[STIFF, "mount.clearance_m=0.0"]);
    assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
}

#[test]
fn clearance_takes_its_share_of_the_stroke() {
    // After each dead centre the piston rests while the seats cross the play 2a, up to the angle p with
    // cos p = 1 - 2a/x0. Below saturation, this part of a half stroke would have dissipated
    // F_r x0/s (p/2 - sin(2p)/4), with s = V_r/v0.
    let share = 0.03 / (2.0 * PI * NOMINAL.frequency_hz * NOMINAL.amplitude_m);
    let angle = (1.0 - 1e-3 / NOMINAL.amplitude_m).acos();
    assert!(angle.sin() < share, "the play is over before saturation");
    let lost = 2.0 / (PI * share) * (angle / 2.0 - (2.0 * angle).sin() / 4.0);
    let found = measured("reduced-vertical", &[STIFF]);
    let without = measured("reduced-vertical", &[STIFF, "mount.clearance_m=0.0"]);
    assert!(((without - found) / lost - 1.0).abs() < 1e-2);
}
