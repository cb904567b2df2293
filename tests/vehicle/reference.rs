//! Compares the step with the reference solution for random vehicles, tracks and speeds.

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::contact::Tables;
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::track::{Generation, Irregularity, Layout, Part, Seeds, Spectrum, Track};
use dashpot_rail::vehicle::{
    Direction, Element, FrictionLoad, Law, RailSupport, Vehicle, VehicleParameters,
};
use dashpot_reference::vehicle::{VehicleReference, VehicleSample};
use fastrand::Rng;

use crate::support::{contact, locomotive};

type Reference<'a> = VehicleReference<'a, KalkerBook, Tables>;

fn between(random: &mut Rng, min: f64, max: f64) -> f64 {
    min + random.f64() * (max - min)
}

/// Friction beside the axlebox springs of both outer wheelsets, in all directions: constant at the front, and with a
/// part that follows the load of the spring at the rear.
fn friction(parameters: &VehicleParameters, random: &mut Rng) -> Vec<Element> {
    let mut elements = Vec::new();
    let axes = [
        Direction::Longitudinal,
        Direction::Lateral,
        Direction::Vertical,
    ];
    let springs = parameters.elements.iter();
    for spring in springs.filter(|spring| spring.name.split(' ').nth(1) == Some("primary")) {
        for direction in axes {
            let follows = spring.name.starts_with("rear");
            let coefficient = between(random, 0.01, 0.05);
            let law = Law::Friction {
                direction,
                stiffness_n_per_m: between(random, 1e6, 10e6),
                friction_n: between(random, 0.1e3, 2e3),
                load: follows.then(|| FrictionLoad::new(coefficient, &spring.name)),
            };
            let name = format!("{} {direction:?}", spring.name);
            elements.push(Element::new(name, spring.ends.clone(), law));
        }
    }
    assert_eq!(elements.len(), 12);
    elements
}

/// The locomotive with random masses, inertias, stiffnesses, dampings, dampers and friction.
fn vehicle(random: &mut Rng) -> VehicleParameters {
    let mut parameters = locomotive();
    for body in &mut parameters.bodies {
        let factor = between(random, 0.9, 1.1);
        body.mass_kg *= factor;
        for inertia in &mut body.inertia_kg_m2 {
            *inertia *= factor * between(random, 0.8, 1.2);
        }
    }
    for element in &mut parameters.elements {
        match &mut element.law {
            Law::SpringDamper {
                stiffness_n_per_m: [x, y, _],
                damping_n_s_per_m,
            } => {
                // Vertical springs must stay equal on both sides, because they carry the weight.
                *x *= between(random, 0.7, 1.3);
                *y *= between(random, 0.7, 1.3);
                damping_n_s_per_m[2] *= between(random, 0.5, 1.5);
            }
            Law::Damper { parameters, .. } => {
                let clearance_m = between(random, 0.0, 4e-3);
                let mount = Mount::new(between(random, 2e6, 12e6)).clearance_m(clearance_m);
                let (damping, saturation) =
                    (between(random, 20e3, 150e3), between(random, 0.02, 0.3));
                **parameters = DamperParameters::reduced(damping, saturation, mount);
            }
            _ => {}
        }
    }
    let friction = friction(&parameters, random);
    parameters.elements.extend(friction);
    parameters
}

/// A straight and a curve of random radius and direction, with irregularities of a random class.
fn track(random: &mut Rng) -> Track {
    let side = if random.bool() { 1.0 } else { -1.0 };
    let parts = [
        Part::Straight { length_m: 50.0 },
        Part::Transition {
            length_m: between(random, 30.0, 80.0),
        },
        Part::Circular {
            radius_m: side / between(random, 1.0 / 3000.0, 1.0 / 350.0),
            length_m: 1e3,
            cant_m: side * between(random, 0.0, 0.14),
        },
    ];
    let spectrum = Spectrum::fra(random.u8(5..=6)).unwrap();
    let irregularity = Generation::new(spectrum)
        .with_length_m(600.0)
        .with_seeds(Seeds::from(random.u64(..)));
    let irregularity: Irregularity = irregularity.irregularity().unwrap();
    Track::new(Layout::new(&parts).unwrap(), irregularity, vec![]).unwrap()
}

/// Samples of the reference, computed by the solver's own crate.
fn solve(reference: &mut Reference<'_>, times_s: &[f64], tolerance: f64) -> Vec<VehicleSample> {
    let mut samples = Vec::with_capacity(times_s.len());
    let mut on_sample = |sample: &VehicleSample| samples.push(sample.clone());
    reference
        .run_on_tables(times_s, tolerance, &mut on_sample)
        .unwrap();
    samples
}

/// On rigid rails, on ballasted track, and on rails as light as they are alone.
#[test]
fn random_vehicles_run_as_in_the_reference() {
    let mut random = Rng::with_seed(20_261_122);
    let light = RailSupport::new(60.0)
        .with_lateral(40e6, 60e3)
        .with_vertical(80e6, 60e3);
    for (case, rails) in [None, Some(RailSupport::BALLASTED), Some(light)]
        .into_iter()
        .enumerate()
    {
        let parameters = vehicle(&mut random);
        let track = track(&mut random);
        let speed = between(&mut random, 15.0, 35.0);
        let contact = contact(if rails.is_some() { 0.3 } else { 5.0 });
        let engine = Vehicle::on_rails(&parameters, contact.clone(), 1e-3, rails).unwrap();
        let mut state = engine.at_rest(&track, -15.0, speed).unwrap();
        let ticks = 3500;
        let times: Vec<f64> = (1..=ticks).map(|tick| f64::from(tick) * 1e-3).collect();
        let mut reference =
            VehicleReference::new(&parameters, &contact, &track, speed, -15.0).unwrap();
        if let Some(rails) = rails {
            reference = reference.on_flexible_rails(rails).unwrap();
        }
        let samples = solve(&mut reference, &times, 1e-7);
        let (mut lateral, mut load) = ([0.0; 6], [0.0; 12]);
        let (mut acceleration, mut scale, mut damper, mut damper_scale) = (0.0, 0.0, 0.0, 0.0);
        let (mut friction, mut friction_scale) = (0.0, 0.0);
        for sample in &samples {
            engine.step(&mut state, &track);
            for (axle, sum) in lateral.iter_mut().enumerate() {
                let error = state.coordinates()[3 + axle][0] - sample.coordinates[3 + axle][0];
                *sum += error * error;
            }
            for (wheel, sum) in load.iter_mut().enumerate() {
                let of = |contacts: &[dashpot_rail::contact::WheelsetForces]| {
                    contacts[wheel / 2].wheels[wheel % 2].force_n[2]
                };
                *sum += (of(state.contacts()) - of(&sample.contacts)).powi(2);
            }
            for i in 0..2 {
                let found = state.acceleration(0)[i] + state.track_acceleration(0)[i];
                acceleration += (found - sample.accelerations[0][i]).powi(2);
                scale += sample.accelerations[0][i].powi(2);
            }
            let forces = state.damper_forces_n().iter().zip(&sample.damper_forces_n);
            for (found, expected) in forces {
                damper += (found - expected).powi(2);
                damper_scale += expected * expected;
            }
            let forces = state.friction_forces_n().iter();
            for (found, expected) in forces.zip(&sample.friction_forces_n) {
                friction += (found - expected).powi(2);
                friction_scale += expected * expected;
            }
        }
        let worst =
            |sums: &[f64]| (sums.iter().fold(0.0_f64, |a, b| a.max(*b)) / f64::from(ticks)).sqrt();
        let found = [
            worst(&lateral),
            worst(&load),
            (acceleration / scale).sqrt(),
            (damper / damper_scale).sqrt(),
            (friction / friction_scale).sqrt(),
        ];
        let allowed = [5e-6, 700.0, 0.01, 0.01, 0.01];
        for (found, allowed) in found.iter().zip(allowed) {
            assert!(*found < allowed, "case {case} at {speed} m/s: {found:?}");
        }
    }
}

/// On ideal straight track, only the spin of the wheelsets changes: it starts with free rolling of the most loaded
/// patches and settles where the moment is zero.
#[test]
fn the_reference_keeps_its_equilibrium() {
    let parameters = locomotive();
    let (contact, track) = (contact(0.0), Track::default());
    let mut reference = VehicleReference::new(&parameters, &contact, &track, 30.0, 0.0).unwrap();
    let samples = solve(&mut reference, &[0.0, 0.5, 1.0], 1e-8);
    let bodies = parameters.bodies.len();
    for sample in samples {
        let states = sample.coordinates.iter().zip(&sample.velocities);
        for (body, (q, v)) in states.enumerate() {
            for k in 0..5 {
                let allowed = if body >= bodies && k == 3 { 1e-5 } else { 1e-9 };
                let most = q[k].abs().max(v[k].abs());
                assert!(most < allowed, "{body} {k}: {most} at {} s", sample.time_s);
            }
        }
        assert!(sample.damper_forces_n.iter().all(|force| *force == 0.0));
    }
}
