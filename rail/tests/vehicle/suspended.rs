//! Steps of one suspended body against closed forms.

use std::f64::consts::PI;

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::vehicle::{Body, Direction, Element, End, Law, VehicleParameters};

use crate::support::{four_springs, free_motion, free_wheelset, runge_kutta};

/// A body of 20 t on springs of 1 MN/m.
fn suspended(elements: Vec<Element>) -> VehicleParameters {
    VehicleParameters::new("suspended")
        .with_bodies([Body::new("body", 20e3, [20e3, 200e3, 200e3], 1.5)])
        .with_wheelsets([free_wheelset()])
        .with_elements(four_springs("body", [250e3; 3], 0.0, [3.0, 1.0, 1.5]))
        .with_elements(elements)
}

/// Vertical displacement, after each tick, of a body that is released 10 mm above its equilibrium.
fn bounce(parameters: &VehicleParameters, step_s: f64, seconds: f64) -> Vec<f64> {
    let start = [0.0, -10e-3, 0.0, 0.0, 0.0];
    let motion = free_motion(parameters, &[start], step_s, seconds);
    motion.iter().map(|bodies| bodies[0][1]).collect()
}

#[test]
fn a_suspended_body_bounces_as_a_cosine_to_second_order() {
    let parameters = suspended(vec![]);
    // sqrt(1 MN/m / 20 t)
    let omega = 50.0_f64.sqrt();
    let max_error = |step_s: f64| {
        let found = bounce(&parameters, step_s, 3.0);
        let expected = |tick: usize| -10e-3 * (omega * step_s * (tick + 1) as f64).cos();
        let errors = found
            .iter()
            .enumerate()
            .map(|(tick, z)| (z - expected(tick)).abs());
        errors.fold(0.0, f64::max)
    };
    let (fine, coarse) = (max_error(0.5e-3), max_error(2e-3));
    assert!(coarse < 10e-6, "{coarse}");
    // Both use steps of 0.25 ms inside a tick, so their errors are equal: below 1e-4 of the amplitude.
    assert!(fine < 1e-6, "{fine}");
}

#[test]
fn a_damper_stops_a_body_as_the_maxwell_element_does() {
    let (c, k) = (60e3, 4e6);
    let at = [0.0, 0.0, 1.5];
    let law = Law::Damper {
        direction: Direction::Vertical,
        parameters: Box::new(DamperParameters::reduced(c, 10.0, Mount::new(k))),
    };
    let damper = Element::new("damper", [End::track(at), End::body("body", at)], law);
    let found = bounce(&suspended(vec![damper]), 1e-3, 2.0);
    // m z'' + 1e6 z + F = 0, F' = k (z' - F/c)
    let rate = |[z, v, f]: &[f64; 3]| [*v, -(1e6 * z + f) / 20e3, k * (v - f / c)];
    let expected = runge_kutta([-10e-3, 0.0, 0.0], rate, 1e-3, 100, found.len());
    for (z, [expected, ..]) in found.iter().zip(&expected) {
        assert!((z - expected).abs() < 5e-6, "{z} for {expected}");
    }
    let period = 2.0 * PI / 50.0_f64.sqrt();
    let late = found.iter().skip((1.5 * period * 1e3) as usize);
    assert!(late.map(|z| z.abs()).fold(0.0, f64::max) < 5e-3);
}

#[test]
fn a_stop_turns_a_body_back_without_loss() {
    let at = [0.0, 0.0, 1.5];
    let law = Law::BumpStop {
        direction: Direction::Vertical,
        points: vec![[4e-3, 0.0], [5e-3, 5e3], [6e-3, 15e3]],
    };
    let stop = Element::new("stop", [End::track(at), End::body("body", at)], law);
    let found = bounce(&suspended(vec![stop]), 0.25e-3, 3.0);
    // Stiffness of the stop: 0 in the gap, then 5 MN/m, then 10 MN/m, also beyond the last point.
    let stop = |z: f64| {
        let first = (z.abs() - 4e-3).max(0.0) * 5e6;
        (first + (z.abs() - 5e-3).max(0.0) * 5e6).copysign(z)
    };
    let rate = |[z, v]: &[f64; 2]| [*v, -(1e6 * z + stop(*z)) / 20e3];
    let expected = runge_kutta([-10e-3, 0.0], rate, 0.25e-3, 10, found.len());
    for (tick, (z, [expected, _])) in found.iter().zip(&expected).enumerate() {
        assert!((z - expected).abs() < 60e-6, "{tick}: {z} for {expected}");
    }
}
