//! One run of the benchmark.

use dashpot_core::BuildError;
use dashpot_core::hybrid::{
    AdaptiveSettings, AdaptiveTimeSeries, Compensator, InverseModel, Motion, Uncompensated,
};

use super::criteria::{Criteria, Signals};
use super::plant::{MovingPlant, Plant};
use super::structure::Frame;
use super::{CASES, RATE_HZ};
use crate::sensor::{Noise, Sensor, SensorSettings};

/// Displacement of a storey beyond which a run counts as unstable (m).
const UNSTABLE_M: f64 = 1.0;

/// How the actuator is controlled. Every compensator knows the nominal plant only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// The desired displacement is the command.
    None,
    /// The inverse of the nominal plant.
    Inverse,
    /// The adaptive time series, which starts from that inverse.
    Adaptive,
}

/// Sensors of displacement and force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sensors {
    /// Perfect sensors.
    Perfect,
    /// 18 bits a volt over 3.8 V in either direction, at 1 V/m; the command has the same resolution.
    Quantised,
    /// The same with the noise of the benchmark's program: 16 um and 2.2 N, standard deviation.
    Noisy,
}

/// A run that has no criteria.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// The case does not exist.
    #[error("case {case} is not allowed: must be 1 to 4")]
    Case {
        /// The case, counted from 1.
        case: usize,
    },
    /// The motion grew without a limit.
    #[error("unstable: the specimen moved by more than 1 m after {time_s:.2} s")]
    Unstable {
        /// When (s).
        time_s: f64,
    },
    /// The ground does not move, so there is nothing to compare.
    #[error("the ground does not move")]
    Still,
    /// A compensator cannot be built.
    #[error(transparent)]
    Compensator(#[from] BuildError),
}

/// Runs a case, counted from 1, with a plant on moving ground (m/s^2 at each tick of 1/4096 s).
///
/// # Errors
/// The case does not exist, the ground does not move, or the run is unstable.
///
/// ```
/// use dashpot_hybrid::benchmark::{Control, Plant, Sensors, earthquake, run};
///
/// let ground = earthquake(1);
/// let criteria = run(1, &Plant::NOMINAL, &ground, Control::Adaptive, Sensors::Quantised, 1)?;
/// assert!(criteria.j1_ms <= 0.25 && criteria.j2_percent < 1.0 && criteria.j4_percent < 2.5);
/// # Ok::<(), dashpot_hybrid::benchmark::RunError>(())
/// ```
pub fn run(
    case: usize,
    plant: &Plant,
    ground_m_per_s2: &[f64],
    control: Control,
    sensors: Sensors,
    seed: u64,
) -> Result<Criteria, RunError> {
    if !(1..=CASES).contains(&case) {
        return Err(RunError::Case { case });
    }
    if !ground_m_per_s2.iter().any(|a| *a != 0.0) {
        return Err(RunError::Still);
    }
    let mut compensator = compensator(control)?;
    let [displacement_settings, force_settings] = settings(sensors);
    let step_s = 1.0 / RATE_HZ;
    let mut displacement_sensor = Sensor::new(displacement_settings, step_s);
    let mut force_sensor = Sensor::new(force_settings, step_s);
    let mut noise = Noise::new(seed);
    let mut frame = Frame::simulated(case - 1, plant);
    let mut whole = Frame::whole(case - 1);
    let mut moving = MovingPlant::new(plant);
    let mut signals = Signals::default();
    let (mut measured, mut force, mut last_acceleration) = (0.0, 0.0, 0.0);
    for (tick, ground) in ground_m_per_s2.iter().enumerate() {
        let (reached_m, force_n) = moving.output();
        measured = displacement_sensor
            .read(reached_m, &mut noise)
            .unwrap_or(measured);
        force = force_sensor.read(force_n, &mut noise).unwrap_or(force);
        let desired_m = frame.displacements_m()[0];
        let (velocity, acceleration) = frame.first_storey(*ground, force);
        let desired = Motion {
            displacement_m: desired_m as f32,
            velocity_m_per_s: velocity as f32,
            acceleration_m_per_s2: acceleration as f32,
            jerk_m_per_s3: ((acceleration - last_acceleration) * RATE_HZ) as f32,
        };
        last_acceleration = acceleration;
        let command = compensator.command_m(&desired);
        compensator.observe(command, measured as f32);
        let mut command_m = f64::from(command);
        if displacement_settings.resolution > 0.0 {
            let resolution = displacement_settings.resolution;
            command_m = libm::round(command_m / resolution) * resolution;
        }
        signals.measured.push(measured);
        signals.reached.push(reached_m);
        for (storeys, frame) in [
            (&mut signals.simulated, &frame),
            (&mut signals.reference, &whole),
        ] {
            for (storey, x) in storeys.iter_mut().zip(frame.displacements_m()) {
                storey.push(x);
            }
        }
        // False for numbers that are none.
        let is_stable = reached_m.abs() < UNSTABLE_M && desired_m.abs() < UNSTABLE_M;
        if !is_stable {
            let time_s = tick as f64 / RATE_HZ;
            return Err(RunError::Unstable { time_s });
        }
        frame.step(*ground, force);
        whole.step(*ground, 0.0);
        moving.step(command_m);
    }
    Ok(Criteria::of(&signals))
}

fn compensator(control: Control) -> Result<Box<dyn Compensator>, BuildError> {
    let nominal = Plant::NOMINAL.inverse().map(|a| a as f32);
    Ok(match control {
        Control::None => Box::new(Uncompensated),
        Control::Inverse => Box::new(InverseModel::new(nominal)?),
        Control::Adaptive => {
            let settings = AdaptiveSettings {
                largest_change: [0.05, 4e-3, 5e-5, 4e-7],
                noise_m: 2e-6,
                change_s: 0.25,
                ..AdaptiveSettings::new(nominal, 4e-3)
            };
            Box::new(AdaptiveTimeSeries::new(&settings, (1.0 / RATE_HZ) as f32)?)
        }
    })
}

/// Settings of the sensors of displacement (m) and force (N).
fn settings(sensors: Sensors) -> [SensorSettings; 2] {
    let perfect = SensorSettings::default();
    let quantised = SensorSettings {
        resolution: 1.0 / 262_144.0,
        range: 3.8,
        ..perfect
    };
    // The program gives the power of a white noise; its variance is the power times the rate.
    let deviation = |power: f64| libm::sqrt(power * RATE_HZ);
    match sensors {
        Sensors::Perfect => [perfect, perfect],
        Sensors::Quantised => [quantised, perfect],
        Sensors::Noisy => [
            SensorSettings {
                noise: deviation(6.25e-14),
                ..quantised
            },
            SensorSettings {
                noise: deviation(1.16e-3),
                ..perfect
            },
        ],
    }
}
