//! Compares disc theory with Roark's coefficients, the source paper's closed form and its own boundary conditions.

use dashpot::damper;
use dashpot_core::parameters::Element;
use dashpot_core::shim::{Disc, Pack};

const MODULUS: f64 = 2.0e11;
const POISSON: f64 = 0.3;

fn disc(clamp: f64, free: f64) -> Disc {
    Disc::new("disc", clamp, free, MODULUS, POISSON).expect("a disc")
}

/// `Cw(r)` (m^6/N) from the constants B1 to B4 of the source paper.
fn closed_form(clamp: f64, free: f64, r: f64) -> f64 {
    let plate = 3.0 * (1.0 - POISSON * POISSON) / (2.0 * MODULUS);
    let (n, w) = (clamp * clamp, free * free);
    let b1 = -plate * w;
    let b2 = plate * n * (w * (2.0 * clamp.ln() + 1.0) - n / 2.0);
    let b3 = plate * w * w / (1.0 - POISSON)
        * (2.0 * (1.0 + POISSON) * free.ln() + (3.0 + POISSON) / 2.0);
    let b4 = -2.0 * ((1.0 + POISSON) / (1.0 - POISSON) * w + n);
    let ratio = (b2 + b3) / b4;
    let shape = |r: f64| {
        let square = r * r;
        (b2 + 2.0 * n * ratio) * r.ln() - ratio * square
            + b1 * square * r.ln()
            + square * square * 12.0 * (1.0 - POISSON * POISSON) / (64.0 * MODULUS)
    };
    shape(r) - shape(clamp)
}

#[test]
fn roark_case_2l() {
    // Roark's Formulas for Stress and Strain, table 11.2, case 2l, nu = 0.3: K_y and K_M at r_n/r_w.
    let known = [
        (0.1, 0.07569, 0.9646),
        (0.3, 0.03182, 0.4103),
        (0.5, 0.008589, 0.1736),
        (0.7, 0.001096, 0.0541),
        (0.9, 0.0000129, 0.0053),
    ];
    for (ratio, deflection, moment) in known {
        let disc = disc(ratio * 0.02, 0.02);
        let digit = if ratio > 0.8 { 5e-8 } else { 5e-6 };
        let found = disc.edge_coefficient();
        assert!(
            (found - deflection).abs() < digit,
            "K_y at {ratio}: {found}"
        );
        let found = disc.clamp_moment_coefficient();
        assert!((found - moment).abs() < 6e-5, "K_M at {ratio}: {found}");
    }
}

#[test]
fn coefficients_of_the_published_discs() {
    let large = disc(16e-3, 29e-3).deflection_coefficient(29e-3);
    assert!((large / 2.1427e-19 - 1.0).abs() < 3e-5, "{large:e}");
    let small = disc(5e-3, 11e-3).deflection_coefficient(11e-3);
    assert!((small / 9.6981e-21 - 1.0).abs() < 3e-5, "{small:e}");
}

#[test]
fn the_papers_constants_give_the_same_deflection_at_every_radius() {
    for (clamp, free) in [(16e-3, 29e-3), (5e-3, 11e-3), (2e-3, 40e-3)] {
        let disc = disc(clamp, free);
        let edge = closed_form(clamp, free, free);
        for step in 0..=20 {
            let r = clamp + (free - clamp) * f64::from(step) / 20.0;
            let error = (disc.deflection_coefficient(r) - closed_form(clamp, free, r)) / edge;
            // The closed form loses digits by cancellation: its terms are about a hundred times their sum.
            assert!(error.abs() < 1e-11, "{clamp}/{free} at {r}: {error:e}");
        }
    }
}

#[test]
fn a_narrow_ring_is_a_cantilever() {
    // For r_n close to r_w, the disc is a cantilever of length l: w = p l^4/(8 D), M = p l^2/2.
    let (clamp, free) = (0.0995, 0.1);
    let length: f64 = free - clamp;
    let disc = disc(clamp, free);
    let ratio = length / free;
    assert!((disc.edge_coefficient() / (ratio.powi(4) / 8.0) - 1.0).abs() < 0.02);
    assert!((disc.clamp_moment_coefficient() / (ratio.powi(2) / 2.0) - 1.0).abs() < 0.02);
}

#[test]
fn a_pack_is_as_stiff_as_its_discs_together() {
    let parameters = damper("paper", &[]);
    let Element::Physical(hydraulics) = &parameters.element else {
        panic!("the preset is physical");
    };
    let valves = &hydraulics.valves;
    // Shims of Table 1 assigned to the packs of the source paper.
    let packs = [
        (&valves.piston_extension, 3.0, 4.05e-4, 4.0, 4.10e-4),
        (&valves.piston_compression, 4.0, 3.05e-4, 4.0, 4.05e-4),
        (&valves.foot_compression, 8.0, 3.05e-4, 0.0, 0.0),
    ];
    for (valve, some, thin, others, thick) in packs {
        let pack = Pack::new("valve", valve).expect("a pack");
        let cubed: f64 = some * f64::powi(thin, 3) + others * f64::powi(thick, 3);
        let found = pack.equivalent_thickness_m();
        assert!((found / cubed.cbrt() - 1.0).abs() < 1e-14, "{found}");
        let alone = disc(valve.clamp_radius_m, valve.free_radius_m)
            .deflection_coefficient(valve.free_radius_m);
        let found = pack.compliance_m_per_pa(valve.free_radius_m);
        assert!((found * cubed / alone - 1.0).abs() < 1e-13);
    }
}

#[test]
fn the_edge_hangs_free() {
    // There is no moment at r_w: w'' + nu w'/r = 0, from central differences at two points just inside, extrapolated to
    // the edge.
    let (clamp, free) = (16e-3, 29e-3);
    let disc = disc(clamp, free);
    let step: f64 = 1e-5;
    let at = |r: f64| disc.deflection_coefficient(r);
    let moment = |r: f64| {
        let second = (at(r + step) - 2.0 * at(r) + at(r - step)) / (step * step);
        let first = (at(r + step) - at(r - step)) / (2.0 * step);
        second + POISSON * first / r
    };
    let edge = 2.0 * moment(free - 2.0 * step) - moment(free - 4.0 * step);
    let share = edge / moment(clamp + 2.0 * step);
    assert!(share.abs() < 1e-5, "{share:e}");
}
