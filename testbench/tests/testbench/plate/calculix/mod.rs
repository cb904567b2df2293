//! Comparison with CalculiX (Debian `calculix-ccx`), whose solid elements do not assume a thin plate.

mod deck;
mod discs;
mod quarter;

use std::f64::consts::TAU;

use dashpot_testbench::plate::{Bosses, PressureArea, Profile, Resolution, Stacking};
use deck::Geometry;
use discs::{Contact, edge_deflections};
use quarter::quarter;
use xtask::tools::{CALCULIX, have};

use super::stack_of;

/// Radii of the piston and foot discs (mm).
const PISTON: [f64; 2] = [16.0, 29.0];
const FOOT: [f64; 2] = [5.0, 11.0];

/// Returns the edge deflection of each disc by CalculiX divided by ours, under uniform pressure (MPa).
fn over_ours(
    radii: [f64; 2],
    discs_mm: &[f64],
    stacking: Stacking,
    pressure_mpa: f64,
    geometry: Geometry,
) -> Vec<f64> {
    let [clamp, free] = radii.map(|mm| mm * 1e-3);
    let discs: Vec<f64> = discs_mm.iter().map(|mm| mm * 1e-3).collect();
    let stack = stack_of(clamp, free, &discs, stacking);
    let whole = PressureArea::whole(clamp, free);
    let ours = stack.mean_edge_lift_m_per_pa(&whole, Resolution::default());
    let ours_mm = ours.unwrap() * pressure_mpa * 1e9;
    let contact = match stacking {
        Stacking::Sliding => Contact::Sliding,
        Stacking::Bonded => Contact::Bonded,
    };
    let theirs = edge_deflections(radii, discs_mm, contact, pressure_mpa, geometry);
    let ratios: Vec<f64> = theirs.iter().map(|mm| mm / ours_mm).collect();
    println!("{radii:?} mm, {discs_mm:?} mm, {stacking:?}: {ratios:.5?}");
    ratios
}

fn within(ratios: &[f64], fraction: f64) {
    for ratio in ratios {
        assert!((ratio - 1.0).abs() < fraction, "{ratio}");
    }
}

#[test]
fn a_single_disc_is_within_half_a_percent() {
    if !have(&[CALCULIX], "shims compared with CalculiX: one disc") {
        return;
    }
    for (radii, thickness) in [(PISTON, 0.305), (PISTON, 0.410), (FOOT, 0.305)] {
        let ratios = over_ours(
            radii,
            &[thickness],
            Stacking::Sliding,
            1e-3,
            Geometry::Linear,
        );
        within(&ratios, 5e-3);
    }
}

/// All discs of a frictionless stack deflect according to `sum h^3`, including those of the piston extension valve.
#[test]
fn sliding_stacks_are_within_half_a_percent() {
    if !have(&[CALCULIX], "shims compared with CalculiX: sliding stacks") {
        return;
    }
    for discs in [
        &[0.305, 0.405][..],
        &[0.405, 0.405, 0.405, 0.410, 0.410, 0.410, 0.410],
    ] {
        let ratios = over_ours(PISTON, discs, Stacking::Sliding, 1e-2, Geometry::Linear);
        assert_eq!(ratios.len(), discs.len());
        within(&ratios, 5e-3);
    }
}

#[test]
fn a_thin_bonded_stack_is_within_half_a_percent() {
    if !have(&[CALCULIX], "shims compared with CalculiX: bonded stacks") {
        return;
    }
    let ratios = over_ours(
        PISTON,
        &[0.2, 0.3],
        Stacking::Bonded,
        1e-3,
        Geometry::Linear,
    );
    within(&ratios, 5e-3);
}

/// Plate theory neglects the shear of thick plates, such as the bonded discs of the piston extension valve, and the
/// tension in the middle plane at large deflections.
#[test]
fn plate_theory_fails_for_thick_discs_and_large_deflections() {
    if !have(
        &[CALCULIX],
        "shims compared with CalculiX: limits of plate theory",
    ) {
        return;
    }
    let discs = [0.405, 0.405, 0.405, 0.410, 0.410, 0.410, 0.410];
    let thick = over_ours(PISTON, &discs, Stacking::Bonded, 1.0, Geometry::Linear);
    assert!(thick.iter().all(|ratio| (1.05..1.065).contains(ratio)));
    let thickness = 0.305;
    let stack = stack_of(16e-3, 29e-3, &[thickness * 1e-3], Stacking::Sliding);
    let mm_per_mpa = stack.uniform_edge_lift_m_per_pa() * 1e9;
    // Lift by plate theory divided by the thickness, and the fraction of this lift that CalculiX finds.
    for (lift, left) in [(0.25, 0.993), (0.5, 0.970), (1.0, 0.908)] {
        let pressure_mpa = lift * thickness / mm_per_mpa;
        let bent = over_ours(
            PISTON,
            &[thickness],
            Stacking::Sliding,
            pressure_mpa,
            Geometry::Nonlinear,
        );
        within(&[bent[0] / left], 2e-3);
    }
}

#[test]
fn bosses_are_within_half_a_percent_and_their_stress_within_one() {
    if !have(&[CALCULIX], "shims compared with CalculiX: bosses") {
        return;
    }
    let (thickness, pressure_mpa) = (0.305, 1e-3);
    let [clamp, free] = PISTON.map(|mm| mm * 1e-3);
    let stack = stack_of(clamp, free, &[thickness * 1e-3], Stacking::Sliding);
    for (count, share, full_mm) in [(6, 0.5, [19.0, 26.0]), (4, 0.2, [16.0, 29.0])] {
        let area = PressureArea::Sectors(Bosses {
            count,
            share,
            profile: Profile::full(full_mm[0] * 1e-3, full_mm[1] * 1e-3),
        });
        let bending = stack.bend(&area, Resolution::default()).unwrap();
        let theirs = quarter(PISTON, thickness, pressure_mpa, |radius, angle| {
            let turns = angle * f64::from(count) / TAU;
            (turns - turns.round()).abs() < 0.5 * share
                && (full_mm[0]..full_mm[1]).contains(&radius)
        });
        let largest = bending.edge_lift_range_m_per_pa()[1] * pressure_mpa * 1e9;
        let mut worst = 0.0_f64;
        for (angle, lift) in &theirs.edge {
            let ours = bending.deflection_m_per_pa(free, *angle) * pressure_mpa * 1e9;
            worst = worst.max(((lift - ours) / largest).abs());
        }
        let peak = stack.largest_stress(&bending).von_mises_per_pressure * pressure_mpa;
        let mut worst_stress = 0.0_f64;
        // Near clamp and edge a solid has stresses that thin plates lack: at the edge the twist decays as
        // exp(-sqrt(10) d/h) with the distance d (Reissner).
        let layer = 1.5 * thickness;
        let inner = PISTON[0] + layer..PISTON[1] - layer;
        let away = theirs.points.iter();
        let away = away.filter(|point| inner.contains(&point.radius));
        for point in away {
            let curvature = bending.curvature(point.radius * 1e-3, point.angle);
            let at_surface = stack.surface_stress(curvature).von_mises() * pressure_mpa;
            let ours = at_surface * (2.0 * point.height / thickness).abs();
            worst_stress = worst_stress.max(((point.von_mises - ours) / peak).abs());
        }
        println!("{count} bosses: lift {worst:.5}, stress {worst_stress:.5} of the largest");
        assert!(worst < 5e-3, "{worst}");
        assert!(worst_stress < 1e-2, "{worst_stress}");
    }
}
