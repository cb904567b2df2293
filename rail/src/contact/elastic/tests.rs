//! Patches of smooth bodies against Hertz, and cases without a patch.

use super::gap::Gap;
use super::normal::{Given, NormalContact};
use super::strips::Strip;
use crate::contact::{Hertz, Installation, Pair, Steel};

/// Strips of 0.2 mm on a cylinder of `radius_m` over a rail head of `across_m`, and their heights.
fn cylinder(radius_m: f64, across_m: f64) -> Gap {
    let at = |k: i32| 0.2e-3 * f64::from(k);
    let strips = (-100..=100).map(|k| Strip::flat(at(k), 0.2e-3, radius_m));
    let heights = (-100..=100).map(|k| -0.5 * at(k) * at(k) / across_m);
    Gap::of(strips.collect(), heights.collect())
}

impl NormalContact {
    fn load_n(&self, strips: &[Strip]) -> f64 {
        let loads = self.loaded.iter().zip(&self.line_loads);
        loads.map(|(&i, load)| load * strips[i].width_m).sum()
    }
}

#[test]
fn patches_of_smooth_bodies_are_hertzs() {
    let pair = Pair::standard(Installation::default()).unwrap();
    let steel = Steel::default();
    for (radius_m, across_m) in [
        (0.46, 0.3),
        (0.625, 0.08),
        (0.5, 0.5),
        (0.46, 2.0),
        (0.6, 0.02),
    ] {
        let hertz = Hertz::new(&steel, 1.0 / radius_m, 1.0 / across_m);
        for load_n in [20e3, 100e3] {
            let gap = cylinder(radius_m, across_m);
            let mut contact = NormalContact::default();
            contact.solve(&gap, &steel, Given::LoadN(load_n));
            let penetration_m = hertz.penetration_m(load_n);
            let [a_m, b_m] = hertz.semi_axes_m(penetration_m);
            let pressure_pa = 1.5 * load_n / (std::f64::consts::PI * a_m * b_m);
            let patch = contact.patches(&gap, &pair, &[-1.0, 1.0, 2.0])[1];
            let case = format!("{radius_m} m, {across_m} m, {load_n} N: {patch:?}");
            let error = |found: f64, expected: f64| (found / expected - 1.0).abs();
            assert!(error(contact.depth_m, penetration_m) < 0.01, "{case}");
            assert!(error(patch.semi_axes_m[0], a_m) < 0.03, "{case}");
            assert!(error(patch.semi_axes_m[1], b_m) < 0.05, "{case}");
            assert!(error(patch.peak_pressure_pa, pressure_pa) < 0.03, "{case}");
            assert!(error(patch.load_n, load_n) < 1e-9, "{case}");
            assert!(patch.wheel_y_m.abs() < 1e-9 && patch.slope == 0.0, "{case}");
        }
    }
}

#[test]
fn a_depth_gives_the_load_that_gives_this_depth() {
    let steel = Steel::default();
    let gap = cylinder(0.46, 0.3);
    let mut contact = NormalContact::default();
    contact.solve(&gap, &steel, Given::LoadN(75e3));
    let mut again = NormalContact::default();
    again.solve(&gap, &steel, Given::DepthM(contact.depth_m));
    assert!((again.load_n(&gap.strips) / 75e3 - 1.0).abs() < 1e-3);
}

#[test]
fn wheels_apart_from_the_rail_carry_nothing() {
    let steel = Steel::default();
    let gap = cylinder(0.46, 0.3);
    let mut contact = NormalContact::default();
    contact.solve(&gap, &steel, Given::DepthM(-1e-6));
    assert_eq!(contact.load_n(&gap.strips), 0.0);
    contact.solve(
        &Gap::of(
            gap.strips.clone(),
            vec![f64::NEG_INFINITY; gap.strips.len()],
        ),
        &steel,
        Given::LoadN(1e5),
    );
    assert_eq!(contact.load_n(&gap.strips), 0.0);
    // The next solution does not suffer from it.
    contact.solve(&gap, &steel, Given::LoadN(1e5));
    assert!((contact.load_n(&gap.strips) / 1e5 - 1.0).abs() < 1e-9);
}

#[test]
fn a_load_that_is_no_load_gives_no_patch() {
    let pair = Pair::standard(Installation::default()).unwrap();
    let gap = cylinder(0.46, 0.3);
    for given in [0.0, -1.0, f64::NAN, f64::INFINITY].map(Given::LoadN) {
        let mut contact = NormalContact::default();
        contact.solve(&gap, &Steel::default(), given);
        let patches = contact.patches(&gap, &pair, &[-1.0, 1.0, 2.0]);
        assert!(
            patches.iter().all(|patch| *patch == Default::default()),
            "{given:?}: {patches:?}"
        );
    }
}
