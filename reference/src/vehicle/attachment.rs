//! Attachment of an element's end to a body: its motion with the body, and the loads on the body.

use dashpot_rail::vehicle::{End, VehicleParameters};

/// Lateral, vertical, roll, pitch and yaw of a body.
pub(super) type Coordinates = [f64; 5];

/// Components along or about x, y and z.
pub(super) type Vector = [f64; 3];

/// Displacement of a body and its rate.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pose {
    pub(super) displacement: Coordinates,
    pub(super) rate: Coordinates,
}

/// Attachment of an element's end.
#[derive(Clone, Debug)]
pub(super) struct Attachment {
    /// Index of the body, counting the wheelsets after the bodies; `None` on the track.
    pub(super) body: Option<usize>,
    /// Position relative to the body's centre (m).
    pub(super) arm: Vector,
    /// True if the end is on an axlebox, which does not rotate with its wheelset.
    pub(super) is_axlebox: bool,
}

impl Attachment {
    /// Builds the attachment of an end; its body must exist in the vehicle.
    pub(super) fn new(vehicle: &VehicleParameters, end: &End) -> Self {
        let name = end.on.as_ref();
        let body = vehicle
            .bodies
            .iter()
            .position(|body| Some(&body.name) == name);
        let wheelset = vehicle
            .wheelsets
            .iter()
            .position(|wheelset| Some(&wheelset.name) == name);
        let is_axlebox = body.is_none() && wheelset.is_some();
        let (body, centre) = match (body, wheelset) {
            (Some(number), _) => {
                let body = &vehicle.bodies[number];
                (Some(number), [body.x_m, body.height_m])
            }
            (None, Some(number)) => {
                let wheelset = &vehicle.wheelsets[number];
                let behind = vehicle.bodies.len() + number;
                (Some(behind), [wheelset.x_m, wheelset.radius_m])
            }
            (None, None) => (None, [0.0; 2]),
        };
        let [x, y, height] = end.at_m;
        Self {
            body,
            arm: [x - centre[0], y, centre[1] - height],
            is_axlebox,
        }
    }

    /// Displacement of the attachment, `u + omega x r`, without the longitudinal part of pitch.
    pub(super) fn shift(&self, motion: &Coordinates) -> Vector {
        let [roll, pitch, yaw] = self.turn(motion);
        let [x, y, z] = self.arm;
        [
            -yaw * y,
            motion[0] - roll * z + yaw * x,
            motion[1] + roll * y - pitch * x,
        ]
    }

    /// Rotation of the attachment about x, y and z.
    pub(super) fn turn(&self, motion: &Coordinates) -> Vector {
        let pitch = if self.is_axlebox { 0.0 } else { motion[3] };
        [motion[2], pitch, motion[4]]
    }

    /// Force, and moments about the body's centre, caused by `force` and `moment` at the attachment.
    pub(super) fn load(&self, force: &Vector, moment: &Vector) -> Coordinates {
        let [x, y, z] = self.arm;
        let pitching = moment[1] - x * force[2];
        [
            force[1],
            force[2],
            moment[0] + y * force[2] - z * force[1],
            if self.is_axlebox { 0.0 } else { pitching },
            moment[2] + x * force[1] - y * force[0],
        ]
    }
}

pub(super) fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
