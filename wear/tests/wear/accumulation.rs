//! Wear is added up where the patch lies, and none of it is lost.

use dashpot_rail::profile::{s1002, uic60};
use dashpot_wear::{CELL_M, TGamma, Wear, WearGrid, WearLaw};

use crate::laws::sliding;

#[test]
fn the_parts_have_the_volume_of_the_whole() {
    for law in [WearLaw::default(), WearLaw::TGamma(TGamma::default())] {
        let mut wear = Wear::new(WearGrid::new(&s1002::profile()), law);
        let patch = sliding(1e-2);
        wear.add(0.0, &patch, 1000.0);
        let one_m3 = wear.volume_m3();
        // On the tread, on the flange, and beyond both ends.
        for y_m in [-5e-3, -0.045, -0.0695, 0.0599, -1.0, 1.0] {
            wear.add(y_m, &patch, 1000.0);
        }
        assert!((wear.volume_m3() / one_m3 - 7.0).abs() < 1e-9);
        assert!((wear.work_j() / (7.0 * 1000.0 * patch.wear_number_n) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn depth_times_surface_is_the_volume() {
    let radius_m = 0.46;
    let mut wear = Wear::new(WearGrid::new(&s1002::profile()), WearLaw::default());
    wear.add(-0.02, &sliding(1e-2), 1e6);
    let on_wheel = wear.of_wheel(radius_m);
    let surface = |z_m: f64| std::f64::consts::TAU * (radius_m + z_m) * CELL_M;
    let cells = on_wheel.cells.iter();
    let volume_m3: f64 = cells.map(|cell| cell.depth_m * surface(cell.z_m)).sum();
    assert!((volume_m3 / on_wheel.volume_m3 - 1.0).abs() < 1e-12);
    assert_eq!(on_wheel.volume_m3, wear.volume_m3());

    let mut wear = Wear::new(WearGrid::new(&uic60::profile()), WearLaw::default());
    wear.add(0.0, &sliding(1e-2), 50.0);
    let on_rail = wear.of_rail(50.0);
    assert!((on_rail.area_m2 * 50.0 / wear.volume_m3() - 1.0).abs() < 1e-12);
}

#[test]
fn the_depth_of_a_sliding_patch_is_a_parabola() {
    let patch = sliding(0.5e-2);
    let mut wear = Wear::new(WearGrid::new(&s1002::profile()), WearLaw::default());
    wear.add(0.0, &patch, 1e6);
    let estimate = wear.of_wheel(0.46);
    let b_m = patch.semi_axes_m[1];
    let worn = |y_m: f64| {
        let nearest = estimate.cells.iter();
        let beside = |y: f64| (y - y_m).abs();
        nearest
            .min_by(|p, q| beside(p.y_m).total_cmp(&beside(q.y_m)))
            .unwrap()
            .depth_m
    };
    // The maximum of a parabola is 3/2 of its mean.
    let peak_m = 1.5 * estimate.area_m2 / (2.0 * b_m);
    for y_m in [-6e-3, -3e-3, 0.0, 3e-3, 6e-3] {
        let expected_m = peak_m * (1.0 - (y_m / b_m).powi(2));
        assert!(
            (worn(y_m) - expected_m).abs() < 0.07 * peak_m,
            "{y_m}: {} for {expected_m}",
            worn(y_m)
        );
    }
    assert_eq!((worn(-9e-3), worn(9e-3)), (0.0, 0.0));
}

#[test]
fn spin_wears_the_edges_of_a_patch() {
    let mut patch = sliding(1e-6);
    patch.creepage.spin_per_m = 0.5;
    patch.wear_number_n = 20.0;
    let mut wear = Wear::new(WearGrid::new(&s1002::profile()), WearLaw::default());
    wear.add(0.0, &patch, 1e6);
    let estimate = wear.of_wheel(0.46);
    let near = |y_m: f64| {
        let cells = estimate.cells.iter();
        cells
            .filter(|cell| (cell.y_m.abs() - y_m).abs() < 1e-3)
            .map(|cell| cell.depth_m)
            .fold(0.0, f64::max)
    };
    // `(1 - t^2) sqrt(y^2 + (1 - t^2) a^2 / 4)` at `t = y/b`, compared with its value `a/2` in the middle.
    assert!(near(5e-3) > 1.1 * near(0.0), "{} {}", near(5e-3), near(0.0));
}

#[test]
fn an_estimate_says_so_and_names_its_law() {
    for (law, name) in [
        (WearLaw::default(), "Archard"),
        (WearLaw::TGamma(TGamma::default()), "T-gamma"),
    ] {
        let wear = Wear::new(WearGrid::new(&s1002::profile()), law);
        let text = wear.of_wheel(0.46).to_string();
        assert!(text.starts_with("estimate by ") && text.contains(name) && text.contains("Wear 2"));
    }
}
