//! A wagon, its contact and tracks.

use std::sync::{Arc, OnceLock};

use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel, Tables, WheelsetContact};
use dashpot_rail::creep::{Friction, Polach};
use dashpot_rail::track::{Defect, Irregularity, Layout, Part, Rails, Track};
use dashpot_rail::vehicle::{Body, Element, End, Law, VehicleParameters, Wheelset};

pub type Contact = WheelsetContact<Polach, Tables>;

/// S1002 on UIC 60.
pub fn contact(static_coefficient: f64) -> Contact {
    static TABLES: OnceLock<Arc<Tables>> = OnceLock::new();
    let tables = TABLES.get_or_init(|| {
        let pair = Pair::standard(Installation::default()).unwrap();
        let geometry = ContactGeometry::new(pair, Steel::default()).unwrap();
        Arc::new(Tables::new(geometry))
    });
    let friction = Friction::constant(static_coefficient);
    WheelsetContact::new(Arc::clone(tables), Polach, friction).unwrap()
}

pub fn body() -> Body {
    Body::new("body", 30e3, [40e3, 900e3, 900e3], 1.5)
}

/// A spring at the point (x, y, height).
pub fn spring(
    between: [Option<&str>; 2],
    at: [f64; 3],
    stiffness_n_per_m: [f64; 3],
    damping_n_s_per_m: [f64; 3],
) -> Element {
    let end = |name: Option<&str>| name.map_or(End::track(at), |name| End::body(name, at));
    let law = Law::SpringDamper {
        stiffness_n_per_m,
        damping_n_s_per_m,
    };
    Element::new(format!("spring {at:?}"), between.map(end), law)
}

/// Springs of a body at (+-X, +-Y), at the height of its centre of gravity.
pub const SPRINGS: [f64; 3] = [2e6, 1.5e6, 1e6];
pub const X: f64 = 4.0;
pub const Y: f64 = 1.0;

/// Four springs between the track and the body.
pub fn springs_on_track() -> Vec<Element> {
    let places = [(X, Y), (X, -Y), (-X, Y), (-X, -Y)];
    let spring_at = |(x, y)| spring([None, Some("body")], [x, y, 1.5], SPRINGS, [0.0; 3]);
    places.into_iter().map(spring_at).collect()
}

pub fn on_track(elements: Vec<Element>) -> VehicleParameters {
    VehicleParameters::new("body on springs")
        .with_bodies([body()])
        .with_elements(elements)
}

/// Two axles, 8 m apart.
pub fn wagon(damping_n_s_per_m: [f64; 3]) -> VehicleParameters {
    let mut elements = Vec::new();
    for (axle, x) in [("front axle", 4.0), ("rear axle", -4.0)] {
        for y in [-1.0, 1.0] {
            let stiffness = [8e6, 3e6, 1e6];
            elements.push(spring(
                [Some(axle), Some("body")],
                [x, y, 0.5],
                stiffness,
                damping_n_s_per_m,
            ));
        }
    }
    let wheelset = |name: &str| Wheelset::new(name, 1500.0, [800.0, 100.0, 800.0], 0.625);
    VehicleParameters::new("wagon")
        .with_bodies([body()])
        .with_wheelsets([
            wheelset("front axle").with_x_m(4.0),
            wheelset("rear axle").with_x_m(-4.0),
        ])
        .with_elements(elements)
}

pub fn track(parts: &[Part], defects: Vec<Defect>) -> Track {
    Track::new(
        Layout::new(parts).unwrap(),
        Irregularity::default(),
        defects,
    )
    .unwrap()
}

/// Distance at which the [`abrupt_curve`] starts, m, and its radius, m.
pub const CURVE_M: f64 = 10.0;
pub const RADIUS: f64 = 800.0;

/// A curve without a transition.
pub fn abrupt_curve() -> Track {
    let circle = Part::Circular {
        radius_m: RADIUS,
        length_m: 500.0,
        cant_m: 0.0,
    };
    track(&[Part::Straight { length_m: CURVE_M }, circle], vec![])
}

pub fn straight(defects: Vec<Defect>) -> Track {
    track(&[Part::Straight { length_m: 1e3 }], defects)
}

/// A dip of the left rail.
pub fn dip(start_m: f64) -> Defect {
    Defect::CosineDip {
        rails: Rails::Left,
        start_m,
        length_m: 3.0,
        depth_m: 8e-3,
    }
}

/// Times from 0 at intervals of `step`.
pub fn times(step: f64, count: usize) -> Vec<f64> {
    (0..=count).map(|k| step * k as f64).collect()
}
