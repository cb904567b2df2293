//! Laws against numbers that follow from their published coefficients, and their limits.

use dashpot_rail::creep::Creepage;
use dashpot_rail::profile::s1002;
use dashpot_wear::{Archard, TGamma, Wear, WearGrid, WearLaw, WearingPatch};

/// A patch of half-ellipsoidal pressure that slides wholly in the rolling direction.
pub fn sliding(longitudinal: f64) -> WearingPatch {
    let (load_n, semi_axes_m) = (100e3, [6e-3, 8e-3]);
    let area_m2 = std::f64::consts::PI * semi_axes_m[0] * semi_axes_m[1];
    WearingPatch {
        load_n,
        peak_pressure_pa: 1.5 * load_n / area_m2,
        semi_axes_m,
        creepage: Creepage {
            longitudinal,
            ..Creepage::default()
        },
        wear_number_n: 0.3 * load_n * longitudinal.abs(),
        speed_m_per_s: 20.0,
        friction: 0.3,
    }
}

fn volume_m3(law: WearLaw, patch: &WearingPatch, distance_m: f64) -> f64 {
    let mut wear = Wear::new(WearGrid::new(&s1002::profile()), law);
    wear.add(0.0, patch, distance_m);
    wear.volume_m3()
}

fn is_near(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-9 * expected.abs(),
        "{found} for {expected}"
    );
}

#[test]
fn archard_removes_load_times_sliding_over_hardness() {
    let law = WearLaw::default();
    // Creepage of 0.5 % at 20 m/s: 0.1 m/s, mild; 2.5 %: 0.5 m/s, severe; 4.5 %: 0.9 m/s, mild.
    for (creepage, coefficient) in [(0.5e-2, 5.5e-4), (2.5e-2, 35e-4), (4.5e-2, 5.5e-4)] {
        let expected_m3 = coefficient * 100e3 * creepage * 1000.0 / 3e9;
        is_near(volume_m3(law, &sliding(creepage), 1000.0), expected_m3);
        is_near(volume_m3(law, &sliding(-creepage), 1000.0), expected_m3);
    }
}

#[test]
fn above_four_fifths_of_the_hardness_the_surfaces_seize() {
    let law = Archard::default();
    let mut patch = sliding(0.5e-2);
    let mild_m3 = volume_m3(WearLaw::Archard(law), &patch, 1.0);
    // The same load on a smaller area: 3 GPa in the middle, below 2.4 GPa beyond 0.6 of the width.
    patch.peak_pressure_pa = 3e9;
    let mixed_m3 = volume_m3(WearLaw::Archard(law), &patch, 1.0);
    // The load within 0.6 of the half-width is (3 * 0.6 - 0.6^3) / 2 = 0.792. Strips are a sixteenth wide.
    let expected = 0.792 * 350.0 / 5.5 + 0.208;
    assert!(
        (mixed_m3 / mild_m3 / expected - 1.0).abs() < 0.05,
        "{}",
        mixed_m3 / mild_m3
    );
}

#[test]
fn t_gamma_follows_the_three_regimes() {
    let law = WearLaw::TGamma(TGamma::default());
    let area_mm2 = std::f64::consts::PI * 6.0 * 8.0;
    // T gamma / A in N/mm^2, and ug/(m mm^2).
    for (work, rate) in [
        (1.0, 5.3),
        (10.0, 53.0),
        (40.0, 55.0),
        (80.0, 55.0 + 2.8 * 61.9),
    ] {
        let mut patch = sliding(1e-2);
        patch.wear_number_n = work * area_mm2;
        // Over 1 km: mass in kg, volume in m^3.
        let expected_m3 = rate * 1e-9 * area_mm2 * 1000.0 / 7850.0;
        is_near(volume_m3(law, &patch, 1000.0), expected_m3);
    }
    // The published regimes meet within a quarter of a percent.
    let [below, above] = [10.4e6 - 1.0, 10.4e6 + 1.0].map(TGamma::mass_rate_kg_per_m3);
    assert!((below / above - 1.0).abs() < 2.5e-3);
}

#[test]
fn a_patch_without_load_work_friction_or_sense_wears_nothing() {
    let good = sliding(1e-2);
    let spoilt: [fn(&mut WearingPatch, f64); 6] = [
        |patch, value| patch.load_n = value,
        |patch, value| patch.peak_pressure_pa = value,
        |patch, value| patch.semi_axes_m[0] = value,
        |patch, value| patch.semi_axes_m[1] = value,
        |patch, value| patch.wear_number_n = value,
        |patch, value| patch.friction = value,
    ];
    for law in [WearLaw::default(), WearLaw::TGamma(TGamma::default())] {
        assert!(volume_m3(law, &good, 1.0) > 0.0);
        for spoil in spoilt {
            for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
                let mut patch = good;
                spoil(&mut patch, value);
                assert_eq!(volume_m3(law, &patch, 1.0), 0.0, "{patch:?}");
            }
        }
        for distance_m in [0.0, -1.0, f64::NAN] {
            assert_eq!(volume_m3(law, &good, distance_m), 0.0);
        }
    }
}
