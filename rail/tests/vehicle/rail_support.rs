//! Bounds of elastically supported rails.

use dashpot_rail::vehicle::RailSupport;

#[test]
fn every_value_of_a_support_has_bounds() {
    let support = RailSupport::new(60.0)
        .with_lateral(40e6, 60e3)
        .with_vertical(80e6, 0.0);
    assert_eq!(support.check(), Ok(()));
    let mut light = support;
    light.vertical_mass_kg = 0.5;
    for (wrong, name) in [
        (light, "vertical_mass_kg"),
        (support.with_lateral_mass(2e5), "lateral_mass_kg"),
        (support.with_lateral(0.0, 0.0), "lateral_stiffness_n_per_m"),
        (
            support.with_lateral(40e6, -1.0),
            "lateral_damping_n_s_per_m",
        ),
        (
            support.with_vertical(2e12, 0.0),
            "vertical_stiffness_n_per_m",
        ),
        (
            support.with_vertical(80e6, f64::NAN),
            "vertical_damping_n_s_per_m",
        ),
    ] {
        let error = wrong.check().unwrap_err().to_string();
        assert!(error.starts_with(&format!("rails: {name} = ")), "{error}");
    }
}
