//! Fixed bug: a force limit above bulk modulus times area gave the oil a negative density, and the damper was built
//! with NaN in its table. It returned 0 N or jumped to the limit.

use dashpot::damper;
use dashpot::documented_damper::{changed_damper, documented_damper};
use dashpot::random_damper::Random;
use dashpot_core::parameters::{Element, TwoChamber};
use dashpot_core::{BuildError, CheckedParameters, Damper, DamperParameters};

fn with_limit(preset: &str, overrides: &[&str], force_n: f64) -> DamperParameters {
    let mut parameters = damper(preset, overrides);
    parameters.limits.force_n = force_n;
    parameters
}

/// Half the bulk modulus times the rod-side area, plus the seal friction.
fn bound_n(parameters: &DamperParameters) -> f64 {
    let Element::Physical(hydraulics) = &parameters.element else {
        panic!("a preset with oil");
    };
    let geometry = &hydraulics.geometry;
    let square = geometry.piston_diameter_m.powi(2) - geometry.rod_diameter_m.powi(2);
    let column = hydraulics.oil.column.expect("oil that is not rigid");
    let friction = hydraulics.seal.map_or(0.0, |seal| seal.friction_n);
    friction + 0.5 * column.bulk_modulus_pa * std::f64::consts::FRAC_PI_4 * square
}

#[test]
fn the_limits_of_the_report_are_refused_with_both_numbers() {
    for (overrides, force_n) in [(&[][..], 1e7), (&["oil.column.bulk_modulus_pa=3e8"], 1e6)] {
        let parameters = with_limit("in-service", overrides, force_n);
        let error = parameters.check().expect_err("a negative density");
        assert_eq!((error.section, error.field), ("limits", "force_n"));
        assert_eq!(error.value, force_n);
        let bound = error.bound.expect("the number it must not exceed");
        assert!((bound / bound_n(&parameters) - 1.0).abs() < 1e-9, "{bound}");
        let text = error.to_string();
        let numbers = [force_n.to_string(), bound.to_string()];
        assert!(numbers.iter().all(|number| text.contains(number)), "{text}");
        assert!(text.contains("oil.column.bulk_modulus_pa"), "{text}");
    }
}

#[test]
fn up_to_the_bound_forces_are_correct() {
    let bound = bound_n(&damper("in-service", &[]));
    assert!(
        with_limit("in-service", &[], 1.001 * bound)
            .check()
            .is_err()
    );
    let parameters = with_limit("in-service", &[], 0.999 * bound);
    let (at_bound, usual): (Damper<f64>, Damper<f64>) = (
        parameters.build(1e-3).expect("below the bound"),
        damper("in-service", &[]).build(1e-3).expect("a preset"),
    );
    let (mut one, mut other) = (at_bound.at_rest(0.0), usual.at_rest(0.0));
    for tick in 0..1000 {
        let x = 0.01 * (std::f64::consts::TAU * 4.8e-3 * f64::from(tick)).sin();
        let (one, other) = (at_bound.step(&mut one, x), usual.step(&mut other, x));
        assert!(
            (one - other).abs() < 1e-2 * other.abs() + 100.0,
            "{one} N for {other} N"
        );
    }
}

/// With two chambers, the piston side has the higher pressure; the force acts only on the rod's area there.
#[test]
fn two_chambers_are_bounded_by_the_piston_sides_pressure() {
    let mut parameters = with_limit("in-service", &[], 1e6);
    let lumped = parameters.check();
    let Element::Physical(hydraulics) = &mut parameters.element else {
        panic!("a preset with oil");
    };
    hydraulics.two_chamber = Some(TwoChamber::new(-9e4));
    // With a closed foot valve, the whole force acts on the rod's area.
    hydraulics.valves.foot_compression.edge_compliance_m_per_pa = Some(0.0);
    let bound = |checked: Result<CheckedParameters, BuildError>| checked.err()?.bound;
    let bounds = [lumped, parameters.check()].map(bound);
    assert!(bounds[0].is_none(), "{bounds:?}");
    assert!(bounds[1].is_some_and(|bound| bound < 1e6), "{bounds:?}");
    parameters.limits.force_n = bounds[1].expect("just checked");
    assert_finite(&parameters.check().expect("at the bound"), 1e-3);
}

/// Every damper within the documented ranges is refused or has a table of finite numbers. A search that climbs towards
/// the largest coefficients finds no exception.
#[test]
fn no_documented_damper_has_non_finite_constants() {
    let mut random = Random(26);
    let mut refused = 0;
    for _ in 0..1500 {
        let step_s = random.decades(1e-6, 2e-2);
        refused += u32::from(!assert_finite(&documented_damper(&mut random), step_s));
    }
    assert!(refused < 75, "{refused} of 1500 refused");
    for _ in 0..12 {
        let mut worst = documented_damper(&mut random);
        for _ in 0..60 {
            let other = changed_damper(&worst, &mut random);
            assert_finite(&other, 1e-6);
            if largest(&other) > largest(&worst) {
                worst = other;
            }
        }
    }
}

/// A relief valve opens exactly where boiling ends, so that only rounding separates the two corners. This also produced
/// NaN.
#[test]
fn corners_that_coincide_are_one() {
    let mut parameters = damper("in-service", &["two_chamber.vapour_pressure_pa=-16714.7"]);
    let Element::Physical(hydraulics) = &mut parameters.element else {
        panic!("a preset with oil");
    };
    // Only the relief valve passes oil.
    hydraulics.orifice.diameter_m = 0.0;
    hydraulics.leakage = None;
    hydraulics.valves.piston_compression.preload_pa = 1e8;
    hydraulics.valves.foot_compression.edge_compliance_m_per_pa = Some(1e-30);
    for opening_pa in [3e5, 1_079_558.4, 2e6, 3.3e6] {
        let Element::Physical(hydraulics) = &mut parameters.element else {
            panic!("a preset with oil");
        };
        if let Some(relief) = &mut hydraulics.relief {
            relief.opening_pressure_pa = opening_pa;
        }
        assert_finite(&parameters.check().expect("in range"), 1e-3);
    }
}

/// Builds a damper in both scalars; returns false if one was refused.
fn assert_finite(checked: &CheckedParameters, step_s: f64) -> bool {
    let single = checked.build::<f32>(step_s).map(|damper| {
        assert!(
            is_finite(&damper.to_words().map(f32::from_bits)),
            "{checked:?}"
        );
    });
    let double = checked.build::<f64>(step_s).map(|damper| {
        let words = damper.to_words().map(f64::from_bits);
        assert!(words.iter().all(|word| word.is_finite()), "{checked:?}");
    });
    assert!(double.is_ok(), "{double:?} of {checked:?} at {step_s} s");
    single.is_ok()
}

/// True if all words are finite, except the revisions, which are meaningless as `f32` values.
fn is_finite(words: &[f32]) -> bool {
    words
        .iter()
        .enumerate()
        .all(|(word, number)| number.is_finite() || (11..13).contains(&word))
}

/// Largest value of the table (1), which would overflow first.
fn largest(checked: &CheckedParameters) -> f64 {
    let damper: Damper<f64> = checked.build(1e-6).expect("just built");
    let words = damper.to_words();
    words
        .into_iter()
        .map(f64::from_bits)
        .filter(|word| word.is_finite() && *word < 1e300)
        .fold(0.0, |a, b| a.max(b.abs()))
}
