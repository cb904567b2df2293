//! Compares the eigenvalues of ten thousand random vehicles with LAPACK's.

use std::process::Command;

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, Law, Running, Standstill, VehicleParameters, Wheelset,
};
use fastrand::Rng;

use crate::support;
use crate::yaw_dampers_had_no_modes as yaw;

/// State matrix and eigenvalues of a vehicle.
type Solved = (Vec<Vec<f64>>, Vec<[f64; 2]>);

/// How many vehicles of each kind: standing with two bodies, running wagons, and locomotives with yaw dampers.
const STANDING: usize = 6_000;
const WAGONS: usize = 3_800;
const LOCOMOTIVES: usize = 200;

/// A random number from `min` to `min` times 10 to the power of `decades`, with an evenly distributed logarithm.
fn decades(rng: &mut Rng, min: f64, decades: f64) -> f64 {
    min * 10_f64.powf(decades * rng.f64())
}

fn between(rng: &mut Rng, min: f64, max: f64) -> f64 {
    min + (max - min) * rng.f64()
}

fn three(rng: &mut Rng, min: f64) -> [f64; 3] {
    std::array::from_fn(|_| decades(rng, min, 4.0))
}

fn body(rng: &mut Rng, name: &str, min_kg: f64) -> Body {
    let mass_kg = decades(rng, min_kg, 2.0);
    let inertia_kg_m2 = [
        mass_kg * between(rng, 0.3, 3.0),
        mass_kg * between(rng, 0.5, 30.0),
        mass_kg * between(rng, 0.5, 30.0),
    ];
    let x_m = between(rng, -1.0, 1.0);
    Body::new(name, mass_kg, inertia_kg_m2, between(rng, 0.3, 2.5)).with_x_m(x_m)
}

fn spring(name: String, ends: [End; 2], stiffness: [f64; 3], damping: [f64; 3]) -> Element {
    let law = Law::SpringDamper {
        stiffness_n_per_m: stiffness,
        damping_n_s_per_m: damping,
    };
    Element::new(name, ends, law)
}

fn damper(rng: &mut Rng, name: String, ends: [End; 2], direction: Direction) -> Element {
    let mount = Mount::new(decades(rng, 1e5, 5.0));
    let parameters = DamperParameters::reduced(decades(rng, 1e3, 4.0), 1.0, mount);
    let law = Law::Damper {
        direction,
        parameters: Box::new(parameters),
    };
    Element::new(name, ends, law)
}

/// Two bodies on random springs with a damper, at standstill; `None` if the springs do not hold them.
fn standing(rng: &mut Rng) -> Option<Solved> {
    let mut elements = Vec::new();
    for number in 0..6 {
        let at = [
            between(rng, -8.0, 8.0),
            between(rng, -2.0, 2.0),
            between(rng, 0.0, 3.0),
        ];
        let ends = match number % 2 {
            0 => [End::track(at), End::body("lower", at)],
            _ => [End::body("lower", at), End::body("upper", at)],
        };
        let (stiffness, damping) = (three(rng, 1e5), three(rng, 1e2));
        elements.push(spring(format!("spring {number}"), ends, stiffness, damping));
    }
    let at = [1.0, 0.5, 0.7];
    let ends = [End::body("lower", at), End::body("upper", at)];
    elements.push(damper(rng, "damper".into(), ends, Direction::Lateral));
    let vehicle = VehicleParameters::new("two bodies")
        .with_bodies([body(rng, "upper", 1e3), body(rng, "lower", 300.0)])
        .with_elements(elements);
    let standstill = Standstill::new(&vehicle).ok()?;
    let values = standstill.eigenvalues_rad_per_s().unwrap();
    Some((standstill.state_matrix(), values))
}

/// A body on two wheelsets with springs and yaw dampers, at a speed; `None` if the rails cannot carry it.
fn wagon(rng: &mut Rng) -> Option<Solved> {
    let base_m = between(rng, 1.0, 9.0);
    let wheelset = |name: &str, x_m: f64, mass_kg: f64| {
        let inertia_kg_m2 = [0.5 * mass_kg, 0.06 * mass_kg, 0.5 * mass_kg];
        Wheelset::new(name, mass_kg, inertia_kg_m2, 0.625).with_x_m(x_m)
    };
    let mass_kg = between(rng, 900.0, 3500.0);
    let wheelsets = vec![
        wheelset("front", base_m, mass_kg),
        wheelset("rear", -base_m, mass_kg),
    ];
    let (stiffness, damping) = (three(rng, 2e5), three(rng, 1e2));
    let mut elements = Vec::new();
    for (on, x) in [("front", base_m), ("rear", -base_m)] {
        for y in [-1.0, 1.0] {
            let at = [x, y, 0.625];
            let ends = [End::body(on, at), End::body("body", at)];
            elements.push(spring(
                format!("{on} spring {y}"),
                ends.clone(),
                stiffness,
                damping,
            ));
            let name = format!("{on} yaw damper {y}");
            elements.push(damper(rng, name, ends, Direction::Longitudinal));
        }
    }
    let body_kg = between(rng, 12e3, 60e3);
    let inertia_kg_m2 = [2.0, 25.0, 25.0].map(|square| square * body_kg);
    let vehicle = VehicleParameters::new("wagon")
        .with_bodies([Body::new(
            "body",
            body_kg,
            inertia_kg_m2,
            between(rng, 1.0, 2.0),
        )])
        .with_wheelsets(wheelsets)
        .with_elements(elements);
    let speed = between(rng, 1.0, 120.0);
    let running = Running::new(&vehicle, &support::contact(5.0), speed).ok()?;
    let values = running.eigenvalues_rad_per_s().unwrap();
    Some((running.state_matrix(), values))
}

fn locomotive(rng: &mut Rng) -> Option<Solved> {
    let damping = decades(rng, 1e5, 2.0);
    let vehicle = yaw::locomotive(damping, decades(rng, 2e6, 1.5));
    let speed = between(rng, 5.0, 120.0);
    let running = Running::new(&vehicle, &support::contact(5.0), speed).unwrap();
    let values = running.eigenvalues_rad_per_s().unwrap();
    Some((running.state_matrix(), values))
}

/// Generates `count` vehicles.
fn repeat(count: usize, rng: &mut Rng, make: fn(&mut Rng) -> Option<Solved>) -> Vec<Solved> {
    std::iter::repeat_with(|| make(rng))
        .flatten()
        .take(count)
        .collect()
}

/// LAPACK's eigenvalues with their sensitivities, as defined in `eigenvalues.py`.
type Found = Vec<([f64; 2], f64)>;

fn by_lapack(python: &std::path::Path, solved: &[Solved]) -> Vec<Found> {
    let folder = tempfile::tempdir().unwrap();
    let [matrices, values] = ["matrices", "values"].map(|name| folder.path().join(name));
    let mut bytes = Vec::new();
    for (rows, _) in solved {
        bytes.extend((rows.len() as u64).to_le_bytes());
        bytes.extend(
            rows.iter()
                .flatten()
                .flat_map(|number| number.to_le_bytes()),
        );
    }
    std::fs::write(&matrices, bytes).unwrap();
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/vehicle/eigenvalues.py");
    let status = Command::new(python)
        .arg(script)
        .args([&matrices, &values])
        .status();
    assert!(status.unwrap().success());
    let bytes = std::fs::read(&values).unwrap();
    let (numbers, rest) = bytes.as_chunks::<8>();
    assert!(rest.is_empty());
    let mut numbers = numbers.iter().map(|bytes| f64::from_le_bytes(*bytes));
    solved
        .iter()
        .map(|(rows, _)| {
            let mut part = || -> Vec<f64> { numbers.by_ref().take(rows.len()).collect() };
            let (real, imaginary, sensitivity) = (part(), part(), part());
            let values = real.into_iter().zip(imaginary).map(|(re, im)| [re, im]);
            values.zip(sensitivity).collect()
        })
        .collect()
}

fn magnitude([re, im]: [f64; 2]) -> f64 {
    re.hypot(im)
}

/// Two correct solutions may differ by the effect of this number of rounding errors in the matrix.
const ROUNDINGS: f64 = 5.0;

/// Distance between the eigenvalues of a vehicle and LAPACK's.
struct Distance {
    /// Maximum distance relative to the magnitude.
    relative: f64,
    /// Maximum distance relative to the allowed distance, which is 1e-9 of the magnitude or, if larger, the effect of
    /// [`ROUNDINGS`] rounding errors in the matrix. No method is more accurate in double precision.
    of_allowed: f64,
}

impl Distance {
    fn new(values: &[[f64; 2]], expected: &Found) -> Self {
        assert_eq!(values.len(), expected.len());
        let mut left = expected.clone();
        let (mut relative, mut of_allowed) = (0.0_f64, 0.0_f64);
        for value in values {
            let apart =
                |other: &([f64; 2], f64)| magnitude([value[0] - other.0[0], value[1] - other.0[1]]);
            let nearest = (0..left.len())
                .min_by(|a, b| apart(&left[*a]).total_cmp(&apart(&left[*b])))
                .unwrap();
            let other = left.swap_remove(nearest);
            let size = magnitude(other.0);
            let rounding = ROUNDINGS * f64::EPSILON * other.1;
            relative = relative.max(apart(&other) / size.max(f64::MIN_POSITIVE));
            of_allowed = of_allowed.max(apart(&other) / (1e-9 * size).max(rounding));
        }
        Self {
            relative,
            of_allowed,
        }
    }
}

#[test]
fn ten_thousand_random_vehicles_have_lapacks_eigenvalues() {
    let skipped = "eigenvalues of random vehicles against LAPACK";
    let Some(python) = xtask::python::have_packages(skipped) else {
        return;
    };
    let mut rng = Rng::with_seed(26);
    let mut solved = repeat(STANDING, &mut rng, standing);
    solved.extend(repeat(WAGONS, &mut rng, wagon));
    solved.extend(repeat(LOCOMOTIVES, &mut rng, locomotive));
    assert_eq!(solved.len(), 10_000);
    let found = by_lapack(&python, &solved);
    let distances: Vec<Distance> = solved
        .iter()
        .zip(&found)
        .map(|((_, values), found)| Distance::new(values, found))
        .collect();
    let max = |value: fn(&Distance) -> f64| distances.iter().map(value).fold(0.0, f64::max);
    let plain = distances.iter().filter(|one| one.relative <= 1e-9).count();
    let (relative, of_allowed) = (max(|one| one.relative), max(|one| one.of_allowed));
    println!("{plain} of 10000 within 1e-9 of each eigenvalue, {relative:.1e} at most");
    println!("{of_allowed:.2} of what is allowed at most");
    assert!(of_allowed <= 1.0, "{of_allowed}");
    assert!(plain >= 9_000, "{plain}");
}
