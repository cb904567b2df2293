//! Outlines of a vehicle's bodies for drawings: a vehicle file has no shapes, only positions of masses and elements.

use dashpot_rail::vehicle::{Body, Element, VehicleParameters};

/// Half the height of a frame between wheelsets, m.
const HALF_FRAME_M: f64 = 0.17;
/// Length of a frame beyond its outermost element, m.
const FRAME_OVERHANG_M: f64 = 0.5;
/// Length of a body beyond the outermost wheelsets, m.
const BODY_OVERHANG_M: f64 = 2.0;
/// Lower and upper edge of a body above the rails, m.
const BODY_HEIGHT_M: [f64; 2] = [1.15, 4.0];

/// Outline of a body from its right side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outline {
    /// Rear and front end, m from the middle of the vehicle.
    pub x_m: [f64; 2],
    /// Lower and upper edge above the top of the rails, m.
    pub height_m: [f64; 2],
    /// True for a bogie frame, which carries wheelsets.
    pub is_frame: bool,
}

impl Outline {
    /// Returns the outline of a body of a vehicle.
    pub fn of(vehicle: &VehicleParameters, body: &Body) -> Self {
        if is_frame(vehicle, body) {
            let [rear, front] = reach(vehicle, body);
            return Self {
                x_m: [rear - FRAME_OVERHANG_M, front + FRAME_OVERHANG_M],
                height_m: [body.height_m - HALF_FRAME_M, body.height_m + HALF_FRAME_M],
                is_frame: true,
            };
        }
        let [rear, front] = wheelbase(vehicle);
        Self {
            x_m: [rear - BODY_OVERHANG_M, front + BODY_OVERHANG_M],
            height_m: BODY_HEIGHT_M,
            is_frame: false,
        }
    }
}

/// Positions of the rearmost and the foremost wheelset, m from the middle of the vehicle.
pub fn wheelbase(vehicle: &VehicleParameters) -> [f64; 2] {
    let positions = vehicle.wheelsets.iter().map(|wheelset| wheelset.x_m);
    positions.fold([0.0, 0.0], |[rear, front]: [f64; 2], x| {
        [rear.min(x), front.max(x)]
    })
}

/// True if an end of the element is attached to the part called `name`.
fn is_on(element: &Element, name: &str) -> bool {
    element
        .ends
        .iter()
        .any(|end| end.on.as_deref() == Some(name))
}

/// Returns the rearmost and foremost position of the elements attached to a body (m).
fn reach(vehicle: &VehicleParameters, body: &Body) -> [f64; 2] {
    let elements = vehicle
        .elements
        .iter()
        .filter(|element| is_on(element, &body.name));
    let positions = elements.flat_map(|element| element.ends.iter().map(|end| end.at_m[0]));
    positions.fold([body.x_m, body.x_m], |[min, max], x| {
        [min.min(x), max.max(x)]
    })
}

/// True if the body carries wheelsets, as a bogie frame does.
fn is_frame(vehicle: &VehicleParameters, body: &Body) -> bool {
    let is_wheelset = |element: &Element| {
        let mut wheelsets = vehicle.wheelsets.iter();
        wheelsets.any(|wheelset| is_on(element, &wheelset.name))
    };
    let mut elements = vehicle.elements.iter();
    vehicle.bodies.len() > 1
        && elements.any(|element| is_on(element, &body.name) && is_wheelset(element))
}
