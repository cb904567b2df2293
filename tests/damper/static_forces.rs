//! Compares the force at constant velocity with the flow laws worked by hand, each term alone.

use std::f64::consts::PI;

use dashpot::bench_test::settled_force;
use dashpot::damper;
use dashpot_core::characteristic::{Characteristic, ShimPackValve};
use dashpot_reference::damper::Reference;

/// Areas of the paper's damper (m^2).
const ROD_SIDE: f64 = PI / 4.0 * (0.0698 * 0.0698 - 0.028 * 0.028);
const PISTON: f64 = PI / 4.0 * 0.0698 * 0.0698;
const ROD: f64 = PI / 4.0 * 0.028 * 0.028;
const DENSITY: f64 = 860.0;

fn jet(pressure: f64) -> f64 {
    (2.0 * pressure.max(0.0) / DENSITY).sqrt()
}

fn orifice(pressure: f64) -> f64 {
    0.72 * PI / 4.0 * 0.002 * 0.002 * jet(pressure)
}

/// Flow of a shim valve with `radius`, `compliance` (m/Pa, including Ce), preload and back pressure.
fn shim(radius: f64, compliance: f64, pressure: f64, preload: f64, back: f64) -> f64 {
    0.61 * 2.0 * PI * radius * compliance * (pressure - preload).max(0.0) * jet(pressure - back)
}

fn extension_shim(pressure: f64, preload: f64) -> f64 {
    shim(0.029, 1.36e-11 * 0.2169, pressure, preload, 0.0)
}

fn compression_shim(pressure: f64) -> f64 {
    shim(0.029, 1.37e-11 * 0.2, pressure, 0.0, 0.0)
}

fn foot_shim(pressure: f64, back: f64) -> f64 {
    shim(0.011, 1.446e-12 * 0.8265, pressure, 0.0, back)
}

fn extension(pressure: f64) -> f64 {
    orifice(pressure) + extension_shim(pressure, 0.0)
}

fn compression(pressure: f64) -> f64 {
    orifice(pressure) + compression_shim(pressure) + foot_shim(pressure, 0.0)
}

/// Error of the tables near zero (N): an absolute force, not a fraction of the force.
const NEAR_ZERO_N: f64 = 5e-3;

/// Error of the tables with a laminar orifice (N), measured at 48 N. It makes the law linear at zero, but the tables
/// are designed for a square root there.
const LAMINAR_N: f64 = 0.08;

/// Checks that the step and the reference, driven at `velocity` (negative in compression), both have `force`.
fn check(overrides: &[&str], velocity: f64, force: f64) {
    check_near_zero(overrides, velocity, force, NEAR_ZERO_N);
}

/// Like [`check`], but the step may deviate by `near_zero` (N) plus a fraction.
fn check_near_zero(overrides: &[&str], velocity: f64, force: f64, near_zero: f64) {
    let parameters = damper("paper", overrides);
    let found = settled_force(&parameters, velocity);
    assert!(
        (found - force).abs() < 1e-5 * force.abs() + near_zero,
        "{overrides:?} at {velocity} m/s: step {found} N, law {force} N"
    );
    let reference = Reference::new(&parameters).expect("a valid damper");
    let found = reference.static_force(velocity);
    assert!(
        (found / force - 1.0).abs() < 1e-6,
        "{overrides:?} at {velocity} m/s: reference {found} N, law {force} N"
    );
}

#[test]
fn literal_values_of_the_published_damper() {
    let literal = [
        (0.1, 11_824.0),
        (0.3, 36_145.0),
        (-0.1, -16_638.0),
        (0.05, 4_724.0),
        (-0.05, -7_073.0),
    ];
    let parameters = damper("paper", &[]);
    for (velocity, expected) in literal {
        let found = settled_force(&parameters, velocity);
        // The expected values are rounded to a newton.
        assert!((found - expected).abs() < 0.6, "{velocity} m/s: {found} N");
    }
}

#[test]
fn published_laws_at_given_pressures() {
    for pressure in [1e5, 1e6, 3e6, 7e6, 1.1e7] {
        check(&[], extension(pressure) / ROD_SIDE, pressure * ROD_SIDE);
        check(&[], -compression(pressure) / PISTON, -pressure * PISTON);
    }
}

#[test]
fn preload_keeps_a_valve_shut() {
    let preload = "valves.piston_extension.preload_pa=2e6";
    for pressure in [1.5e6, 2.5e6, 6e6] {
        let flow = orifice(pressure) + extension_shim(pressure, 2e6);
        check(&[preload], flow / ROD_SIDE, pressure * ROD_SIDE);
    }
}

#[test]
fn seal_friction_adds_to_the_force() {
    let pressure = 3e6;
    let velocity = extension(pressure) / ROD_SIDE;
    check(
        &["seal.friction_n=250.0"],
        velocity,
        pressure * ROD_SIDE + 250.0,
    );
}

#[test]
fn back_pressure_opposes_the_foot_valve() {
    // Filled at the working temperature with no rod inserted, the reservoir has the fill pressure itself.
    let overrides = [
        "reservoir.fill_pressure_pa=6e5",
        "reservoir.gas_volume_m3=6e-4",
        "reservoir.fill_temperature_c=45.0",
    ];
    for pressure in [4e5, 3e6] {
        let flow = orifice(pressure) + compression_shim(pressure) + foot_shim(pressure, 6e5);
        check(&overrides, -flow / PISTON, -pressure * PISTON);
    }
}

#[test]
fn reservoir_gas_follows_its_law() {
    // The rod displaces half the gas volume, and the temperature rises from 20 to 45 degC.
    let insertion = format!("reservoir.rod_insertion_m={:e}", 3e-4 / ROD);
    let overrides = [
        "reservoir.fill_pressure_pa=2e5",
        "reservoir.gas_volume_m3=6e-4",
        "reservoir.fill_temperature_c=20.0",
        insertion.as_str(),
    ];
    let back = (2e5 + 101_325.0) * 2.0 * (318.15 / 293.15) - 101_325.0;
    let pressure = 3e6;
    let flow = orifice(pressure) + compression_shim(pressure) + foot_shim(pressure, back);
    check(&overrides, -flow / PISTON, -pressure * PISTON);
}

#[test]
fn leakage_is_laminar() {
    let overrides = [
        "leakage.radial_clearance_m=5e-5",
        "leakage.length_m=0.03",
        "leakage.eccentricity_ratio=0.5",
        "oil.temperature_c=40.0",
    ];
    // At 40 degC the viscosity is the given point: mu = 860 * 15e-6.
    let viscosity = 860.0 * 15e-6;
    let conductance =
        PI * 0.0349 * 5e-5_f64.powi(3) * (1.0 + 1.5 * 0.25) / (6.0 * viscosity * 0.03);
    for pressure in [5e5, 4e6] {
        let flow = extension(pressure) + conductance * pressure;
        check(&overrides, flow / ROD_SIDE, pressure * ROD_SIDE);
    }
}

#[test]
fn relief_opens_at_its_pressure() {
    let overrides = [
        "relief.opening_pressure_pa=3e6",
        "relief.area_gradient_m2_per_pa=4e-12",
        "relief.discharge_coefficient=0.65",
    ];
    for pressure in [2e6, 5e6] {
        let relief = 0.65 * 4e-12 * (pressure - 3e6_f64).max(0.0) * jet(pressure);
        let flow = extension(pressure) + relief;
        check(&overrides, flow / ROD_SIDE, pressure * ROD_SIDE);
        let flow = compression(pressure) + relief;
        check(&overrides, -flow / PISTON, -pressure * PISTON);
    }
}

#[test]
fn orifice_turns_laminar_at_low_flow() {
    const REYNOLDS: f64 = 400.0;
    let overrides = [
        "orifice.transition_reynolds=400.0",
        "oil.temperature_c=40.0",
    ];
    let bore = PI / 4.0 * 0.002 * 0.002;
    let turbulent = DENSITY / (2.0 * (0.72 * bore).powi(2));
    let transition = REYNOLDS * 15e-6 * bore / 0.002;
    // The law P = R_t Q^2 + R_t Q_t Q gives the pressure for a chosen flow.
    for flow in [0.1 * transition, transition, 5.0 * transition] {
        let pressure = turbulent * flow * (flow + transition);
        let flow = flow + extension_shim(pressure, 0.0);
        check_near_zero(&overrides, flow / ROD_SIDE, pressure * ROD_SIDE, LAMINAR_N);
    }
}

#[test]
fn two_chambers_share_the_compression() {
    let overrides = ["two_chamber.vapour_pressure_pa=-9e4"];
    for difference in [2e5, 1e6, 4e6] {
        let flow = orifice(difference) + compression_shim(difference);
        let velocity = flow / ROD_SIDE;
        // The rod's volume leaves through the foot valve.
        let (mut low, mut high) = (0.0, 1e9);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if foot_shim(middle, 0.0) < ROD * velocity {
                low = middle;
            } else {
                high = middle;
            }
        }
        let force = low * PISTON - (low - difference) * ROD_SIDE;
        if force < 49e3 {
            assert!(
                low - difference > -9e4,
                "the rod side must not cavitate here"
            );
            check(&overrides, -velocity, -force);
        }
    }
}

#[test]
fn a_starved_rod_side_stays_at_the_vapour_pressure() {
    // The foot valve is so soft that it does not build up pressure.
    let overrides = [
        "two_chamber.vapour_pressure_pa=-9e4",
        "valves.foot_compression.edge_compliance_m_per_pa=1e-10",
    ];
    let pressure = 1e6;
    let across = pressure + 9e4;
    let foot = shim(0.011, 1e-10 * 0.8265, pressure, 0.0, 0.0);
    let velocity = (orifice(across) + compression_shim(across) + foot) / PISTON;
    let force = pressure * PISTON + 9e4 * ROD_SIDE;
    check(&overrides, -velocity, -force);
}

#[test]
fn areas_are_the_stated_ones() {
    assert!((ROD_SIDE - 3.2107e-3).abs() < 5e-8);
    assert!((PISTON - 3.8265e-3).abs() < 5e-8);
    assert!((ROD - 6.1575e-4).abs() < 5e-9);
}

#[test]
fn a_seal_releases_where_its_friction_ends() {
    // The oil column softens the springs by a factor at the closed force. With every term on, the force at 1 mm/s is
    // close to that force.
    for overrides in [&[][..], &["two_chamber.vapour_pressure_pa=-9e4"]] {
        let parameters = damper("in-service", overrides);
        let reference = Reference::new(&parameters).expect("a valid damper");
        for velocity in [1e-3, -1e-3, 2e-3, -2e-3, 0.01, -0.01, 0.1, -0.1] {
            let (found, law) = (
                settled_force(&parameters, velocity),
                reference.static_force(velocity),
            );
            let allowed = 1e-5 * law.abs() + 2.0 * NEAR_ZERO_N;
            assert!(
                (found - law).abs() < allowed,
                "{velocity} m/s: {found} N, {law} N"
            );
        }
    }
}

/// The gas of the reservoir is below atmospheric pressure in the cold: `P_b = p_a (T/T_fill) - p_a`.
#[test]
fn a_cold_reservoir_draws_at_the_foot_valve() {
    let cold = damper(
        "in-service",
        &["oil.temperature_c=-20", "oil.column.air_fraction=0"],
    );
    let back: f64 = 101_325.0 * (253.15 / 293.15 - 1.0);
    assert!((back + 13_826.0).abs() < 1.0);
    let law = Characteristic::new(&cold.check().expect("a preset"));
    for pressure in [1e3, 1e5] {
        let density = 870.0 / (1.0 - 35.0 * 7e-4) / (1.0 - pressure / 1.5e9);
        let by_hand = 0.61
            * 2.0
            * PI
            * 0.011
            * 1.446e-12
            * 0.8265
            * pressure
            * (2.0 * (pressure - back) / density).sqrt();
        let flow = law
            .valve_flow_m3_per_s(ShimPackValve::FootCompression, pressure)
            .expect("a physical damper");
        assert!((flow / by_hand - 1.0).abs() < 1e-12, "{flow} for {by_hand}");
    }
    for velocity in [-0.01, -0.1, -0.3] {
        let reference = Reference::new(&cold)
            .expect("a preset")
            .static_force(velocity);
        let ours = law.force_n(velocity);
        assert!(
            (ours / reference - 1.0).abs() < 1e-6,
            "{ours} for {reference}"
        );
    }
}
