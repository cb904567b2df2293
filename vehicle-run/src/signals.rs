//! Recorded signals of a vehicle: one value per tick, named after the body, wheelset or damper, with the unit.

use dashpot_rail::contact::{PatchSource, WheelsetForces};
use dashpot_rail::creep::CreepLaw;
use dashpot_rail::vehicle::{Vehicle, VehicleParameters};

use super::{Accelerometer, VehicleTick};

/// Origin of a signal's value.
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
    ContactPosition { wheelset: usize, side: usize },
    DamperDisplacement(usize),
    DamperVelocity(usize),
    DamperForce(usize),
    FrictionForce(usize),
}

/// One recorded signal.
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

/// Sides of a wheelset, in the order of its wheels.
pub const SIDES: [&str; 2] = ["left", "right"];

/// Form of a name used in signal names: every character other than ASCII letters and digits becomes an underscore.
///
/// ```
/// use dashpot_vehicle_run::signals::slug;
/// assert_eq!(slug("front lateral damper 1"), "front_lateral_damper_1");
/// ```
pub fn slug(name: &str) -> String {
    name.replace(|c: char| !c.is_ascii_alphanumeric(), "_")
}

/// Returns all signals of a vehicle except those of the ride points ([`ride`]):
///
/// - time and distance;
/// - displacements of bodies and wheelsets from standstill, relative to the track;
/// - accelerations of bodies as measured by an accelerometer, across the track;
/// - wheel loads `Q`, positive down on the rail;
/// - lateral forces `Y` of the rail on the wheel, positive towards the middle of the track;
/// - `Y/Q`;
/// - displacements, velocities and forces of dampers;
/// - forces of friction elements.
pub fn all<L: CreepLaw, S: PatchSource>(vehicle: &Vehicle<L, S>) -> Vec<Signal> {
    let mut signals = Vec::new();
    let mut add = |name: String, source: Source| signals.push(Signal { name, source });
    add("time_s".into(), Source::Time);
    add("distance_m".into(), Source::Distance);
    let bodies = vehicle.names().len() - vehicle.wheelsets();
    for (body, name) in vehicle.names().iter().enumerate() {
        let name = slug(name);
        for (coordinate, suffix) in COORDINATES.iter().enumerate() {
            // A wheelset's pitch is its spin.
            if body < bodies || coordinate != 3 {
                add(
                    format!("{name}_{suffix}"),
                    Source::Coordinate { body, coordinate },
                );
            }
        }
        for (coordinate, suffix) in ACCELERATIONS.iter().enumerate() {
            add(
                format!("{name}_{suffix}"),
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
            add(
                format!("{name}_{side_name}_contact_m"),
                Source::ContactPosition { wheelset, side },
            );
        }
    }
    for (damper, name) in vehicle.damper_names().enumerate() {
        let name = slug(name);
        add(
            format!("{name}_displacement_m"),
            Source::DamperDisplacement(damper),
        );
        add(
            format!("{name}_velocity_m_per_s"),
            Source::DamperVelocity(damper),
        );
        add(format!("{name}_force_n"), Source::DamperForce(damper));
    }
    for (element, name) in vehicle.friction_names().enumerate() {
        add(
            format!("{}_force_n", slug(name)),
            Source::FrictionForce(element),
        );
    }
    signals
}

/// Returns the accelerations of a vehicle's ride points: lateral, then vertical, for each point.
pub fn ride(vehicle: &VehicleParameters) -> Vec<Signal> {
    let point_signals = |at: Accelerometer| {
        // "body, middle" becomes "body_middle".
        let name = slug(&at.name().replace(", ", " "));
        let signal = |(across, suffix): (usize, &&str)| Signal {
            name: format!("{name}_{suffix}"),
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
        .flat_map(point_signals)
        .collect()
}

impl Signal {
    /// Name, which ends in the unit.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// True if this is the force of the damper with index `damper`.
    pub fn is_force_of(&self, damper: usize) -> bool {
        self.source == Source::DamperForce(damper)
    }

    /// Value after a tick that ended at `time_s`.
    pub fn value(&self, state: &impl VehicleTick, time_s: f64) -> f64 {
        match &self.source {
            Source::Time => time_s,
            Source::Distance => state.distance_m(),
            Source::Coordinate { body, coordinate } => state.coordinates()[*body][*coordinate],
            Source::Acceleration { body, coordinate } => state.acceleration(*body)[*coordinate],
            Source::Ride { at, across } => {
                at.acceleration(|body| state.acceleration(body))[*across]
            }
            Source::WheelLoad { wheelset, side } => {
                state.contacts()[*wheelset].wheels[*side].load_n()
            }
            Source::WheelLateral { wheelset, side } => {
                lateral_n(&state.contacts()[*wheelset], *side)
            }
            Source::Derailment { wheelset, side } => {
                state.contacts()[*wheelset].derailment_coefficients()[*side]
            }
            Source::DamperDisplacement(damper) => state.damper_displacements_m()[*damper],
            Source::ContactPosition { wheelset, side } => {
                contact_m(&state.contacts()[*wheelset], *side)
            }
            Source::DamperVelocity(damper) => state.damper_velocities_m_per_s()[*damper],
            Source::DamperForce(damper) => state.damper_forces_n()[*damper],
            Source::FrictionForce(element) => state.friction_forces_n()[*element],
        }
    }
}

/// Lateral position on the wheel of the patch with the greatest load, from the tread datum, field side positive, m; 0
/// while the wheel is lifted.
pub fn contact_m(contact: &WheelsetForces, side: usize) -> f64 {
    let patches = contact.wheels[side].loaded_patches();
    let heaviest = patches.max_by(|a, b| a.load_n.total_cmp(&b.load_n));
    heaviest.map_or(0.0, |patch| patch.wheel_y_m)
}

/// Lateral force `Y` of the rail on a wheel, positive towards the middle of the track, N.
pub fn lateral_n(contact: &WheelsetForces, side: usize) -> f64 {
    let outward = if side == 0 { 1.0 } else { -1.0 };
    outward * contact.wheels[side].force_n[1]
}
