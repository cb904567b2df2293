//! Events: changes of speed, friction and forces on bodies during a run.

use std::fmt;

use dashpot_rail::vehicle::{FRICTION_FACTOR, SPEED_M_PER_S, VehicleParameters};

use super::CaseError;
use super::bounds::check_bounds;
use super::course::Course;

/// Maximum rate of a change of speed, m/s^2. Emergency brakes of trains reach about 2.
pub const MAX_SPEED_RATE_M_PER_S2: f64 = 5.0;

/// Maximum distance of a force from the middle of the vehicle, m.
const MAX_ARM_M: f64 = 50.0;

/// Maximum force, N.
const MAX_FORCE_N: f64 = 1e6;

/// Something that changes during a run.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Change {
    /// Speed, m/s. There are no forces along the track; the wheels keep rolling.
    Speed(f64),
    /// Factor on the friction of all wheels, 1 at the start.
    FrictionFactor(f64),
    /// Force on a body. It replaces earlier forces on this body.
    Force {
        /// Name of the body.
        body: String,
        /// Point of action: metres forward from the middle of the vehicle, to the right, above the top of the rails.
        at_m: [f64; 3],
        /// To the right and downward, N.
        force_n: [f64; 2],
    },
}

/// Event of a run: a quantity goes in a straight line to a new value.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Event {
    /// Start of the change, s.
    pub time_s: f64,
    /// Duration of the change, s; 0 for a jump.
    pub ramp_s: f64,
    /// The quantity and its new value.
    pub change: Change,
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at {} s", self.time_s)?;
        if self.ramp_s > 0.0 {
            write!(f, ", within {} s", self.ramp_s)?;
        }
        match &self.change {
            Change::Speed(speed_m_per_s) => write!(f, ": speed {:.1} km/h", 3.6 * speed_m_per_s),
            Change::FrictionFactor(factor) => write!(f, ": friction times {factor}"),
            Change::Force {
                body,
                at_m: [x, y, height],
                force_n: [lateral, downward],
            } => write!(
                f,
                ": {:.1} kN to the right and {:.1} kN down on {body}, {x} m forward, {y} m to the right, \
                 {height} m high",
                1e-3 * lateral,
                1e-3 * downward
            ),
        }
    }
}

/// Event as written in a file.
#[derive(Debug, Clone, PartialEq, Default, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EventOptions {
    /// Start of the change, s.
    pub time_s: f64,
    /// Duration of the change, s.
    #[serde(default)]
    pub ramp_s: f64,
    /// New speed, km/h.
    pub speed_km_h: Option<f64>,
    /// New factor on the friction.
    pub friction_factor: Option<f64>,
    /// Body on which the force acts.
    pub force_on: Option<String>,
    /// Point of action of the force, m.
    pub force_at_m: Option<[f64; 3]>,
    /// Lateral and downward force, N.
    pub force_n: Option<[f64; 2]>,
}

impl EventOptions {
    /// Checks the event on its own.
    fn event(&self, vehicle: &VehicleParameters, duration_s: f64) -> Result<Event, String> {
        let within = |key, value, allowed| {
            check_bounds(key, value, allowed).map_err(|error| error.to_string())
        };
        let Self { time_s, ramp_s, .. } = *self;
        within("time_s", time_s, [0.0, duration_s])?;
        within("ramp_s", ramp_s, [0.0, 36e3])?;
        let force = (&self.force_on, self.force_at_m, self.force_n);
        let change = match (self.speed_km_h, self.friction_factor, force) {
            (Some(speed_km_h), None, (None, None, None)) => {
                within(
                    "speed_km_h",
                    speed_km_h,
                    SPEED_M_PER_S.map(|speed| 3.6 * speed),
                )?;
                Change::Speed(speed_km_h / 3.6)
            }
            (None, Some(factor), (None, None, None)) => {
                within("friction_factor", factor, FRICTION_FACTOR)?;
                Change::FrictionFactor(factor)
            }
            (None, None, (Some(body), Some(at_m), Some(force_n))) => {
                let bodies = vehicle.bodies.iter();
                let names: Vec<&str> = bodies.map(|body| body.name.as_str()).collect();
                if !names.contains(&body.as_str()) {
                    return Err(format!("force_on `{body}`, allowed: {}", names.join(", ")));
                }
                for metres in at_m {
                    within("force_at_m", metres, [-MAX_ARM_M, MAX_ARM_M])?;
                }
                for newtons in force_n {
                    within("force_n", newtons, [-MAX_FORCE_N, MAX_FORCE_N])?;
                }
                Change::Force {
                    body: body.clone(),
                    at_m,
                    force_n,
                }
            }
            _ => {
                return Err(
                    "allowed: one of `speed_km_h`, `friction_factor`, or `force_on` with `force_at_m` and `force_n`"
                        .into(),
                );
            }
        };
        Ok(Event {
            time_s,
            ramp_s,
            change,
        })
    }
}

/// Resolves the events and sorts them by time.
pub(super) fn resolve(
    events: &[EventOptions],
    vehicle: &VehicleParameters,
    speed_m_per_s: f64,
    duration_s: f64,
) -> Result<Vec<Event>, CaseError> {
    let mut order: Vec<(usize, &EventOptions)> = events.iter().enumerate().collect();
    order.sort_by(|a, b| a.1.time_s.total_cmp(&b.1.time_s));
    let mut speed = Course::new([speed_m_per_s]);
    let mut resolved = Vec::new();
    for (index, event) in order {
        let number = index + 1;
        let invalid = |reason: String| CaseError::Event { number, reason };
        let event = event.event(vehicle, duration_s).map_err(invalid)?;
        if let Change::Speed(new) = event.change {
            let change = new - speed.at(event.time_s)[0];
            let least_s = change.abs() / MAX_SPEED_RATE_M_PER_S2;
            if event.ramp_s < least_s {
                return Err(invalid(format!(
                    "ramp_s {}, allowed: at least {least_s:.3}, for a rate of {MAX_SPEED_RATE_M_PER_S2} m/s^2",
                    event.ramp_s
                )));
            }
            speed.then(event.time_s, event.ramp_s, [new]);
        }
        resolved.push(event);
    }
    Ok(resolved)
}
