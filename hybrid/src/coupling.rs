//! Coupling of a simulated vehicle with a rig.

use dashpot_core::BuildError;
use dashpot_core::hybrid::{
    Command, Measured, Motion, MotionFilter, TransferSettings, TransferSystem,
};

use crate::compensation::AnyCompensator;

/// Pole of the filter that estimates the motion of the simulated damper (Hz).
const MOTION_HZ: f64 = 100.0;

/// Pole of the filter for ticks of `step_s` (Hz).
pub(crate) fn motion_hz(step_s: f64) -> f64 {
    MOTION_HZ.min(0.25 / step_s)
}

/// Couples one simulated damper with a rig, tick by tick.
///
/// A force that is measured at the end of a tick acts on the vehicle at the end of the next one. With compensation the
/// rig is therefore asked for the displacement one tick ahead, by the Taylor series of the motion: then the force acts
/// when it is due.
#[derive(Clone, Debug)]
pub struct Coupling {
    filter: MotionFilter,
    transfer: TransferSystem<AnyCompensator>,
    lead_s: f32,
    was_placed: bool,
}

/// A tick of a [`Coupling`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoupledTick {
    /// Displacement that the rig should have reached in this tick (m).
    pub desired_m: f32,
    /// Command, force for the vehicle and status.
    pub command: Command,
}

impl Coupling {
    /// A coupling for ticks of `step_s`, with the vehicle and the rig at rest.
    ///
    /// # Errors
    /// A setting or the step is outside its range.
    pub fn new(
        compensator: AnyCompensator,
        settings: &TransferSettings,
        step_s: f64,
    ) -> Result<Self, BuildError> {
        let is_compensated = !matches!(compensator, AnyCompensator::None(_));
        let step = step_s as f32;
        Ok(Self {
            filter: MotionFilter::new(motion_hz(step_s) as f32, step)?,
            transfer: TransferSystem::new(compensator, settings, step)?,
            lead_s: if is_compensated { step } else { 0.0 },
            was_placed: false,
        })
    }

    /// Takes the displacement of the simulated damper (m) and the readings of the rig at the end of a tick; returns the
    /// next command and the force for the vehicle.
    pub fn tick(&mut self, displacement_m: f64, measured: Option<Measured>) -> CoupledTick {
        let displacement_m = displacement_m as f32;
        if !self.was_placed {
            self.filter.rest_at(displacement_m);
            self.was_placed = true;
        }
        let desired = ahead(&self.filter.push(displacement_m), self.lead_s);
        CoupledTick {
            desired_m: desired.displacement_m,
            command: self.transfer.tick(&desired, measured),
        }
    }

    /// The transfer system.
    pub fn transfer(&mut self) -> &mut TransferSystem<AnyCompensator> {
        &mut self.transfer
    }
}

/// The motion `lead_s` later, with constant jerk.
fn ahead(motion: &Motion, lead_s: f32) -> Motion {
    let h = lead_s;
    Motion {
        displacement_m: motion.series([1.0, h, 0.5 * h * h, h * h * h / 6.0]),
        velocity_m_per_s: motion.series([0.0, 1.0, h, 0.5 * h * h]),
        acceleration_m_per_s2: motion.series([0.0, 0.0, 1.0, h]),
        jerk_m_per_s3: motion.jerk_m_per_s3,
    }
}
