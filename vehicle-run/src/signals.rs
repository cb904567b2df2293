//! What is recorded of a vehicle: one number a tick for each signal, called by body, wheelset or damper, and unit.

use dashpot_rail::contact::{PatchSource, WheelsetForces};
use dashpot_rail::creep::CreepLaw;
use dashpot_rail::vehicle::{Vehicle, VehicleParameters};

use super::{Accelerometer, VehicleTick};

/// A number of a state.
#[derive(Debug, Clone, PartialEq)]
enum Source {
    Time,
    Distance,
    Coordinate { body: usize, coordinate: usize },
    Acceleration { body: usize, coordinate: usize },
    Ride { at: Accelerometer, across: usize },
    WheelLoad { wheelset: usize, side: usize },
    WheelLateral { wheelset: usize, side: usize },
    Derailment { wheelset: usize, side: usize },
    DamperDisplacement(usize),
    DamperForce(usize),
}

/// A signal.
#[derive(Debug, Clone, PartialEq)]
pub struct Signal {
    name: String,
    source: Source,
}

const COORDINATES: [&str; 5] = [
    "lateral_m",
    "vertical_m",
    "roll_rad",
    "pitch_rad",
    "yaw_rad",
];
const ACCELERATIONS: [&str; 2] = [
    "lateral_acceleration_m_per_s2",
    "vertical_acceleration_m_per_s2",
];

/// The sides of a wheelset.
pub const SIDES: [&str; 2] = ["left", "right"];

/// What a body, wheelset or damper is called in the names of its signals: with underscores.
pub fn slug(name: &str) -> String {
    name.replace(|c: char| !c.is_ascii_alphanumeric(), "_")
}

/// Every signal of a vehicle: time and distance; displacements of bodies and wheelsets from where they stand, relative to the track;
/// accelerations of bodies as an accelerometer across the track has them; loads `Q` of wheels, down on the rail; lateral forces `Y`, of
/// the rail on the wheel towards the middle of the track; `Y/Q`; displacement and force of dampers.
pub fn all<L: CreepLaw, S: PatchSource>(vehicle: &Vehicle<L, S>) -> Vec<Signal> {
    let mut signals = Vec::new();
    let mut add = |name: String, source: Source| signals.push(Signal { name, source });
    add("time_s".into(), Source::Time);
    add("distance_m".into(), Source::Distance);
    let bodies = vehicle.names().len() - vehicle.wheelsets();
    for (body, name) in vehicle.names().iter().enumerate() {
        let name = slug(name);
        for (coordinate, what) in COORDINATES.iter().enumerate() {
            // A wheelset's pitch is its spin.
            if body < bodies || coordinate != 3 {
                add(
                    format!("{name}_{what}"),
                    Source::Coordinate { body, coordinate },
                );
            }
        }
        for (coordinate, what) in ACCELERATIONS.iter().enumerate() {
            add(
                format!("{name}_{what}"),
                Source::Acceleration { body, coordinate },
            );
        }
    }
    for (wheelset, name) in vehicle.names()[bodies..].iter().enumerate() {
        let name = slug(name);
        for (side, side_name) in SIDES.iter().enumerate() {
            add(
                format!("{name}_{side_name}_load_n"),
                Source::WheelLoad { wheelset, side },
            );
            add(
                format!("{name}_{side_name}_lateral_n"),
                Source::WheelLateral { wheelset, side },
            );
            add(
                format!("{name}_{side_name}_derailment"),
                Source::Derailment { wheelset, side },
            );
        }
    }
    for (damper, name) in vehicle.damper_names().enumerate() {
        let name = slug(name);
        add(
            format!("{name}_displacement_m"),
            Source::DamperDisplacement(damper),
        );
        add(format!("{name}_force_n"), Source::DamperForce(damper));
    }
    signals
}

/// Accelerations of a vehicle's ride points: of each the lateral one, then the vertical one.
pub fn of_ride(vehicle: &VehicleParameters) -> Vec<Signal> {
    let of_point = |at: Accelerometer| {
        // "body, middle" is body_middle.
        let name = slug(&at.name().replace(", ", " "));
        let signal = |(across, what): (usize, &&str)| Signal {
            name: format!("{name}_{what}"),
            source: Source::Ride {
                at: at.clone(),
                across,
            },
        };
        let signals: Vec<Signal> = ACCELERATIONS.iter().enumerate().map(signal).collect();
        signals
    };
    Accelerometer::all(vehicle)
        .into_iter()
        .flat_map(of_point)
        .collect()
}

impl Signal {
    /// Name with the unit.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it is the force of the damper of this number.
    pub fn is_force_of(&self, damper: usize) -> bool {
        self.source == Source::DamperForce(damper)
    }

    /// Its number after a tick that ended at `time_s`.
    pub fn of(&self, state: &impl VehicleTick, time_s: f64) -> f64 {
        match &self.source {
            Source::Time => time_s,
            Source::Distance => state.distance_m(),
            Source::Coordinate { body, coordinate } => state.coordinates()[*body][*coordinate],
            Source::Acceleration { body, coordinate } => state.acceleration(*body)[*coordinate],
            Source::Ride { at, across } => {
                at.acceleration(|body| state.acceleration(body))[*across]
            }
            Source::WheelLoad { wheelset, side } => load_n(&state.contacts()[*wheelset], *side),
            Source::WheelLateral { wheelset, side } => {
                lateral_n(&state.contacts()[*wheelset], *side)
            }
            Source::Derailment { wheelset, side } => {
                state.contacts()[*wheelset].derailment_coefficients()[*side]
            }
            Source::DamperDisplacement(damper) => state.damper_displacements_m()[*damper],
            Source::DamperForce(damper) => state.damper_forces_n()[*damper],
        }
    }
}

/// Load `Q` of a wheel, down on the rail, N.
pub fn load_n(contact: &WheelsetForces, side: usize) -> f64 {
    // A lifted wheel has none, without a sign.
    0.0 - contact.wheels[side].force_n[2]
}

/// Lateral force `Y` of the rail on a wheel, towards the middle of the track, N.
pub fn lateral_n(contact: &WheelsetForces, side: usize) -> f64 {
    let outward = if side == 0 { 1.0 } else { -1.0 };
    outward * contact.wheels[side].force_n[1]
}
