//! Actuators in motion against the closed form of their response, and against the benchmark's plant.

use std::f64::consts::TAU;

use dashpot_files::actuator::{ACTUATORS, ActuatorParameters};
use dashpot_hybrid::actuator::{Actuator, response};
use nalgebra::Complex;

const STEP_S: f64 = 1.0 / 16_000.0;

/// Amplitude so small that no limit holds, m.
const AMPLITUDE_M: f64 = 1e-4;

/// Drives the actuator with a sine and a spring and dashpot as specimen; returns measured over command.
fn measured(parameters: &ActuatorParameters, f_hz: f64, [k, c]: [f64; 2]) -> Complex<f64> {
    let mut actuator = Actuator::new(parameters, STEP_S);
    let per_period = (1.0 / (f_hz * STEP_S)).round();
    let (mut last_m, mut sum) = (0.0, Complex::new(0.0, 0.0));
    let settling = (2.0 * f_hz).ceil() as u32;
    let periods = settling + 4;
    for step in 0..periods * per_period as u32 {
        let phase = TAU * f64::from(step) / per_period;
        if step >= settling * per_period as u32 {
            let turn = Complex::new(0.0, -phase).exp();
            sum += turn * (2.0 * actuator.measured_m() / (4.0 * per_period * AMPLITUDE_M));
        }
        let x_m = actuator.displacement_m();
        actuator.step(
            AMPLITUDE_M * phase.sin(),
            k * x_m + c * (x_m - last_m) / STEP_S,
        );
        assert!(!actuator.is_saturated());
        last_m = x_m;
    }
    // A sine is the imaginary part of the turn.
    sum * Complex::new(0.0, 1.0)
}

#[test]
fn motion_follows_the_closed_form() {
    for (name, _) in ACTUATORS {
        let parameters = ActuatorParameters::load(name).unwrap();
        for f_hz in [1.0, 5.0, 10.0, 20.0] {
            for [k, c] in [[0.0, 0.0], [2e6, 0.0], [0.0, 3e4]] {
                let s = Complex::new(0.0, TAU * f_hz);
                // The command is held for a step, in the middle of which it is exact.
                let expected = response(&parameters, s, s * c + k) * (-s * (0.5 * STEP_S)).exp();
                let found = measured(&parameters, f_hz, [k, c]);
                let error = (found - expected).norm() / expected.norm();
                assert!(
                    error < 0.01,
                    "{name}, {f_hz} Hz, {k} N/m, {c} N s/m: {error}"
                );
            }
        }
    }
}

/// Delay and gain of the benchmark's plant, as published (Silva and others, 2020).
#[test]
fn the_benchmark_file_is_the_benchmark_plant() {
    let parameters = ActuatorParameters::load("benchmark").unwrap();
    for (f_hz, delay_s, gain) in [
        (1.0, 0.025, 1.0),
        (5.0, 0.023, 0.85),
        (10.0, 0.019, 0.63),
        (20.0, 0.014, 0.41),
    ] {
        let s = Complex::new(0.0, TAU * f_hz);
        let found = response(&parameters, s, Complex::new(0.0, 0.0));
        assert!((found.norm() - gain).abs() < 0.01, "{f_hz} Hz: {found}");
        assert!(
            (-found.arg() / s.im - delay_s).abs() < 0.6e-3,
            "{f_hz} Hz: {found}"
        );
    }
}

#[test]
fn a_servo_moves_and_pushes_no_more_than_its_valve_and_pressure_allow() {
    let parameters = ActuatorParameters::load("servo").unwrap();
    let mut actuator = Actuator::new(&parameters, STEP_S);
    // Free flow over area: 1.67e-3 m^3/s sqrt(21/7) / 3e-3 m^2.
    let free_m_per_s = 1.67e-3 * 3_f64.sqrt() / 3.0e-3;
    let mut places_m = Vec::new();
    for _ in 0..1600 {
        actuator.step(0.1, 0.0);
        places_m.push(actuator.displacement_m());
    }
    // Fully open until 18 mm before the end.
    let mean_m_per_s = (places_m[1200] - places_m[400]) / (800.0 * STEP_S);
    assert!(
        (mean_m_per_s / free_m_per_s - 1.0).abs() < 0.01,
        "{mean_m_per_s}"
    );
    // 63 kN hold a spring of 10 MN/m at 6.3 mm, however far the command is.
    let mut actuator = Actuator::new(&parameters, STEP_S);
    for _ in 0..32_000 {
        let force_n = 10e6 * actuator.displacement_m();
        actuator.step(0.05, force_n);
    }
    assert!((10e6 * actuator.displacement_m() / 63e3 - 1.0).abs() < 0.02);
    assert!(actuator.is_saturated());
}

#[test]
fn wrong_files_say_what_is_allowed() {
    let servo = ACTUATORS[0].1;
    for (from, to, message) in [
        (
            "stroke_m = 0.1",
            "stroke_m = 5",
            "limits.stroke_m: 5, allowed: 0.001 to 1",
        ),
        (
            "piston_area_m2 = 3.0e-3",
            "piston_area_m2 = 0.1",
            "resonance of mass and oil",
        ),
        ("stroke_m = 0.1", "stroke = 0.1", "stroke_m"),
        ("[servo_hydraulic]", "[servo]", "servo_hydraulic"),
        (
            "[displacement_sensor]",
            "[second_order]\nfrequency_hz = 5\ndamping_ratio = 1\ndelay_s = 0\n[displacement_sensor]",
            "allowed: one of the tables",
        ),
        (
            "delay_s = 1e-3",
            "delay_s = nan",
            "servo_hydraulic.delay_s: NaN",
        ),
    ] {
        let text = servo.replace(from, to);
        assert_ne!(text, servo);
        let error = ActuatorParameters::parse("mine.toml", &text)
            .unwrap_err()
            .to_string();
        assert!(
            error.starts_with("mine.toml: ") && error.contains(message),
            "{error}"
        );
    }
    let error = ActuatorParameters::load("serwo").unwrap_err().to_string();
    assert!(
        error.contains("servo, second-order, slow, benchmark"),
        "{error}"
    );
}
