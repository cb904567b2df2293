//! Energy on ideal track, and forces in a curve.

use dashpot_rail::track::Part;
use dashpot_rail::vehicle::{End, GRAVITY_M_PER_S2, Law, VehicleParameters};
use dashpot_reference::vehicle::{VehicleReference, VehicleSample};

use crate::common::{contact, dip, straight, times, track, wagon};

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Displacement and rotation of an end.
fn place(vehicle: &VehicleParameters, end: &End, motion: &[f64; 5]) -> (Vector, Vector) {
    let [x, y, height] = end.at_m;
    let body = vehicle
        .bodies
        .iter()
        .find(|body| Some(&body.name) == end.on.as_ref());
    match body {
        Some(body) => (
            [x - body.x_m, y, body.height_m - height],
            [motion[2], motion[3], motion[4]],
        ),
        None => {
            let found = vehicle.wheelsets.iter();
            let wheelset = found
                .clone()
                .find(|wheelset| Some(&wheelset.name) == end.on.as_ref())
                .unwrap();
            (
                [x - wheelset.x_m, y, wheelset.radius_m - height],
                [motion[2], 0.0, motion[4]],
            )
        }
    }
}

fn number(vehicle: &VehicleParameters, end: &End) -> usize {
    let bodies = vehicle.bodies.iter().map(|body| &body.name);
    let wheelsets = vehicle.wheelsets.iter().map(|wheelset| &wheelset.name);
    let name = end.on.as_ref().unwrap();
    bodies
        .chain(wheelsets)
        .position(|other| other == name)
        .unwrap()
}

/// Returns the energy of the motion, the springs and their rotating static forces, and the power lost to dashpots and
/// rails.
fn energy(vehicle: &VehicleParameters, sample: &VehicleSample) -> (f64, f64) {
    let inertia = |mass: f64, [x, y, z]: Vector| [mass, mass, x, y, z];
    let bodies = vehicle
        .bodies
        .iter()
        .map(|body| inertia(body.mass_kg, body.inertia_kg_m2));
    let wheelsets = vehicle
        .wheelsets
        .iter()
        .map(|wheelset| inertia(wheelset.mass_kg, wheelset.inertia_kg_m2));
    let (mut stored, mut power) = (0.0, 0.0);
    for (inertia, v) in bodies.chain(wheelsets).zip(&sample.velocities) {
        stored += (0..5).map(|k| 0.5 * inertia[k] * v[k] * v[k]).sum::<f64>();
    }
    let load = -vehicle.bodies[0].mass_kg * GRAVITY_M_PER_S2 / vehicle.elements.len() as f64;
    for element in &vehicle.elements {
        let Law::SpringDamper {
            stiffness_n_per_m: k,
            damping_n_s_per_m: c,
        } = &element.law
        else {
            panic!("a spring");
        };
        let standing = [0.0, 0.0, load];
        let (mut shifts, mut rates, mut turns) = (vec![], vec![], vec![]);
        for (end, sign) in element.ends.iter().zip([-1.0, 1.0]) {
            let number = number(vehicle, end);
            let (q, v) = (&sample.coordinates[number], &sample.velocities[number]);
            let moved = |motion: &[f64; 5]| {
                let (r, turn) = place(vehicle, end, motion);
                let by_turn = cross(turn, r);
                [
                    -turn[2] * r[1],
                    motion[0] + by_turn[1],
                    motion[1] + by_turn[2],
                ]
            };
            let (r, turn) = place(vehicle, end, q);
            shifts.push(moved(q));
            rates.push(moved(v));
            stored -= 0.5 * sign * dot(standing, cross(turn, cross(turn, r)));
            turns.push(turn);
        }
        let between = |ends: &[Vector]| std::array::from_fn(|i| ends[1][i] - ends[0][i]);
        let (d, rate): (Vector, Vector) = (between(&shifts), between(&rates));
        let mean = std::array::from_fn(|i| 0.5 * (turns[0][i] + turns[1][i]));
        stored += dot(standing, cross(mean, d));
        stored += (0..3).map(|i| 0.5 * k[i] * d[i] * d[i]).sum::<f64>();
        power += (0..3).map(|i| c[i] * rate[i] * rate[i]).sum::<f64>();
    }
    for (number, (wheelset, contact)) in vehicle.wheelsets.iter().zip(&sample.contacts).enumerate()
    {
        let load = wheelset.mass_kg * GRAVITY_M_PER_S2
            + 0.5 * vehicle.bodies[0].mass_kg * GRAVITY_M_PER_S2;
        let ([_, y, z], [mx, my, mz]) = (contact.force_n, contact.moment_n_m);
        let v = &sample.velocities[vehicle.bodies.len() + number];
        let forces = [y, z + load, mx, my, mz];
        power -= (0..5).map(|k| forces[k] * v[k]).sum::<f64>();
    }
    (stored, power)
}

/// On ideal track after a dip, the stored energy goes into the dashpots and the rails.
#[test]
fn energy_is_conserved_or_dissipated() {
    let vehicle = wagon([2e3, 2e3, 20e3]);
    let (contact, track) = (contact(0.3), straight(vec![dip(5.0)]));
    let mut reference = VehicleReference::new(&vehicle, &contact, &track, 25.0, 0.0).unwrap();
    let step = 1e-4;
    let samples = reference.run(&times(step, 12_000), 1e-8).unwrap();
    // The rear axle leaves the dip after 12 m.
    let after = &samples[5000..];
    let (stored, mut power) = energy(&vehicle, &after[0]);
    assert!(stored > 10.0, "{stored}");
    let mut given = 0.0;
    for sample in &after[1..] {
        let (now, next) = energy(&vehicle, sample);
        given += 0.5 * step * (power + next);
        power = next;
        let balance = (now + given) / stored - 1.0;
        assert!(balance.abs() < 1e-3, "{balance} at {} s", sample.time_s);
    }
    assert!(given > 0.2 * stored, "{given} of {stored}");
}

/// In a steady curve the rails provide the centripetal force, minus the share that gravity provides, and its moment.
#[test]
fn the_rails_balance_a_curve() {
    let (speed, radius, cant) = (22.0, 400.0, 0.08);
    let vehicle = wagon([50e3, 50e3, 40e3]);
    let parts = [
        Part::Straight { length_m: 20.0 },
        Part::Transition { length_m: 50.0 },
        Part::Circular {
            radius_m: radius,
            length_m: 1e3,
            cant_m: cant,
        },
    ];
    let (contact, track) = (contact(0.4), track(&parts, vec![]));
    let mut reference = VehicleReference::new(&vehicle, &contact, &track, speed, 0.0).unwrap();
    let samples = reference.run(&[0.0, 14.0], 1e-8).unwrap();
    let last = &samples[1];
    for acceleration in last.accelerations.iter().flatten() {
        assert!(acceleration.abs() < 1e-3, "{acceleration}");
    }

    let angle = f64::asin(cant / 1.5);
    let centripetal = speed * speed / radius;
    let lateral = GRAVITY_M_PER_S2 * angle.sin() - centripetal * angle.cos();
    let mass = 33e3;
    let found: f64 = last.contacts.iter().map(|contact| contact.force_n[1]).sum();
    let expected = -mass * lateral;
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    // The cant adds to the load.
    let load: f64 = last
        .contacts
        .iter()
        .map(|contact| -contact.force_n[2])
        .sum();
    let expected = mass * (GRAVITY_M_PER_S2 * angle.cos() + centripetal * angle.sin());
    assert!((load / expected - 1.0).abs() < 1e-4, "{load} {expected}");

    // Moments are about the track's centre at rail level at the body; the rails at the axles are offset by the versine.
    let versine = 4.0f64.powi(2) / (2.0 * radius);
    let mut moment = 0.0;
    for ((mass, height, off), q) in [
        (30e3, 1.5, 0.0),
        (1.5e3, 0.625, versine),
        (1.5e3, 0.625, versine),
    ]
    .iter()
    .zip(&last.coordinates)
    {
        moment += mass * (height * lateral + (q[0] + off) * GRAVITY_M_PER_S2);
    }
    let overturning = moment;
    for (contact, q) in last.contacts.iter().zip(&last.coordinates[1..]) {
        let [_, y, z] = contact.force_n;
        moment += contact.moment_n_m[0] + 0.625 * y + (q[0] + versine) * z;
        // Gyroscopic moment of an axle that yaws with the curve.
        moment -= 100.0 * speed / 0.625 * speed / radius;
    }
    assert!(
        (moment / overturning).abs() < 0.01,
        "{moment} of {overturning}"
    );
}
