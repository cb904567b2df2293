//! Health of each damper, estimated while the vehicle runs as a rig or a train would do it.

use dashpot_core::health::{Estimate, Health, HealthModel, HealthSettings, HealthStatus};
use dashpot_vehicle_run::VehicleTick;
use serde::Serialize;

use crate::ActionError;
use crate::desk::Desk;

/// Noise of the sensors that the estimator expects: displacement (m) and force (N).
const NOISE: (f64, f64) = (20e-6, 30.0);

/// Standard deviations on each side of a value: 95 % of a normal distribution.
const SIDES: f64 = 2.0;

/// Estimators of all dampers.
#[derive(Debug, Clone)]
pub(crate) struct HealthWatch {
    dampers: Vec<Watched>,
}

#[derive(Debug, Clone)]
struct Watched {
    name: String,
    model: HealthModel,
    health: Health,
}

/// An estimate as a page shows it, with the bounds that contain the value 95 times in 100.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HealthLine {
    damper: String,
    label: &'static str,
    value: f64,
    low: f64,
    high: f64,
    unit: &'static str,
    alarm: bool,
    trusted: bool,
}

impl HealthWatch {
    /// Estimators that know the dampers as new. A step for which there is no estimator has none.
    pub fn new(desk: &Desk) -> Result<Self, ActionError> {
        let step_s = desk.case().step_s;
        let settings = HealthSettings::new(NOISE.0, NOISE.1);
        let mut dampers = Vec::with_capacity(desk.dampers().len());
        for damper in desk.dampers() {
            if let Ok(model) = damper.parameters_as_new()?.health_model(&settings, step_s) {
                dampers.push(Watched {
                    name: damper.name().to_owned(),
                    health: Health::new(&model),
                    model,
                });
            }
        }
        Ok(Self { dampers })
    }

    /// Takes a tick. Does not allocate.
    pub fn add(&mut self, tick: &impl VehicleTick) {
        let ticks = tick
            .damper_displacements_m()
            .iter()
            .zip(tick.damper_forces_n());
        for (damper, (displacement_m, force_n)) in self.dampers.iter_mut().zip(ticks) {
            damper
                .health
                .tick(&damper.model, *displacement_m as f32, *force_n as f32);
        }
    }

    /// Present estimates: clearance, stiffness and damping of each damper.
    pub fn lines(&self) -> Vec<HealthLine> {
        let of_damper = |damper: &Watched| {
            let reading = damper.health.reading(&damper.model);
            let line = |label, estimate: Estimate, unit, alarm| {
                let (value, sd) = (f64::from(estimate.value), f64::from(estimate.sd));
                HealthLine {
                    damper: damper.name.clone(),
                    label,
                    value,
                    low: value - SIDES * sd,
                    high: value + SIDES * sd,
                    unit,
                    alarm: reading.status.intersects(alarm),
                    trusted: reading.is_trusted(),
                }
            };
            [
                line(
                    "clearance",
                    reading.clearance_m,
                    "m",
                    // Without a force the clearance is wider than the motion, or the damper is gone.
                    HealthStatus::CLEARANCE | HealthStatus::NO_FORCE,
                ),
                line(
                    "stiffness",
                    reading.stiffness_n_per_m,
                    "N/m",
                    HealthStatus::STIFFNESS,
                ),
                line(
                    "damping as new = 1",
                    reading.damping_factor(),
                    "1",
                    HealthStatus::FLOW,
                ),
            ]
        };
        self.dampers.iter().flat_map(of_damper).collect()
    }
}
