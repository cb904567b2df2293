//! Contacts and vehicles shared by the tests that step.

use std::sync::{Arc, OnceLock};

use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel, Tables, WheelsetContact};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{
    Element, End, Law, Vehicle, VehicleParameters, VehicleState, Wheelset,
};

pub type Contact = Arc<WheelsetContact<KalkerBook>>;

/// S1002 on UIC 60, with friction 0.3.
pub fn contact(normal_damping_s_per_m: f64) -> Contact {
    static TABLES: OnceLock<Arc<Tables>> = OnceLock::new();
    let tables = TABLES.get_or_init(|| {
        let installation = Installation::STANDARD.with_wheel_radius_m(0.625);
        let pair = Pair::standard(installation).unwrap();
        let geometry = ContactGeometry::new(pair, Steel::default()).unwrap();
        Arc::new(Tables::new(geometry))
    });
    let friction = Friction::default().with_static_coefficient(0.3);
    let contact = WheelsetContact::new(Arc::clone(tables), KalkerBook::new(), friction).unwrap();
    Arc::new(contact.with_normal_damping(normal_damping_s_per_m).unwrap())
}

/// A wheelset that no element connects with the bodies above it, because a vehicle needs at least one wheelset to step.
pub fn free_wheelset() -> Wheelset {
    Wheelset::new("wheelset", 20e3, [2e3, 500.0, 2e3], 0.625)
}

/// Four springs of `stiffness` per direction between the track and a body, at +-`x_m` and +-`y_m` from (`centre_x_m`,
/// 0).
pub fn four_springs(
    body: &str,
    stiffness_n_per_m: [f64; 3],
    centre_x_m: f64,
    [x_m, y_m, height_m]: [f64; 3],
) -> Vec<Element> {
    let law = Law::SpringDamper {
        stiffness_n_per_m,
        damping_n_s_per_m: [0.0; 3],
    };
    [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
        .map(|(x, y)| {
            let at = [centre_x_m + x * x_m, y * y_m, height_m];
            let ends = [End::track(at), End::body(body, at)];
            Element::new(format!("{body} spring {x} {y}"), ends, law.clone())
        })
        .into()
}

/// Steps `vehicle` from `displacements` of its first bodies and returns the coordinates after each tick.
pub fn free_motion(
    parameters: &VehicleParameters,
    displacements: &[[f64; 5]],
    step_s: f64,
    seconds: f64,
) -> Vec<Vec<[f64; 5]>> {
    let vehicle = Vehicle::new(parameters, contact(0.0), step_s).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    for (body, displacement) in displacements.iter().enumerate() {
        vehicle
            .displace(&mut state, &track, body, *displacement)
            .unwrap();
    }
    let ticks = (seconds / step_s).round() as usize;
    let mut motion = Vec::with_capacity(ticks);
    for _ in 0..ticks {
        vehicle.step(&mut state, &track);
        motion.push(state.coordinates().to_vec());
    }
    assert_eq!(state.stop(), None);
    motion
}

/// Steps for `seconds`.
pub fn run(vehicle: &Vehicle<KalkerBook>, state: &mut VehicleState, track: &Track, seconds: f64) {
    for _ in 0..(seconds / vehicle.step_s()).round() as usize {
        vehicle.step(state, track);
    }
    assert_eq!(state.stop(), None);
}

/// Integrates `y' = rate(y)` by the classical Runge-Kutta method; returns `y` after each of `ticks` ticks of `substeps`
/// steps.
pub fn runge_kutta<const N: usize>(
    mut y: [f64; N],
    rate: impl Fn(&[f64; N]) -> [f64; N],
    tick_s: f64,
    substeps: usize,
    ticks: usize,
) -> Vec<[f64; N]> {
    let h = tick_s / substeps as f64;
    let along = |y: &[f64; N], k: &[f64; N], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    let mut motion = Vec::with_capacity(ticks);
    for _ in 0..ticks {
        for _ in 0..substeps {
            let k1 = rate(&y);
            let k2 = rate(&along(&y, &k1, 0.5 * h));
            let k3 = rate(&along(&y, &k2, 0.5 * h));
            let k4 = rate(&along(&y, &k3, h));
            y = std::array::from_fn(|i| {
                y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i])
            });
        }
        motion.push(y);
    }
    motion
}
