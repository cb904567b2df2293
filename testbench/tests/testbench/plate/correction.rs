//! The correction factor Ce.

use dashpot_testbench::plate::{
    Bosses, PlateError, PressureArea, Profile, Resolution, RoundBosses, fitted_boss_radius_m,
    fitted_decay_width_m, fitted_full_radius_m, fitted_share,
};

use super::axisymmetric::edge_by_statics;
use super::paper_stacks;

/// Ce of Tables 2 to 4.
const PUBLISHED: [f64; 3] = [0.2169, 0.2000, 0.8265];

/// Checks the fitted radii stated in docs/shims.md.
///
/// Each fitted pressure must have the published factor, both by plate theory and by statics.
#[test]
fn fitted_decays_have_the_factor_of_the_foot_valve() {
    let [_, _, foot] = paper_stacks();
    let (clamp, free) = (5e-3, 11e-3);
    let uniform = edge_by_statics(clamp, free, |_| 1.0);
    let check = |full_m: [f64; 2], exponent: f64| {
        let profile = Profile {
            full_m,
            ends_m: [clamp, free],
            exponent,
        };
        let area = PressureArea::Ring(profile);
        let factor = foot.correction_factor(&area, Resolution::default());
        assert!((factor.unwrap() - PUBLISHED[2]).abs() < 1e-7);
        let by_statics = edge_by_statics(clamp, free, |r| profile.at(r)) / uniform;
        assert!((by_statics - PUBLISHED[2]).abs() < 1e-4, "{by_statics}");
    };
    for (exponent, documented) in [(1.0, 10.238e-3), (2.0, 10.436e-3), (3.0, 10.501e-3)] {
        let full = fitted_full_radius_m(&foot, exponent, PUBLISHED[2], Resolution::default());
        let full = full.unwrap();
        println!("exponent {exponent}: full up to {full} m");
        assert!((full - documented).abs() < 1e-6);
        check([clamp, full], exponent);
    }
    let width = fitted_decay_width_m(&foot, 2.0, PUBLISHED[2], Resolution::default()).unwrap();
    println!("on both sides over {width} m");
    assert!((width - 0.5626e-3).abs() < 1e-7);
    check([clamp + width, free - width], 2.0);
}

/// Both piston valves have discs of the same radii. Thin plates under the same pressure area then have the same factor,
/// so the two published factors require two different pressure areas.
#[test]
fn the_factor_does_not_depend_on_thickness() {
    let [extension, compression, _] = paper_stacks();
    let area = PressureArea::Round(RoundBosses {
        count: 6,
        pitch_radius_m: 22.5e-3,
        hole_radius_m: 3e-3,
        boss_radius_m: 5e-3,
        exponent: 2.0,
    });
    let of = |stack: &dashpot_testbench::plate::Stack| {
        stack
            .correction_factor(&area, Resolution::default())
            .unwrap()
    };
    assert!((of(&extension) / of(&compression) - 1.0).abs() < 1e-12);
}

#[test]
fn fitted_bosses_have_the_published_factors() {
    let resolution = Resolution::default();
    let [extension, compression, _] = paper_stacks();
    for (stack, factor) in [(extension, PUBLISHED[0]), (compression, PUBLISHED[1])] {
        let bosses = RoundBosses {
            count: 6,
            pitch_radius_m: 23.5e-3,
            hole_radius_m: 0.0,
            boss_radius_m: 1e-3,
            exponent: 2.0,
        };
        let boss_radius_m = fitted_boss_radius_m(&stack, bosses, 0.75, factor, resolution).unwrap();
        let area = PressureArea::Round(RoundBosses {
            hole_radius_m: 0.75 * boss_radius_m,
            boss_radius_m,
            ..bosses
        });
        let found = stack.correction_factor(&area, resolution).unwrap();
        assert!((found - factor).abs() < 1e-7, "{found}");
        let profile = Profile::full(18e-3, 27e-3);
        let share = fitted_share(&stack, profile, factor, resolution).unwrap();
        // The mean lift depends on the share of the bosses, not on their number.
        for count in [2, 6, 12] {
            let sectors = PressureArea::Sectors(Bosses {
                count,
                share,
                profile,
            });
            let bending = stack.bend(&sectors, resolution).unwrap();
            let uniform = stack.uniform_edge_lift_m_per_pa();
            let found = bending.mean_edge_lift_m_per_pa() / uniform;
            assert!((found - factor).abs() < 1e-7, "{count}: {found}");
        }
    }
}

#[test]
fn an_unreachable_factor_is_reported_with_the_allowed_range() {
    let [extension, ..] = paper_stacks();
    let narrow = Profile::full(16e-3, 18e-3);
    let error = fitted_share(&extension, narrow, 0.2, Resolution::default()).unwrap_err();
    assert!(matches!(error, PlateError::OutOfReach { max, .. } if max < 0.2));
    let error = fitted_full_radius_m(&extension, 2.0, 1.5, Resolution::default()).unwrap_err();
    assert!(error.to_string().contains("1.5, allowed: "), "{error}");
}
