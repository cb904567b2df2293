//! Condition of a vehicle's lateral dampers from accelerometers on its body and bogies alone.
//!
//! The sensors measure how the body moves on its bogies. The lateral and yaw balance of forces on the body then gives a
//! factor for the force of each damper, each bogie's springs and its yaw dampers. Factors relative to a baseline, the
//! same vehicle as new, show which dampers have lost force. Method, results and limits: docs/vehicle-sensors.md.
//!
//! Data flow: [`Layout`] (what the vehicle file says), [`Readings`] (what the sensors read), motion, equations,
//! [`Factors`], [`Assessment`].

mod assessment;
mod baseline;
mod equations;
mod error;
mod factors;
mod law;
mod layout;
mod limits;
mod motion;
mod readings;
mod rigid;
mod transform;

pub use assessment::{Assessment, BogieReading, Condition, DamperReading, FactorRatio};
pub use baseline::Baseline;
pub use error::SensorsError;
pub use factors::Factors;
pub use layout::Layout;
pub use limits::MAX_UNEXPLAINED;
pub use readings::{Axis, Readings};

/// Evaluates recordings of one vehicle together: returns the factors of its forces over all of them.
///
/// # Errors
/// A recording is too short, its rate too low, or a sensor is missing or dead; or all recordings together do not
/// determine the factors.
pub fn evaluate(layout: &Layout, recordings: &[Readings]) -> Result<Factors, SensorsError> {
    let mut blocks = Vec::new();
    let mut used: Option<Vec<String>> = None;
    for readings in recordings {
        let sensors = rigid::Sensors::of(layout, readings)?;
        match &used {
            Some(names) if *names != sensors.names => {
                return Err(SensorsError::OtherSensors {
                    recording: readings.name.clone(),
                    sensors: sensors.names,
                    others: names.clone(),
                });
            }
            Some(_) => {}
            None => used = Some(sensors.names.clone()),
        }
        for (duration_s, columns) in readings.pieces() {
            let motion = motion::motion(&sensors, duration_s, &columns, readings.has_gravity);
            blocks.extend(equations::blocks(layout, duration_s, &motion)?);
        }
    }
    Factors::solve(layout, used.unwrap_or_default(), &blocks)
}

#[cfg(test)]
mod tests;
