//! Stiff springs, divergence, stops and replaced dampers of a vehicle with one body.

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{Body, Direction, Element, End, Law, Stop, Vehicle, VehicleParameters};

use crate::support::{contact, four_springs, free_motion, free_wheelset};

const MASS_KG: f64 = 100.0;

fn vertical_damper(damping: f64) -> Element {
    let at = [0.0, 0.0, 1.5];
    let law = Law::Damper {
        direction: Direction::Vertical,
        parameters: Box::new(DamperParameters::reduced(damping, 1.0, Mount::new(4e6))),
    };
    Element::new("damper", [End::track(at), End::body("body", at)], law)
}

/// A body on four springs of `stiffness`, with other elements.
fn suspended(stiffness: f64, elements: Vec<Element>) -> VehicleParameters {
    VehicleParameters::new("suspended")
        .with_bodies([Body::new("body", MASS_KG, [100.0, 1e3, 1e3], 1.5)])
        .with_wheelsets([free_wheelset()])
        .with_elements(four_springs("body", [stiffness; 3], 0.0, [3.0, 1.0, 1.5]))
        .with_elements(elements)
}

/// The equations of Chung and Hulbert (1993) for one oscillator, solved for the new acceleration. The method
/// damps this fast motion.
#[test]
fn a_spring_too_stiff_to_resolve_is_integrated_as_the_method_says() {
    let (stiffness, start, h) = (1e11, 0.1e-3, 0.25e-3);
    let parameters = suspended(stiffness, vec![]);
    let found = free_motion(&parameters, &[[0.0, start, 0.0, 0.0, 0.0]], h, 30.0 * h);
    let rho = 0.8_f64;
    let (am, af) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
    let (beta, gamma) = ((1.0 - am + af).powi(2) / 4.0, 0.5 - am + af);
    let square = 4.0 * stiffness / MASS_KG;
    let (mut z, mut v, mut a) = (start, 0.0, -square * start);
    for (tick, found) in found.iter().enumerate() {
        // (1 - am) a1 + am a = -square ((1 - af) z1 + af z), z1 = free + beta h^2 a1.
        let free = z + h * v + h * h * (0.5 - beta) * a;
        let a1 = -(am * a + square * ((1.0 - af) * free + af * z))
            / (1.0 - am + square * (1.0 - af) * beta * h * h);
        z = free + beta * h * h * a1;
        v += h * ((1.0 - gamma) * a + gamma * a1);
        a = a1;
        let found = found[0][1];
        assert!((found - z).abs() < 1e-9 * start, "{tick}: {found} for {z}");
    }
    assert!(z.abs() < 0.1 * start, "{z}");
}

/// A force F on the mass m moves it by `F t^2/(2 m)`.
#[test]
fn a_body_that_leaves_or_jerks_away_has_diverged() {
    let vehicle = Vehicle::new(
        &suspended(1e3, vec![vertical_damper(1.0)]),
        contact(5.0),
        1e-3,
    );
    let vehicle = vehicle.unwrap();
    let track = Track::default();
    let ticks = |force_n: f64| {
        let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
        state.set_outside_force_n(0, Some(force_n)).unwrap();
        while state.stop().is_none() && state.ticks() < 1000 {
            assert!(!state.is_diverged());
            vehicle.step(&mut state, &track);
        }
        let ticks = state.ticks();
        if state.stop().is_some() {
            assert_eq!(
                (state.stop(), state.is_diverged()),
                (Some(Stop::Diverged), true)
            );
            // It is not stepped any more.
            let before = state.clone();
            vehicle.step(&mut state, &track);
            assert_eq!(state, before);
        }
        ticks
    };
    // 10 m at 1e4 m/s^2 take 45 ms. The force rises in the first tick, and the springs are weak.
    let left = ticks(-1e4 * MASS_KG);
    assert!((44..=46).contains(&left), "{left}");
    // 2e6 m/s^2 move the body by 1 m in the first tick only.
    assert_eq!(ticks(-2e6 * MASS_KG), 0);
    // A tenth of the displacement.
    assert_eq!(ticks(-40.0 * MASS_KG), 1000);
}

#[test]
fn a_stop_reports_its_force() {
    let at = [0.0, 0.0, 1.5];
    let law = Law::BumpStop {
        direction: Direction::Vertical,
        points: vec![[4e-3, 0.0], [5e-3, 5e3], [6e-3, 15e3]],
    };
    let stop = Element::new("stop", [End::track(at), End::body("body", at)], law);
    let parameters = suspended(1e6, vec![stop]);
    let vehicle = Vehicle::new(&parameters, contact(5.0), 0.05e-3).unwrap();
    let track = Track::default();
    for (start, expected) in [(2e-3, 0.0), (4.8e-3, 4e3), (-5.4e-3, -9e3)] {
        let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
        assert_eq!(state.stop_forces_n(), [0.0]);
        vehicle
            .displace(&mut state, &track, 0, [0.0, start, 0.0, 0.0, 0.0])
            .unwrap();
        vehicle.step(&mut state, &track);
        // 4 MN/m above the mass move it by 1 percent of its displacement in a tick of 0.05 ms.
        let [force] = state.stop_forces_n() else {
            panic!("one stop");
        };
        assert!(
            (force - expected).abs() <= 0.1 * f64::abs(expected),
            "{force} for {expected}"
        );
        assert_eq!(*force == 0.0, expected == 0.0);
    }
}

#[test]
fn a_replaced_damper_steps_as_one_that_was_built_in() {
    let track = Track::default();
    let forces = |vehicle: &Vehicle<_>| {
        let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
        vehicle
            .displace(&mut state, &track, 0, [0.0, 1e-3, 0.0, 0.0, 0.0])
            .unwrap();
        let mut forces = Vec::new();
        for _ in 0..20 {
            vehicle.step(&mut state, &track);
            forces.push(state.damper_forces_n()[0]);
        }
        forces
    };
    let vehicle = |damping: f64| {
        let parameters = suspended(1e6, vec![vertical_damper(damping)]);
        Vehicle::new(&parameters, contact(5.0), 1e-3).unwrap()
    };
    let (soft, stiff) = (vehicle(1e3), vehicle(20e3));
    assert_ne!(forces(&soft), forces(&stiff));
    let mut replaced = soft.clone();
    let parameters = DamperParameters::reduced(20e3, 1.0, Mount::new(4e6));
    let built = replaced.build_damper(0, &parameters).unwrap();
    replaced.replace_damper(0, &built).unwrap();
    assert_eq!(forces(&replaced), forces(&stiff));
    assert!(replaced.replace_damper(1, &built).is_err());
}
