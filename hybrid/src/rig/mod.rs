//! A virtual rig: an actuator moves a damper, and sensors read its displacement and force.

mod client;
mod error;
mod fault;
mod keeper;
mod server;

pub use client::RigClient;
use dashpot_core::hybrid::Measured;
use dashpot_core::{BuildError, CheckedParameters, Damper, DamperState};
use dashpot_files::actuator::ActuatorParameters;
pub use error::RigError;
use fault::SensorFaults;
pub use fault::{Reading, RigFault};
pub use keeper::{CommandKeeper, KeeperSettings};
pub use server::RigServer;

use crate::actuator::Actuator;
use crate::sensor::{Noise, Sensor};

/// Longest step of actuator and damper (s): a sixteenth of the period of the fastest actuator.
const LONGEST_STEP_S: f64 = 1.0 / 16_000.0;

/// A virtual rig.
///
/// Sensors are read at the end of a tick, so the command of one tick is answered in the next.
///
/// ```
/// use dashpot_files::{actuator::ActuatorParameters, damper};
/// use dashpot_hybrid::rig::VirtualRig;
///
/// let actuator = ActuatorParameters::load("servo")?;
/// let damper = damper::load("reduced-lateral", &[])?;
/// let mut rig = VirtualRig::new(&actuator, &damper, 1e-3, 1)?;
/// let measured = (0..300).filter_map(|_| rig.tick(2e-3)).last();
/// assert!(measured.is_some_and(|measured| (measured.displacement_m - 2e-3).abs() < 0.02e-3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct VirtualRig {
    actuator: Actuator,
    damper: Damper<f64>,
    state: DamperState<f64>,
    force_n: f64,
    sensors: [Sensor; 2],
    noise: Noise,
    /// Steps of actuator and damper in a tick.
    steps: u32,
    saturated_ticks: u64,
    is_broken: bool,
    faults: SensorFaults,
}

impl VirtualRig {
    /// A rig at rest in the middle of the stroke, for ticks of `step_s`. Its noise depends on the seed.
    ///
    /// # Errors
    /// The damper cannot be built for the steps of the rig, or its mounts are too stiff for the moving mass of the
    /// actuator.
    pub fn new(
        actuator: &ActuatorParameters,
        damper: &CheckedParameters,
        step_s: f64,
        seed: u64,
    ) -> Result<Self, RigError> {
        // A step of a sixteenth of a millisecond must not become two by rounding.
        let steps = libm::ceil(step_s / LONGEST_STEP_S * (1.0 - 1e-9)).max(1.0);
        check_stiffness(actuator, damper, step_s / steps)?;
        let damper: Damper<f64> = damper.build(step_s / steps)?;
        let sensors = [
            (&actuator.displacement_sensor).into(),
            (&actuator.force_sensor).into(),
        ];
        Ok(Self {
            actuator: Actuator::new(actuator, step_s / steps),
            state: damper.at_rest(0.0),
            damper,
            force_n: 0.0,
            sensors: sensors.map(|settings| Sensor::new(settings, step_s)),
            noise: Noise::new(seed),
            steps: steps as u32,
            saturated_ticks: 0,
            is_broken: false,
            faults: SensorFaults::default(),
        })
    }

    /// Follows the command (m) for a tick; returns the readings at its end, or `None` if one did not come.
    pub fn tick(&mut self, command_m: f64) -> Option<Measured> {
        let mut is_saturated = false;
        for _ in 0..self.steps {
            self.actuator.step(command_m, self.force_n);
            is_saturated |= self.actuator.is_saturated();
            let displacement_m = self.actuator.displacement_m();
            let force_n = self.damper.step(&mut self.state, displacement_m);
            self.force_n = if self.is_broken { 0.0 } else { force_n };
        }
        self.saturated_ticks += u64::from(is_saturated);
        let values = [self.actuator.measured_m(), self.force_n];
        let [displacement, force] = &mut self.sensors;
        let read = [
            displacement.read(values[0], &mut self.noise),
            force.read(values[1], &mut self.noise),
        ];
        let [displacement_m, force_n] =
            self.faults.changed(read).map(|read| read.map(|x| x as f32));
        Some(Measured {
            displacement_m: displacement_m?,
            force_n: force_n?,
        })
    }

    /// Lets a fault begin.
    ///
    /// # Errors
    /// The new damper cannot be built for the steps of the rig.
    pub fn begin(&mut self, fault: &RigFault) -> Result<(), BuildError> {
        match fault {
            RigFault::Specimen(parameters) => {
                self.damper = parameters.build(self.damper.step_s())?;
                self.damper.adopt(&mut self.state);
            }
            RigFault::Broken => self.is_broken = true,
            RigFault::Weak(share) => self.actuator.weaken(*share),
            RigFault::Noisy(factor) => {
                for sensor in &mut self.sensors {
                    sensor.amplify_noise(*factor);
                }
            }
            RigFault::Stuck(reading) => self.faults.stuck[*reading as usize] = true,
            RigFault::Reversed(reading) => self.faults.reversed[*reading as usize] = true,
            RigFault::Silent(ticks) => self.faults.silent_ticks = *ticks,
        }
        Ok(())
    }

    /// Ticks in which a limit of valve, velocity or force held.
    pub fn saturated_ticks(&self) -> u64 {
        self.saturated_ticks
    }
}

/// Largest product of the resonance of mass, oil and specimen (rad/s) and the step (s); beyond 2 it would grow.
const MAX_PHASE: f64 = 1.0;

/// Checks that the steps resolve the resonance of the moving mass.
fn check_stiffness(
    actuator: &ActuatorParameters,
    damper: &CheckedParameters,
    step_s: f64,
) -> Result<(), RigError> {
    let Some([mass_kg, held_n_per_m]) = Actuator::moving(actuator) else {
        return Ok(());
    };
    let specimen_n_per_m = 1.0 / damper.mount.compliance_m_per_n();
    let w = libm::sqrt((held_n_per_m + specimen_n_per_m) / mass_kg);
    if w * step_s <= MAX_PHASE {
        return Ok(());
    }
    let hz = std::f64::consts::TAU.recip();
    Err(RigError::Resonance {
        resonance_hz: w * hz,
        highest_hz: MAX_PHASE / step_s * hz,
    })
}
