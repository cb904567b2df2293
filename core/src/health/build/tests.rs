//! The constants of the estimator against numbers computed by hand.

use super::super::model::HealthModel;
use super::{HealthSettings, line};
use crate::example::reduced_vertical;
use crate::parameters::{
    DamperParameters, Element, Geometry, Hydraulics, Limits, Mount, Oil, OilColumn, Orifice, Seal,
    Valve, Valves,
};

/// Asserts that a number has this value up to rounding to single precision.
#[track_caller]
fn assert_close(found: f32, expected: f64) {
    let error = (f64::from(found) - expected).abs();
    assert!(
        error <= 3e-7 * expected.abs(),
        "{found:e} is not {expected:e}"
    );
}

/// Noise of 60 um and 480 N. The mount's 1/8 um/N turns 480 N into another 60 um.
const SETTINGS: HealthSettings = HealthSettings::new(60e-6, 480.0)
    .memory_s(2.0)
    .law_deviation(0.06)
    .lag(1e-3, 0.5e-3);

fn model(parameters: &DamperParameters, settings: &HealthSettings, step_s: f64) -> HealthModel {
    let checked = parameters.check().expect("the parameters are valid");
    checked
        .health_model(settings, step_s)
        .expect("the settings are valid")
}

/// A damper with one orifice and closed valves, so that `v = Cd A_o/A sqrt(2 P/rho)`. The force limit is 10 kN.
fn orifice_only() -> (Hydraulics, Mount, Limits) {
    let closed = || Valve::with_edge_compliance(0.016, 0.029, 1e-11, 0.0);
    let hydraulics = Hydraulics::new(
        Geometry::new(0.03, 0.07),
        Orifice::new(0.002, 0.72),
        Valves::new(closed(), closed(), closed()),
        Oil::new(860.0),
    );
    (hydraulics, Mount::new(8e6), Limits::DEFAULT.force_n(10e3))
}

fn physical(hydraulics: Hydraulics, mount: Mount, limits: Limits) -> DamperParameters {
    DamperParameters::new(Element::Physical(hydraulics), mount).limits(limits)
}

/// Piston area on the rod side (m^2).
fn rod_side_area_m2() -> f64 {
    0.25 * core::f64::consts::PI * (0.07 * 0.07 - 0.03 * 0.03)
}

/// Velocity of the piston (m/s) in extension under a force (N) without friction.
fn orifice_velocity(force_n: f64) -> f64 {
    let orifice_m2 = 0.25 * core::f64::consts::PI * 0.002 * 0.002;
    let pressure_pa = force_n / rod_side_area_m2();
    0.72 * orifice_m2 / rod_side_area_m2() * libm::sqrt(2.0 * pressure_pa / 860.0)
}

#[test]
fn constants_at_one_kilohertz_follow_from_noise_step_and_damper() {
    let model = model(&reduced_vertical(), &SETTINGS, 1e-3);
    assert_close(model.half_step_s, 0.5e-3);
    assert_eq!(model.block_ticks, 8);
    assert_eq!((model.per_block, model.block_centre), (0.125, 3.5));
    assert_close(model.block_s, 8e-3);
    assert_close(model.per_block_s, 125.0);
    assert_close(model.rate_scale_per_s, 1.0 / 42e-3);
    // 2 m/s and eight deviations of the displacement; twice 50 kN and eight deviations of the force.
    assert_close(model.max_move_m, 2e-3 + 480e-6);
    assert_close(model.max_force_n, 100e3 + 3840.0);
    // The damper yields at 120 kN s/m times 0.03 m/s = 3600 N.
    assert_close(model.contact_force_n, 1920.0);
    assert_close(model.yield_force_n, 3528.0 - 1920.0);
    // Variance of a sample's position: (60 um)^2 twice.
    assert_close(model.measured_variance, 7.2e-9 / 8.0);
    assert_close(model.still_m, 8.0 * 30e-6);
    assert_close(model.force_travel_variance, 1e-6 * 480.0 * 480.0 * 8.0);
    assert_close(model.law_variance, 0.0036 / 8.0);
    // Growth by the ratio of block to memory: 8 ms to 2 s and 40 s.
    assert_close(model.growth, 1.004);
    assert_close(model.lag_growth, 1.0002);
    assert_eq!((model.max_unmeasured, model.alarm_blocks), (62, 250));
    assert_close(model.missing_m, 2e-3);
    assert_close(model.zero_limit_n, 1920.0);
    assert_eq!(model.oil_compliance, 0.0);
    for (found, expected) in model.start.into_iter().zip([1.0, 0.125e-6, 0.5e-3, 1e-3]) {
        assert_close(found, expected);
    }
    let variances = [0.09, 1.5625e-14, 1e-6, 0.25e-6, 250e3, 0.0];
    for (found, expected) in model.start_variance.into_iter().zip(variances) {
        assert_close(found, expected);
    }
    let baseline = model.baseline();
    assert_eq!(baseline.flow_factor, 1.0);
    assert_close(baseline.compliance_m_per_n, 0.125e-6);
    assert_close(baseline.clearance_m, 1e-3);
}

#[test]
fn a_block_lasts_eight_milliseconds_but_has_at_least_eight_ticks() {
    for (step_s, ticks, max_unmeasured, alarm_blocks) in [
        (2e-3, 8_u32, 31, 125),
        (0.7e-3, 11, 64, 259),
        (0.1e-3, 80, 62, 250),
    ] {
        let model = model(&reduced_vertical(), &SETTINGS, step_s);
        let block_s = f64::from(ticks) * step_s;
        assert_eq!(model.block_ticks, ticks);
        assert_close(model.block_s, block_s);
        assert_close(model.per_block, 1.0 / f64::from(ticks));
        assert_close(model.per_block_s, 1.0 / block_s);
        let centre = (0..ticks).map(f64::from).sum::<f64>() / f64::from(ticks);
        assert_close(model.block_centre, centre);
        // By least squares, the slope is the moment divided by the sum of the squared distances.
        let squares =
            (0..ticks).map(|tick| (f64::from(tick) - centre) * (f64::from(tick) - centre));
        assert_close(
            model.rate_scale_per_s,
            1.0 / (squares.sum::<f64>() * step_s),
        );
        assert_close(model.max_move_m, 2.0 * step_s + 480e-6);
        assert_close(model.measured_variance, 7.2e-9 / f64::from(ticks));
        let travels_n2_s2 = 480.0 * 480.0 * step_s * block_s;
        assert_close(model.force_travel_variance, travels_n2_s2);
        assert_close(model.law_variance, 0.0036 / f64::from(ticks));
        assert_close(model.growth, 1.0 + block_s / 2.0);
        assert_close(model.lag_growth, 1.0 + block_s / 40.0);
        assert_eq!(model.max_unmeasured, max_unmeasured);
        assert_eq!(model.alarm_blocks, alarm_blocks);
    }
}

#[test]
fn a_quiet_force_sensor_has_an_alarm_limit_of_100_n() {
    let settings = HealthSettings::new(60e-6, 10.0);
    let model = model(&reduced_vertical(), &settings, 1e-3);
    assert_eq!(model.zero_limit_n, 100.0);
    assert_eq!(model.contact_force_n, 40.0);
}

#[test]
fn seals_may_have_friction_of_one_percent_of_the_force_limit_but_200_n_at_most() {
    let (hydraulics, mount, limits) = orifice_only();
    for (force_n, friction_n) in [(5e3, 50.0), (10e3, 100.0), (40e3, 200.0)] {
        let damper = physical(hydraulics.clone(), mount, limits.force_n(force_n));
        let [.., variance] = model(&damper, &SETTINGS, 1e-3).start_variance;
        assert_close(variance, friction_n * friction_n);
    }
}

#[test]
fn the_oil_compliance_is_that_of_the_column_at_a_quarter_of_the_yield_force() {
    let (mut hydraulics, mount, limits) = orifice_only();
    hydraulics.oil.column = Some(OilColumn::new(1.5e9, 0.6e-3, 0.9e-3));
    hydraulics.seal = Some(Seal::new(500.0));
    let model = model(&physical(hydraulics, mount, limits), &SETTINGS, 1e-3);
    // delta = V/(A E) P with P = (F - 500 N)/A; a quarter of 10 kN leaves 2000 N of 2500 N.
    let area_m2 = rod_side_area_m2();
    let column_m_per_n = 0.6e-3 / (area_m2 * area_m2 * 1.5e9);
    let found = f64::from(model.oil_compliance);
    assert!((found / (0.8 * column_m_per_n) - 1.0).abs() < 1e-6);
    // The pieces contain this column without the mount.
    for force_n in [1e3_f32, 2.5e3, 9e3] {
        let piece = model.piece(force_n);
        let oil_m = f64::from(piece.oil + piece.oil_slope * force_n);
        let expected_m = column_m_per_n * (f64::from(force_n) - 500.0);
        assert!((oil_m / expected_m - 1.0).abs() < 1e-4, "{force_n} N");
    }
}

#[test]
fn the_pieces_follow_a_curved_law_up_to_the_force_limit() {
    let (hydraulics, mount, limits) = orifice_only();
    let model = model(&physical(hydraulics, mount, limits), &SETTINGS, 1e-3);
    // A chord of a square root over a quarter of an octave is off by less than 1/600 of the value.
    let mut force_n = 1.0_f32;
    while force_n < 10e3 {
        let piece = model.piece(force_n);
        let found = f64::from(piece.velocity + piece.velocity_slope * force_n);
        let expected = orifice_velocity(f64::from(force_n));
        let error = found / expected - 1.0;
        assert!(error.abs() < 1.0 / 600.0, "{error:e} at {force_n} N");
        force_n *= 1.003;
    }
}

#[test]
fn a_linear_law_has_the_same_line_in_every_piece_of_both_sides() {
    let model = model(&reduced_vertical(), &SETTINGS, 1e-3);
    for piece in model.pieces.as_flattened() {
        assert!((f64::from(piece.velocity_slope) * 120e3 - 1.0).abs() < 1e-6);
        assert!(piece.velocity.abs() < 1e-9);
        assert!(piece.oil.abs() < 1e-15 && piece.oil_slope.abs() < 1e-18);
    }
}

#[test]
fn a_line_has_the_chords_slope_and_the_laws_mean() {
    // F^2 from 2 to 4: the chord's slope is 6, and the mean 28/3 is that of the line at F = 3.
    let (value, slope) = line(&|force| force * force, 2.0, 4.0);
    assert_close(slope, 6.0);
    assert_close(value, 28.0 / 3.0 - 18.0);
    // F^3 from 1 to 3: slope 13, mean 10 at F = 2.
    let (value, slope) = line(&|force| force * force * force, 1.0, 3.0);
    assert_close(slope, 13.0);
    assert_close(value, 10.0 - 26.0);
}

#[test]
fn settings_are_accepted_up_to_their_bounds_and_refused_beyond() {
    let checked = reduced_vertical().check().expect("the example is valid");
    let with = |change: fn(&mut HealthSettings, f64), value| {
        let mut settings = SETTINGS;
        change(&mut settings, value);
        checked.health_model(&settings, 1e-3).map_err(|error| {
            assert_eq!((error.section, error.value), ("health", value));
            error.field
        })
    };
    type Change = fn(&mut HealthSettings, f64);
    let fields: [(&str, Change, f64, f64); 6] = [
        (
            "displacement_noise_m",
            |s, x| s.displacement_noise_m = x,
            1e-9,
            1e-2,
        ),
        ("force_noise_n", |s, x| s.force_noise_n = x, 1e-3, 1e6),
        ("memory_s", |s, x| s.memory_s = x, 0.1, 1e5),
        ("law_deviation", |s, x| s.law_deviation = x, 0.0, 1.0),
        ("lag_s", |s, x| s.lag_s = x, -5e-3, 5e-3),
        ("lag_sd_s", |s, x| s.lag_sd_s = x, 0.0, 5e-3),
    ];
    for (name, change, min, max) in fields {
        for allowed in [min, max] {
            assert!(with(change, allowed).is_ok(), "{name} = {allowed}");
        }
        let width = max - min;
        for refused in [min - 1e-6 * width, max + 1e-6 * width, f64::INFINITY] {
            assert_eq!(with(change, refused).err(), Some(name));
        }
    }
    let mut settings = SETTINGS;
    settings.memory_s = f64::NAN;
    assert!(checked.health_model(&settings, 1e-3).is_err());
}

#[test]
fn the_step_is_between_10_microseconds_and_2_milliseconds() {
    let checked = reduced_vertical().check().expect("the example is valid");
    for step_s in [1e-5, 2e-3] {
        assert!(checked.health_model(&SETTINGS, step_s).is_ok());
    }
    for step_s in [0.9e-5, 2.1e-3, 0.0, f64::NAN] {
        let refused = checked.health_model(&SETTINGS, step_s);
        assert_eq!(refused.map_err(|error| error.field).err(), Some("step_s"));
    }
}
