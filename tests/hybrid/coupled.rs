//! A vehicle one of whose dampers is on a virtual rig.

use dashpot_core::hybrid::{
    Command, EnergySettings, GuardSettings, HybridStatus, Measured, TransferSettings,
};
use dashpot_files::actuator::ActuatorParameters;
use dashpot_files::case::Case;
use dashpot_hybrid::rig::VirtualRig;
use dashpot_hybrid::{Compensation, Coupling, Specimen};
use dashpot_study::verification::{Effect, InsideComparison};
use dashpot_vehicle_run::{Run, outside_index};

/// A run of the vehicle with its rig.
pub struct Coupled {
    pub run: Run,
    pub coupling: Coupling,
    pub rig: VirtualRig,
    pub measured: Option<Measured>,
    damper: usize,
    beside: InsideComparison,
    case: Case,
}

/// Guard and energy alarm for an actuator.
pub fn settings(actuator: &ActuatorParameters) -> TransferSettings {
    let limits = actuator.limits;
    TransferSettings {
        guard: GuardSettings::new(
            limits.stroke_m as f32,
            limits.velocity_m_per_s as f32,
            limits.force_n as f32,
        ),
        energy: EnergySettings::default(),
        tracking_window_s: 1.0,
        tracking_error: 0.3,
    }
}

/// Settings under which only the stroke and the rate of the command are limited.
pub fn unguarded(actuator: &ActuatorParameters) -> TransferSettings {
    let mut settings = settings(actuator);
    (settings.guard.error_m, settings.guard.error_s) = (1.0, 10.0);
    settings.guard.limited_s = 10.0;
    settings.tracking_error = 100.0;
    (settings.energy.largest_share, settings.energy.least_power_w) = (100.0, 1e6);
    settings
}

impl Coupled {
    pub fn new(
        case: &Case,
        name: &str,
        actuator: &ActuatorParameters,
        compensation: Compensation,
        settings: &TransferSettings,
    ) -> Self {
        let damper = outside_index(case, name, &[]).unwrap();
        let mut run = Run::new(case).unwrap();
        let beside = InsideComparison::new(&run, case, vec![damper]);
        run.state_mut()
            .set_outside_force_n(damper, Some(0.0))
            .unwrap();
        let parameters = case.damper(name).unwrap().clone().check().unwrap();
        let specimen = Specimen::at_velocity(&parameters, 1e-3);
        let compensator = compensation
            .build(actuator, &specimen, case.step_s)
            .unwrap();
        let mut rig = VirtualRig::new(actuator, &parameters, case.step_s, 1).unwrap();
        Self {
            run,
            coupling: Coupling::new(compensator, settings, case.step_s).unwrap(),
            measured: rig.tick(0.0),
            rig,
            damper,
            beside,
            case: case.clone(),
        }
    }

    /// Makes a tick; returns the command, or `None` after the end of the run.
    pub fn tick(&mut self) -> Option<Command> {
        if self.run.is_over() || self.run.step().unwrap().is_some() {
            return None;
        }
        self.beside.add(self.run.state());
        let displacement_m = self.run.state().damper_displacements_m()[self.damper];
        let command = self.coupling.tick(displacement_m, self.measured).command;
        let force_n = Some(f64::from(command.force_n));
        let state = self.run.state_mut();
        state.set_outside_force_n(self.damper, force_n).unwrap();
        self.measured = self.rig.tick(f64::from(command.command_m));
        Some(command)
    }

    /// Runs to the end; returns the difference from the same run with the damper inside, and the status.
    pub fn finish(mut self) -> (Effect, HybridStatus) {
        let mut status = HybridStatus::empty();
        while let Some(command) = self.tick() {
            status = command.status;
        }
        let (effect, _) = self.beside.compare(&self.case).unwrap().unwrap();
        (effect, status)
    }
}
