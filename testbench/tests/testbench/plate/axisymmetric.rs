//! Axisymmetric pressure: compares uniform pressure with the closed form, and other profiles with statics.

use std::f64::consts::TAU;

use dashpot_core::shim::Disc;
use dashpot_testbench::plate::{PressureArea, Profile, Resolution, RoundBosses, Stacking};

use super::{RADII_M, stack, stack_of};

const NU: f64 = 0.3;

/// Error of the edge deflection relative to `Cw P/h^3`.
fn edge_error(clamp_m: f64, free_m: f64, elements: usize) -> f64 {
    let stack = stack(clamp_m, free_m, &[0.3e-3]);
    let resolution = Resolution {
        elements,
        harmonics: 0,
    };
    let whole = PressureArea::whole(clamp_m, free_m);
    stack.correction_factor(&whole, resolution).unwrap() - 1.0
}

/// The deflection agrees with `Cw(r)` of the core at every radius, within 1e-4 of the edge value with eight elements
/// and within 1e-7 with the default number.
#[test]
fn uniform_pressure_gives_the_closed_form_at_every_radius() {
    for (clamp, free) in RADII_M {
        let disc = Disc::new("disc", clamp, free, 2e11, NU).unwrap();
        let thickness = 0.305e-3_f64;
        let stack = stack(clamp, free, &[thickness]);
        for (elements, within) in [(8, 1e-4), (96, 1e-7)] {
            let resolution = Resolution {
                elements,
                harmonics: 0,
            };
            let bending = stack.bend(&PressureArea::whole(clamp, free), resolution);
            let bending = bending.unwrap();
            let edge = disc.deflection_coefficient(free) / thickness.powi(3);
            for i in 0..=40 {
                let r = clamp + (free - clamp) * f64::from(i) / 40.0;
                let expected = disc.deflection_coefficient(r) / thickness.powi(3);
                let found = bending.deflection_m_per_pa(r, 0.0);
                let error = (found - expected) / edge;
                assert!(error.abs() < within, "{elements} at {r}: {error:e}");
            }
        }
    }
}

/// The deflection of cubic elements converges with the fourth power of their length.
#[test]
fn deflection_converges_with_the_fourth_power() {
    for (clamp, free) in RADII_M {
        for elements in [2, 4, 8] {
            let coarse = edge_error(clamp, free, elements);
            let fine = edge_error(clamp, free, 2 * elements);
            let order = (coarse / fine).abs().log2();
            println!("{clamp} to {free} m, {elements} elements: {coarse:e}, order {order:.2}");
            assert!((3.7..4.3).contains(&order), "{elements}: {order}");
        }
    }
}

/// Roark's Formulas for Stress and Strain, table 11.2, case 2l: `K_y` and `K_M` at r_n/r_w, nu = 0.3.
#[test]
fn deflection_and_clamp_stress_are_roarks() {
    for (ratio, deflection, moment) in [
        (0.1, 0.07569, 0.9646),
        (0.3, 0.03182, 0.4103),
        (0.5, 0.008589, 0.1736),
        (0.7, 0.001096, 0.0541),
    ] {
        let (free, thickness) = (0.02_f64, 0.2e-3);
        let stack = stack(ratio * free, free, &[thickness]);
        let whole = PressureArea::whole(ratio * free, free);
        // The curvature is linear within an element, so four digits need many elements.
        let resolution = Resolution {
            elements: 300,
            harmonics: 0,
        };
        let bending = stack.bend(&whole, resolution).unwrap();
        let scale = free.powi(4) / stack.bending_stiffness_n_m();
        let found = bending.mean_edge_lift_m_per_pa() / scale;
        assert!((found - deflection).abs() < 5e-6, "K_y at {ratio}: {found}");
        let stress = stack.surface_stress(bending.curvature(ratio * free, 0.0));
        // sigma = 6 M/h^2.
        let found = stress.radial * thickness * thickness / (6.0 * free * free);
        assert!(
            (found.abs() - moment).abs() < 6e-5,
            "K_M at {ratio}: {found}"
        );
        // At a clamp there is no tangential curvature, so s_t = nu s_r.
        assert!((stress.tangential / stress.radial - NU).abs() < 1e-6);
    }
}

/// Returns the edge deflection by statics alone.
///
/// The shear force at r carries the pressure outside r, `q(r) = -1/r int_r^rw p s ds`, and the slope f follows from
/// `D ((r f)'/r)' = -q`, both by the trapezoidal rule. Boundary conditions: `f(r_n) = 0`, and no moment at the edge,
/// `f' + nu f/r = 0`.
pub fn edge_by_statics(clamp: f64, free: f64, pressure: impl Fn(f64) -> f64) -> f64 {
    const STEPS: usize = 40_000;
    let step = (free - clamp) / STEPS as f64;
    let radius = |i: usize| clamp + step * i as f64;
    let cumulative = |values: &[f64]| {
        let mut sum = vec![0.0];
        for pair in values.windows(2) {
            sum.push(sum[sum.len() - 1] + 0.5 * step * (pair[0] + pair[1]));
        }
        sum
    };
    let loads: Vec<f64> = (0..=STEPS)
        .map(|i| pressure(radius(i)) * radius(i))
        .collect();
    let inside = cumulative(&loads);
    let shear: Vec<f64> = (0..=STEPS)
        .map(|i| (inside[STEPS] - inside[i]) / radius(i))
        .collect();
    // (r f)'/r = c - int shear: combines the solution for c = 0 with the one without shear for c = 1.
    let bent = cumulative(&shear);
    let solution = |curvature: &dyn Fn(usize) -> f64| {
        let grown: Vec<f64> = (0..=STEPS).map(|i| curvature(i) * radius(i)).collect();
        let slope: Vec<f64> = cumulative(&grown)
            .iter()
            .enumerate()
            .map(|(i, grown)| grown / radius(i))
            .collect();
        // f' + nu f/r = (r f)'/r - (1 - nu) f/r.
        let moment = curvature(STEPS) - (1.0 - NU) * slope[STEPS] / free;
        (cumulative(&slope)[STEPS], moment)
    };
    let (forced, forced_moment) = solution(&|i| -bent[i]);
    let (homogeneous, homogeneous_moment) = solution(&|_| 1.0);
    forced - forced_moment / homogeneous_moment * homogeneous
}

#[test]
fn rings_and_decays_agree_with_statics() {
    let (clamp, free) = RADII_M[0];
    let stack = stack(clamp, free, &[0.4e-3, 0.3e-3]);
    let stiffness = stack.bending_stiffness_n_m();
    for profile in [
        Profile::full(clamp, free),
        Profile::full(19e-3, 25e-3),
        Profile::full(27e-3, free),
        Profile {
            full_m: [20e-3, 22e-3],
            ends_m: [clamp, free],
            exponent: 2.0,
        },
        Profile {
            full_m: [18e-3, 24e-3],
            ends_m: [17e-3, 28.5e-3],
            exponent: 1.0,
        },
    ] {
        let area = PressureArea::Ring(profile);
        let found = stack.mean_edge_lift_m_per_pa(&area, Resolution::default());
        let expected = edge_by_statics(clamp, free, |r| profile.at(r)) / stiffness;
        let error = found.unwrap() / expected - 1.0;
        // The rule resolves a jump of pressure to within half a step.
        assert!(error.abs() < 2e-4, "{profile:?}: {error:e}");
    }
}

/// The mean lift under round bosses follows from their pressure averaged around the circumference.
#[test]
fn round_bosses_agree_with_statics_of_their_mean() {
    let (clamp, free) = RADII_M[0];
    let area = PressureArea::Round(RoundBosses {
        count: 6,
        pitch_radius_m: 22e-3,
        hole_radius_m: 4e-3,
        boss_radius_m: 5.5e-3,
        exponent: 2.0,
    });
    const ANGLES: u32 = 2000;
    // One of six bosses.
    let mean = |r: f64| {
        let angles = (0..ANGLES).map(|i| TAU / 6.0 * (f64::from(i) + 0.5) / f64::from(ANGLES));
        angles.map(|angle| area.at(r, angle)).sum::<f64>() / f64::from(ANGLES)
    };
    // The radii are close enough for linear interpolation of the mean.
    let step = (free - clamp) / 1000.0;
    let table: Vec<f64> = (0..=1000)
        .map(|i| mean(clamp + step * f64::from(i)))
        .collect();
    let between = |r: f64| {
        let place = ((r - clamp) / step).clamp(0.0, 999.999);
        let (i, part) = (place as usize, place.fract());
        table[i] + part * (table[i + 1] - table[i])
    };
    let stack = stack(clamp, free, &[0.4e-3]);
    let expected = edge_by_statics(clamp, free, between) / stack.bending_stiffness_n_m();
    let found = stack.mean_edge_lift_m_per_pa(&area, Resolution::default());
    let error = found.unwrap() / expected - 1.0;
    println!("{error:e}");
    assert!(error.abs() < 1e-4, "{error:e}");
}

/// The stiffnesses of sliding discs add up, as do the thicknesses of bonded discs; the stress follows from the
/// thickness that bends.
#[test]
fn stacking_determines_stiffness_and_stress() {
    let (clamp, free) = RADII_M[1];
    let (thin, thick) = (0.2e-3_f64, 0.4e-3_f64);
    let whole = PressureArea::whole(clamp, free);
    let solve = |discs: &[f64], stacking| {
        let stack = stack_of(clamp, free, discs, stacking);
        let bending = stack.bend(&whole, Resolution::default()).unwrap();
        let largest = stack.largest_stress(&bending);
        (bending.mean_edge_lift_m_per_pa(), largest)
    };
    let (one, alone) = solve(&[thick], Stacking::Sliding);
    let (sliding, shared) = solve(&[thin, thick], Stacking::Sliding);
    let (bonded, whole_stack) = solve(&[thin, thick], Stacking::Bonded);
    let cubes = thin.powi(3) + thick.powi(3);
    assert!((sliding / one * cubes / thick.powi(3) - 1.0).abs() < 1e-9);
    assert!((bonded / one * ((thin + thick) / thick).powi(3) - 1.0).abs() < 1e-9);
    // M_i = M h_i^3/sum h^3, s_i = 6 M_i/h_i^2.
    let ratio = shared.von_mises_per_pressure / alone.von_mises_per_pressure;
    assert!((ratio * cubes / thick.powi(3) - 1.0).abs() < 1e-9);
    let ratio = whole_stack.von_mises_per_pressure / alone.von_mises_per_pressure;
    assert!((ratio * ((thin + thick) / thick).powi(2) - 1.0).abs() < 1e-9);
    assert_eq!(shared.discs, [2]);
    assert_eq!(whole_stack.discs, [1, 2]);
    assert_eq!(alone.radius_m, clamp);
}
