//! Modes at a speed against Klingel's kinematic motion, and the effect of speed on stability.

use std::f64::consts::PI;
use std::sync::Arc;

use dashpot_rail::contact::{
    ContactGeometry, Installation, Motion, Pair, RailDisplacement, Steel, WheelsetContact,
};
use dashpot_rail::creep::{Friction, KalkerBook};
use dashpot_rail::profile::{Profile, s1002, uic60};
use dashpot_rail::vehicle::{
    Body, Element, End, Law, Mode, Running, VehicleError, VehicleParameters, Wheelset,
};

const CONICITY: f64 = 0.05;

pub type Contact = WheelsetContact<KalkerBook, ContactGeometry>;

/// Conical wheels with the flange root of S1002, on UIC 60.
pub fn cone() -> Contact {
    let points: Vec<[f64; 2]> = s1002::profile()
        .points()
        .iter()
        .step_by(3)
        .map(|point| {
            let y = 1e3 * point.y_m;
            let depth = if y > -25.0 {
                -CONICITY * y
            } else {
                s1002::depth_mm(y) - s1002::depth_mm(-25.0) + CONICITY * 25.0
            };
            [point.y_m, 1e-3 * depth]
        })
        .collect();
    let wheel = Profile::through("cone", &points, 0.0).unwrap();
    let pair = Pair::new(wheel, &uic60::profile(), Installation::default()).unwrap();
    let geometry = Arc::new(ContactGeometry::new(pair, Steel::default()).unwrap());
    WheelsetContact::new(geometry, KalkerBook::new(), Friction::default()).unwrap()
}

fn spring(name: &str, ends: [End; 2], stiffness_n_per_m: [f64; 3]) -> Element {
    let law = Law::SpringDamper {
        stiffness_n_per_m,
        damping_n_s_per_m: [0.0; 3],
    };
    Element::new(name, ends, law)
}

/// A wheelset that carries a body on purely vertical springs; the body is guided along the track.
pub fn free_wheelset() -> VehicleParameters {
    let mut elements = Vec::new();
    for y in [-1.0, 1.0] {
        let at = [0.0, y, 0.625];
        let ends = [End::body("wheelset", at), End::body("body", at)];
        elements.push(spring(&format!("load {y}"), ends, [0.0, 0.0, 1e6]));
    }
    for (x, height) in [(3.0, 0.5), (-3.0, 2.5), (3.0, 2.5), (-3.0, 0.5)] {
        let at = [x, 0.0, height];
        let ends = [End::track(at), End::body("body", at)];
        elements.push(spring(
            &format!("guide {x} {height}"),
            ends,
            [1e7, 1e7, 0.0],
        ));
    }
    let at = [0.0, 0.0, 1.5];
    let law = Law::Bush {
        stiffness_n_per_m: [0.0; 3],
        damping_n_s_per_m: [0.0; 3],
        stiffness_n_m_per_rad: [0.0, 1e7, 0.0],
        damping_n_m_s_per_rad: [0.0; 3],
    };
    let ends = [End::track(at), End::body("body", at)];
    elements.push(Element::new("pitch guide", ends, law));
    let wheelset = Wheelset::new("wheelset", 1800.0, [900.0, 120.0, 900.0], 0.625);
    VehicleParameters::new("one wheelset")
        .with_bodies([Body::new("body", 18e3, [20e3, 100e3, 100e3], 1.5)])
        .with_wheelsets([wheelset])
        .with_elements(elements)
}

fn hunting(modes: &[Mode]) -> &Mode {
    let found = modes
        .iter()
        .find(|mode| mode.description() == "wheelset lateral");
    found.expect("a lateral mode of the wheelset")
}

/// Wavelength `2 pi sqrt(r b / gamma)` (Klingel 1883) of a free wheelset at low speed.
#[test]
fn a_free_wheelset_has_the_wavelength_of_klingel() {
    let contact = cone();
    let speed = 2.0;
    let modes = Running::new(&free_wheelset(), &contact, speed)
        .unwrap()
        .modes()
        .unwrap();
    let hunting = hunting(&modes);
    // Half the distance between the contact points, at a similar load.
    let motion = Motion {
        speed_m_per_s: speed,
        rotation_rad_per_s: speed / 0.625,
        vertical_m: 0.25e-3,
        ..Motion::default()
    };
    let forces = contact.forces(&motion, &[RailDisplacement::default(); 2]);
    let patch = forces.wheels[1].loaded_patches().next().unwrap();
    let (b, r) = (patch.position_m[1], patch.rolling_radius_m);
    let wave_m = 2.0 * PI * (r * b / CONICITY).sqrt();
    let found = speed / hunting.damped_hz();
    assert!(
        (found / wave_m - 1.0).abs() < 0.02,
        "{found} m for {wave_m} m: {}",
        hunting.description()
    );
    assert!(
        hunting.damping_ratio().abs() < 0.05,
        "{}",
        hunting.damping_ratio()
    );
}

/// A free wheelset is never stable, and its hunting grows faster at higher speed.
#[test]
fn a_free_wheelset_is_less_stable_at_higher_speed() {
    let contact = cone();
    let ratio = |speed: f64| {
        let running = Running::new(&free_wheelset(), &contact, speed).unwrap();
        hunting(&running.modes().unwrap()).damping_ratio()
    };
    let ratios = [5.0, 15.0, 30.0].map(ratio);
    assert!(ratios[0] > ratios[1] && ratios[1] > ratios[2], "{ratios:?}");
    assert!(ratios[2] < 0.0, "{ratios:?}");
}

#[test]
fn a_speed_out_of_bounds_and_a_lifted_wheelset_are_rejected() {
    let contact = cone();
    let error = Running::new(&free_wheelset(), &contact, 1e3).unwrap_err();
    assert_eq!(
        error.to_string(),
        "one wheelset: speed_m_per_s = 1000, allowed: 0.1 to 200"
    );
    // A body that overhangs its support lifts the wheelset.
    let mut lifted = free_wheelset();
    lifted.bodies[0].x_m = 5.0;
    let at = [3.0, 0.0, 1.5];
    lifted.elements.push(spring(
        "support",
        [End::track(at), End::body("body", at)],
        [0.0, 0.0, 1e8],
    ));
    for element in &mut lifted.elements[2..6] {
        element.law = Law::SpringDamper {
            stiffness_n_per_m: [1e5, 1e7, 0.0],
            damping_n_s_per_m: [0.0; 3],
        };
    }
    let error = Running::new(&lifted, &contact, 10.0).unwrap_err();
    assert!(matches!(error, VehicleError::NotCarried { .. }), "{error}");
}
