//! A body on two bogies whose motion is known in closed form.

use std::f64::consts::TAU;

use dashpot_core::DamperParameters;
use dashpot_rail::vehicle::{Body, Direction, Element, End, Law, RidePoint, VehicleParameters};
use nalgebra::Complex;

use super::{
    Assessment, Axis, Baseline, Condition, Factors, Layout, Readings, SensorsError, evaluate,
};

const MASS_KG: f64 = 40e3;
const YAW_INERTIA: f64 = 1.5e6;
const PIVOT_M: f64 = 8.0;
const HEIGHT_M: f64 = 1.5;
const STIFFNESS: f64 = 400e3;
const DAMPING: f64 = 60e3;

/// Without saturation, stiff and without play, so nearly a dashpot.
fn dashpot() -> Box<DamperParameters> {
    let values = [
        format!("reduced.damping_n_s_per_m={DAMPING}"),
        "reduced.saturation_velocity_m_per_s=1".into(),
        "mount.stiffness_n_per_m=1e9".into(),
        "mount.clearance_m=0".into(),
    ];
    Box::new((*dashpot_files::damper::load("reduced-lateral", &values).unwrap()).clone())
}

/// All sensors and forces are at the height of the centres of gravity, so nothing rolls.
fn vehicle() -> VehicleParameters {
    let body = |name: &str, x_m: f64| {
        Body::new(name, MASS_KG, [50e3, 1.5e6, YAW_INERTIA], HEIGHT_M).with_x_m(x_m)
    };
    let bogies = [("front", PIVOT_M), ("rear", -PIVOT_M)];
    let element = |name: String, bogie: &str, x_m: f64, law: Law| {
        let at_m = [x_m, 0.0, HEIGHT_M];
        Element::new(name, [End::body(bogie, at_m), End::body("body", at_m)], law)
    };
    let mut vehicle = VehicleParameters::new("wagon").with_bodies([body("body", 0.0)]);
    for (bogie, x_m) in bogies {
        let spring = Law::SpringDamper {
            stiffness_n_per_m: [0.0, STIFFNESS, 1e6],
            damping_n_s_per_m: [0.0; 3],
        };
        let damper = |end: f64| {
            let law = Law::Damper {
                direction: Direction::Lateral,
                parameters: dashpot(),
            };
            element(format!("{bogie} damper {end}"), bogie, x_m + end, law)
        };
        let spring = element(format!("{bogie} spring"), bogie, x_m, spring);
        vehicle = vehicle.with_bodies([body(bogie, x_m)]).with_elements([
            spring,
            damper(1.0),
            damper(-1.0),
        ]);
    }
    let places = [("body", 0.0), ("front", PIVOT_M), ("rear", -PIVOT_M)];
    let points = places.iter().flat_map(|(on, x)| {
        [[x + 2.0, 0.0], [x - 2.0, 0.0], [*x, 1.0], [*x, -1.0]]
            .map(|[x, y]| RidePoint::new(format!("{on} {x} {y}"), *on, [x, y, HEIGHT_M]))
    });
    vehicle.with_ride_points(points.collect::<Vec<_>>())
}

/// Readings of a ride of `seconds`: bogies move by six harmonics, and the body follows with springs and dampers of
/// these factors, front and rear.
fn ride(seconds: f64, springs: [f64; 2], dampers: [f64; 2]) -> Readings {
    let times_s: Vec<f64> = (0..(seconds * 200.0) as usize)
        .map(|row| row as f64 / 200.0)
        .collect();
    // Lateral acceleration and yaw acceleration of body, front and rear bogie.
    let mut motion = vec![[[0.0; 2]; 3]; times_s.len()];
    for line in 0..12 {
        let w = TAU * (0.55 + 0.31 * f64::from(line));
        let input = [
            Complex::from_polar(1e-3, f64::from(line)),
            Complex::from_polar(0.8e-3, 2.3 * f64::from(line)),
        ];
        let ends = [0, 1]
            .map(|end| Complex::new(STIFFNESS * springs[end], 2.0 * w * DAMPING * dampers[end]));
        // m y'' = -sum(H (y +- l psi - u)) and I psi'' = -sum(+-l H (y +- l psi - u)); dampers 1 m ahead and behind
        // also turn the body by their own arms.
        let twist = Complex::new(0.0, 2.0 * w * DAMPING * (dampers[0] + dampers[1]));
        let [sum, difference] = [ends[0] + ends[1], ends[0] - ends[1]];
        let matrix = [
            [sum - w * w * MASS_KG, difference * PIVOT_M],
            [
                difference * PIVOT_M,
                sum * PIVOT_M * PIVOT_M + twist - w * w * YAW_INERTIA,
            ],
        ];
        let right = [
            ends[0] * input[0] + ends[1] * input[1],
            (ends[0] * input[0] - ends[1] * input[1]) * PIVOT_M,
        ];
        let determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
        let y = (right[0] * matrix[1][1] - matrix[0][1] * right[1]) / determinant;
        let yaw = (matrix[0][0] * right[1] - matrix[1][0] * right[0]) / determinant;
        for (motion, t) in motion.iter_mut().zip(&times_s) {
            let value =
                |amplitude: Complex<f64>| (-w * w * amplitude * Complex::from_polar(1.0, w * t)).re;
            motion[0][0] += value(y);
            motion[0][1] += value(yaw);
            motion[1][0] += value(input[0]);
            motion[2][0] += value(input[1]);
        }
    }
    let mut sensors = Vec::new();
    for (number, point) in vehicle().ride_points.iter().enumerate() {
        let body = number / 4;
        let ahead = point.at_m[0] - [0.0, PIVOT_M, -PIVOT_M][body];
        let values = motion
            .iter()
            .zip(&times_s)
            .map(|(motion, t)| match number % 4 {
                0 | 1 => motion[body][0] + ahead * motion[body][1],
                _ => (TAU * 1.3 * t).sin(),
            });
        let axis = if number % 4 < 2 {
            Axis::Lateral
        } else {
            Axis::Vertical
        };
        sensors.push((point.name.clone(), axis, values.collect()));
    }
    Readings::new("ride", &times_s, sensors).unwrap()
}

fn factors(springs: [f64; 2], dampers: [f64; 2]) -> Factors {
    evaluate(
        &Layout::new(&vehicle()).unwrap(),
        &[ride(60.0, springs, dampers)],
    )
    .unwrap()
}

#[test]
fn factors_of_a_known_motion_are_found() {
    let found = factors([1.1, 0.9], [0.5, 1.2]);
    // The bogies do not yaw, but the body does, so each damper moves on its own.
    for (value, wanted) in found.values.iter().zip([1.1, 0.9, 0.5, 0.5, 1.2, 1.2]) {
        assert!((value - wanted).abs() < 0.02, "{found:?}");
    }
    assert!(found.unexplained < 1e-3, "{found:?}");
    assert_eq!(found.seconds, 53);
}

#[test]
fn lost_damping_is_found_and_added_mass_is_not_taken_for_it() {
    let layout = Layout::new(&vehicle()).unwrap();
    let baseline = Baseline::new(&layout, factors([1.0; 2], [1.0; 2])).unwrap();
    let conditions = |found: Factors| {
        Assessment::new(&layout, &found, &baseline)
            .bogies
            .map_conditions()
    };
    assert_eq!(
        conditions(factors([1.0; 2], [0.7, 1.0])),
        [Condition::Worn, Condition::AsNew]
    );
    assert_eq!(
        conditions(factors([1.0; 2], [0.86, 1.0])),
        [Condition::Undecided, Condition::AsNew]
    );
    // All forces smaller alike: a body heavier by a fifth.
    assert_eq!(
        conditions(factors([0.83; 2], [0.83; 2])),
        [Condition::AsNew; 2]
    );
    assert_eq!(
        conditions(factors([0.83; 2], [0.83, 0.4])),
        [Condition::AsNew, Condition::Worn]
    );
}

trait MapConditions {
    fn map_conditions(self) -> [Condition; 2];
}

impl MapConditions for Vec<super::BogieReading> {
    fn map_conditions(self) -> [Condition; 2] {
        [0, 1].map(|bogie: usize| self[bogie].condition)
    }
}

#[test]
fn wrong_sensors_make_no_baseline_and_no_verdict() {
    let layout = Layout::new(&vehicle()).unwrap();
    let baseline = Baseline::new(&layout, factors([1.0; 2], [1.0; 2])).unwrap();
    let mut reversed = ride(60.0, [1.0; 2], [1.0; 2]);
    for sensor in &mut reversed.sensors[4..6] {
        sensor.values.iter_mut().for_each(|value| *value = -*value);
    }
    let found = evaluate(&layout, &[reversed]).unwrap();
    let assessment = Assessment::new(&layout, &found, &baseline);
    assert!(assessment.in_doubt);
    assert_eq!(
        assessment.bogies.map_conditions(),
        [Condition::Undecided; 2]
    );
    assert!(matches!(
        Baseline::new(&layout, found),
        Err(SensorsError::Unexplained { .. })
    ));
}

#[test]
fn a_short_or_still_ride_is_refused() {
    let layout = Layout::new(&vehicle()).unwrap();
    let error = evaluate(&layout, &[ride(18.0, [1.0; 2], [1.0; 2])]).unwrap_err();
    assert!(
        matches!(error, SensorsError::TooFewSeconds { blocks: 11, .. }),
        "{error}"
    );
    let both = [
        ride(18.0, [1.0; 2], [1.0; 2]),
        ride(18.0, [1.0; 2], [1.0; 2]),
    ];
    assert_eq!(evaluate(&layout, &both).unwrap().seconds, 22);
    let mut still = ride(60.0, [1.0; 2], [1.0; 2]);
    for (number, sensor) in still
        .sensors
        .iter_mut()
        .enumerate()
        .filter(|(number, _)| number % 4 < 2)
    {
        sensor.values.iter_mut().for_each(|value| *value *= 1e-9);
        sensor.values[number] = 1e-3;
    }
    let found = evaluate(&layout, &[still]);
    let is_useless = match &found {
        Ok(found) => found.unexplained > super::MAX_UNEXPLAINED,
        Err(error) => matches!(error, SensorsError::Undetermined { .. }),
    };
    assert!(is_useless, "{found:?}");
}
