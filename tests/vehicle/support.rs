//! Shared contacts, tracks and vehicles.

use std::sync::{Arc, OnceLock};

use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel, Tables, WheelsetContact};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::track::{Irregularity, Layout, Part, Track};
use dashpot_rail::vehicle::{Vehicle, VehicleParameters, VehicleState};

pub type Contact = Arc<WheelsetContact<KalkerBook>>;

/// S1002 on UIC 60, with friction 0.3 and this normal damping.
pub fn contact(normal_damping_s_per_m: f64) -> Contact {
    static TABLES: OnceLock<Arc<Tables>> = OnceLock::new();
    let tables = TABLES.get_or_init(|| Arc::new(Tables::new(geometry())));
    let contact = WheelsetContact::new(Arc::clone(tables), KalkerBook::new(), friction()).unwrap();
    Arc::new(contact.with_normal_damping(normal_damping_s_per_m).unwrap())
}

/// The same contact computed from the geometry, without tables and normal damping.
pub fn contact_without_tables() -> WheelsetContact<KalkerBook, ContactGeometry> {
    WheelsetContact::new(Arc::new(geometry()), KalkerBook::new(), friction()).unwrap()
}

fn geometry() -> ContactGeometry {
    let installation = Installation::default().with_wheel_radius_m(0.625);
    let pair = Pair::standard(installation).unwrap();
    ContactGeometry::new(pair, Steel::default()).unwrap()
}

fn friction() -> Friction {
    Friction::constant(0.3)
}

/// The locomotive without yaw dampers, as independent computations have it.
pub fn locomotive() -> VehicleParameters {
    dashpot_files::vehicle::load("locomotive-without-yaw-dampers", &[]).unwrap()
}

/// Total mass of bodies and wheelsets.
pub fn mass_kg(parameters: &VehicleParameters) -> f64 {
    let bodies = parameters.bodies.iter().map(|body| body.mass_kg);
    let wheelsets = parameters.wheelsets.iter().map(|wheelset| wheelset.mass_kg);
    bodies.chain(wheelsets).sum()
}

/// A straight, a transition, and a curve with 0.12 m of cant. A positive radius is a right-hand curve.
pub fn curve(radius_m: f64) -> Track {
    let parts = [
        Part::Straight { length_m: 40.0 },
        Part::Transition { length_m: 60.0 },
        Part::Circular {
            radius_m,
            length_m: 1e3,
            cant_m: 0.12_f64.copysign(radius_m),
        },
    ];
    Track::new(
        Layout::new(&parts).unwrap(),
        Irregularity::default(),
        vec![],
    )
    .unwrap()
}

/// Steps for `seconds`.
pub fn run(vehicle: &Vehicle<KalkerBook>, state: &mut VehicleState, track: &Track, seconds: f64) {
    for _ in 0..(seconds / vehicle.step_s()).round() as usize {
        vehicle.step(state, track);
    }
    assert!(!state.is_diverged());
}
