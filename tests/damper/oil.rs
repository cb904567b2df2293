//! Compares the oil's density, viscosity and modulus with closed forms and published points.

use dashpot_core::parameters::{ATMOSPHERIC_PRESSURE_PA as ATMOSPHERE, Oil, OilColumn};

fn column(air_fraction: f64, polytropic_exponent: f64) -> OilColumn {
    OilColumn::new(1.5e9, 8e-4, 9e-4)
        .air_fraction(air_fraction)
        .polytropic_exponent(polytropic_exponent)
}

fn oil(temperature_c: f64, column: Option<OilColumn>) -> Oil {
    let mut oil = Oil::new(870.0)
        .thermal_expansion_per_k(7e-4)
        .temperature_c(temperature_c);
    oil.column = column;
    oil
}

/// `E` of the model, to first order in the air ratio.
fn modulus(alpha: f64, n: f64, absolute: f64) -> f64 {
    let liquid = 1.5e9;
    liquid * (1.0 + alpha * (ATMOSPHERE / absolute).powf(1.0 / n))
        / (1.0 + alpha * ATMOSPHERE.powf(1.0 / n) * liquid / (n * absolute.powf((n + 1.0) / n)))
}

#[test]
fn density_falls_with_temperature() {
    assert!((oil(15.0, None).density_kg_per_m3(1e6) - 870.0).abs() < 1e-9);
    // 870/(1 + 7e-4 (45 - 15)) and (90 - 15).
    assert!((oil(45.0, None).density_kg_per_m3(0.0) - 852.105_778).abs() < 1e-6);
    assert!((oil(90.0, None).density_kg_per_m3(0.0) - 826.603_325).abs() < 1e-6);
}

#[test]
fn air_lowers_the_density_by_its_volume_and_pressure_takes_it_back() {
    let mixed = oil(15.0, Some(column(0.05, 1.0)));
    // 5 % of the volume is air of 1.225 kg/m3 (ISO 2533 at 15 degC).
    let expected = 0.95 * 870.0 + 0.05 * 1.225;
    assert!((mixed.density_kg_per_m3(0.0) - expected).abs() < 1e-4);
    // At a gauge pressure of nine atmospheres a tenth of the air's volume remains; the oil shortens by P/E.
    let pressure = 9.0 * ATMOSPHERE;
    let volume = 0.95 * (1.0 - pressure / 1.5e9) + 0.05 / 10.0;
    assert!((mixed.density_kg_per_m3(pressure) - expected / volume).abs() < 1e-4);
}

#[test]
fn viscosity_goes_through_its_points_and_straight_between_on_the_chart() {
    let at = |temperature: f64| oil(temperature, None).kinematic_viscosity_m2_per_s();
    assert!((at(40.0) / 15e-6 - 1.0).abs() < 1e-12);
    assert!((at(100.0) / 3.8e-6 - 1.0).abs() < 1e-12);
    // ASTM D341: log log(nu + 0.7) is a linear function of log T. The ordinates were computed by hand:
    // log10 log10 15.7 = 0.0776947, log10 log10 4.5 = -0.1849455;
    // log10 T at 40, 70, 100 degC = 2.4957527, 2.5354842, 2.5718834.
    let between = -0.184_945_5
        + (0.077_694_7 + 0.184_945_5) * (2.571_883_4 - 2.535_484_2) / (2.571_883_4 - 2.495_752_7);
    let expected = 10f64.powf(10f64.powf(between)) - 0.7;
    let found = at(70.0) * 1e6;
    assert!((found / expected - 1.0).abs() < 2e-5, "{found} {expected}");
    let falling = [-20.0, 0.0, 20.0, 45.0, 90.0].map(at);
    assert!(falling.windows(2).all(|pair| pair[1] < pair[0]));
}

#[test]
fn modulus_agrees_with_the_closed_form() {
    for n in [1.0, 1.2, 1.4] {
        for alpha in [0.0, 5e-4, 0.02] {
            for absolute in [ATMOSPHERE, 1e6, 1e7] {
                let found = column(alpha, n).bulk_modulus_pa(absolute);
                let expected = modulus(alpha, n, absolute);
                // The closed form is only of first order in the air ratio and in P/E_l.
                let tolerance = 2.0 * alpha + 1.1 * absolute / 1.5e9;
                let share = (found / expected - 1.0).abs();
                assert!(
                    share <= tolerance,
                    "n {n}, alpha {alpha}, {absolute} Pa: {share:e}"
                );
            }
        }
    }
}

#[test]
fn lee_chart_points() {
    // Fraction of the air-free modulus at 2 % air: 0.80 at 500 psi and 0.98 at 2000 psi.
    const PSI: f64 = 6_894.757;
    let share = |psi: f64| {
        let absolute = psi * PSI + ATMOSPHERE;
        column(0.02, 1.0).bulk_modulus_pa(absolute) / column(0.0, 1.0).bulk_modulus_pa(absolute)
    };
    for (psi, expected) in [(500.0, 0.80), (2000.0, 0.98)] {
        let found = share(psi);
        assert!((found - expected).abs() < 0.015, "{psi} psi: {found}");
    }
}

#[test]
fn limits_of_the_modulus() {
    // High pressure compresses the air until it has no effect. Much air at low pressure behaves as a gas with the
    // modulus n p.
    let found = column(0.02, 1.0).bulk_modulus_pa(1e8) / column(0.0, 1.0).bulk_modulus_pa(1e8);
    assert!((found - 1.0).abs() < 0.025, "{found}");
    for n in [1.0, 1.4] {
        let found = column(0.2, n).bulk_modulus_pa(ATMOSPHERE);
        // V/(-dV/dp) for V = 1: the air contributes 0.2/(n p_a) to -dV/dp, and the oil the rest.
        let expected = 1.0 / (0.2 / (n * ATMOSPHERE) + 0.8 / 1.5e9);
        assert!((found / expected - 1.0).abs() < 1e-12, "{found}");
    }
}

#[test]
fn the_columns_shortening_has_a_closed_form_without_heat() {
    for pressure in [0.0, 5e4, 1e6, 1e7] {
        let alpha = 0.01;
        let expected =
            (1.0 - alpha) * pressure / 1.5e9 + alpha * pressure / (ATMOSPHERE + pressure);
        let found = column(alpha, 1.0).compression(pressure);
        assert!((found - expected).abs() < 1e-15, "{pressure} Pa: {found}");
    }
}

#[test]
fn compressibility_is_the_slope_of_compression() {
    for n in [1.0, 1.3] {
        let column = column(0.02, n);
        for pressure in [0.0, 2e5, 5e6] {
            let step = 10.0;
            let slope = (column.compression(pressure + step) - column.compression(pressure - step))
                / (2.0 * step);
            let found = column.compressibility_per_pa(pressure);
            assert!((found / slope - 1.0).abs() < 1e-6, "n {n}, {pressure} Pa");
        }
    }
}
