//! The transfer system.

use dashpot_core::hybrid::{
    EnergySettings, GuardAction, GuardSettings, HybridStatus, Measured, Motion, TransferSettings,
};
use pyo3::prelude::*;

use super::Class;
use super::any::AnyCompensator;
use super::compensator::Given;
use crate::error::{Outcome, refuse};

static COMMAND: Class = super::class("Command");
static STATUS: Class = super::class("HybridStatus");
static TRACKING: Class = super::class("TrackingReading");
static ENERGY: Class = super::class("EnergyReading");

/// All that stands between a simulated vehicle and an actuator: compensator, tracking, energy and guard, in single
/// precision with the bits of the target.
///
/// `stroke_m`, `velocity_m_per_s` and `force_n` are the limits of the test. `compensator` is `"none"`, `"polynomial"`
/// (with `delay_s` and `order`, 1 to 3), `"inverse"` (with `delay_s` or `coefficients`, 1 to s^3) or `"adaptive"` (the
/// same and `delay_error_s`, the largest error of the delay; also `largest_change`, `noise_m`, `least_motion_m`,
/// `pole_hz`, `memory_s` and `change_s`). The settings of the guard and those that start with `energy_` have the names,
/// ranges and defaults of `GuardSettings` and `EnergySettings` in Rust. `action` is how a test ends: `"hold"`, or
/// `"zero_force"` with `stiffness_n_per_m` of the specimen.
///
/// >>> import dashpot
/// >>> system = dashpot.TransferSystem(
/// ...     stroke_m=0.1, velocity_m_per_s=1.0, force_n=20e3, compensator="adaptive", delay_s=0.01, delay_error_s=0.005)
/// >>> command = system.tick(dashpot.Motion(0.01, velocity_m_per_s=0.1), measured=dashpot.Measured(0.0, 0.0))
/// >>> round(command.command_m, 9), command.status
/// (5e-05, <HybridStatus: 0>)
/// >>> system.phase
/// 'approaching'
#[pyclass(module = "dashpot")]
#[derive(Clone)]
pub struct TransferSystem {
    system: dashpot_core::hybrid::TransferSystem<AnyCompensator>,
    step_s: f32,
}

/// Replaces settings by the keywords that were given.
macro_rules! replace {
    ($settings:ident: $($name:ident $(= $field:ident)?),*) => {
        $(if let Some(value) = $name {
            replace!(@ $settings $name $($field)?) = value;
        })*
    };
    (@ $settings:ident $name:ident) => { $settings.$name };
    (@ $settings:ident $name:ident $field:ident) => { $settings.$field };
}

#[pymethods]
impl TransferSystem {
    #[new]
    #[allow(clippy::too_many_arguments)] // keywords in Python
    #[pyo3(signature = (
        *, stroke_m, velocity_m_per_s, force_n, step_s=1e-3, compensator="none", delay_s=None, delay_error_s=None,
        coefficients=None, order=None, largest_change=None, noise_m=None, least_motion_m=None, pole_hz=None,
        memory_s=None, change_s=None, limited_s=None, error_m=None, error_s=None, age_s=None, plausible_m_per_s=None,
        plausible_n_per_s=None, stuck_travel_m=None, least_force_n=None, without_force_m=None, ramp_s=None,
        approach_m_per_s=None, action="hold", stiffness_n_per_m=None, energy_window_s=None, energy_largest_share=None,
        energy_least_power_w=None, energy_pole_hz=None, tracking_window_s=1.0, tracking_error=0.3
    ))]
    fn new(
        stroke_m: f32,
        velocity_m_per_s: f32,
        force_n: f32,
        step_s: f32,
        compensator: &str,
        delay_s: Option<f32>,
        delay_error_s: Option<f32>,
        coefficients: Option<[f32; 4]>,
        order: Option<i64>,
        largest_change: Option<[f32; 4]>,
        noise_m: Option<f32>,
        least_motion_m: Option<f32>,
        pole_hz: Option<f32>,
        memory_s: Option<f32>,
        change_s: Option<f32>,
        limited_s: Option<f32>,
        error_m: Option<f32>,
        error_s: Option<f32>,
        age_s: Option<f32>,
        plausible_m_per_s: Option<f32>,
        plausible_n_per_s: Option<f32>,
        stuck_travel_m: Option<f32>,
        least_force_n: Option<f32>,
        without_force_m: Option<f32>,
        ramp_s: Option<f32>,
        approach_m_per_s: Option<f32>,
        action: &str,
        stiffness_n_per_m: Option<f32>,
        energy_window_s: Option<f32>,
        energy_largest_share: Option<f32>,
        energy_least_power_w: Option<f32>,
        energy_pole_hz: Option<f32>,
        tracking_window_s: f32,
        tracking_error: f32,
    ) -> Outcome<Self> {
        let given = Given {
            delay_s,
            delay_error_s,
            coefficients,
            order,
            largest_change,
            noise_m,
            least_motion_m,
            pole_hz,
            memory_s,
            change_s,
        };
        let mut guard = GuardSettings::new(stroke_m, velocity_m_per_s, force_n);
        replace!(guard: limited_s, error_m, error_s, age_s, plausible_m_per_s, plausible_n_per_s, stuck_travel_m,
            least_force_n, without_force_m, ramp_s, approach_m_per_s, stiffness_n_per_m);
        guard.action = match action {
            "hold" => GuardAction::Hold,
            "zero_force" => GuardAction::ZeroForce,
            _ => return refuse(format!("action: {action}, allowed: hold or zero_force")),
        };
        let mut energy = EnergySettings::default();
        replace!(energy: energy_window_s = window_s, energy_largest_share = largest_share,
            energy_least_power_w = least_power_w, energy_pole_hz = pole_hz);
        let settings = TransferSettings {
            guard,
            energy,
            tracking_window_s,
            tracking_error,
        };
        let compensator = given.build(compensator, step_s)?;
        let system = dashpot_core::hybrid::TransferSystem::new(compensator, &settings, step_s)?;
        Ok(Self { system, step_s })
    }

    /// Takes the desired motion and the measured values of this tick, or `None` if none came; returns a
    /// `dashpot.Command`. It never fails because of a value: the status reports what was wrong.
    ///
    /// `desired` is a `dashpot.Motion` or four numbers: displacement (m), velocity (m/s), acceleration (m/s^2) and jerk
    /// (m/s^3). `measured` is a `dashpot.Measured` or two numbers: displacement (m) and force (N).
    ///
    /// >>> import dashpot
    /// >>> system = dashpot.TransferSystem(stroke_m=0.1, velocity_m_per_s=1.0, force_n=20e3)
    /// >>> system.tick((0.0, 0.0, 0.0, 0.0))
    /// Command(command_m=0.0, force_n=0.0, status=<HybridStatus.MEASUREMENT_MISSED: 2>)
    #[pyo3(signature = (desired, measured=None))]
    fn tick<'py>(
        &mut self,
        py: Python<'py>,
        desired: [f32; 4],
        measured: Option<[f32; 2]>,
    ) -> Outcome<Bound<'py, PyAny>> {
        let [
            displacement_m,
            velocity_m_per_s,
            acceleration_m_per_s2,
            jerk_m_per_s3,
        ] = desired;
        let desired = Motion {
            displacement_m,
            velocity_m_per_s,
            acceleration_m_per_s2,
            jerk_m_per_s3,
        };
        let measured = measured.map(|[displacement_m, force_n]| Measured {
            displacement_m,
            force_n,
        });
        let command = self.system.tick(&desired, measured);
        let status = STATUS.make(py, (command.status.bits(),))?;
        COMMAND.make(py, (command.command_m, command.force_n, status))
    }

    /// Places a system that has not ended a test at the actuator's present displacement (m), from which the command
    /// approaches the desired one.
    fn place(&mut self, displacement_m: f32) -> Outcome<()> {
        if !displacement_m.is_finite() {
            return refuse(format!(
                "displacement_m: {displacement_m}, allowed: finite numbers"
            ));
        }
        self.system.place(displacement_m);
        Ok(())
    }

    /// Ends the test: the command comes to rest, and the status has `HybridStatus.REQUESTED`.
    fn end(&mut self) {
        self.system.guard().end(HybridStatus::REQUESTED);
    }

    /// Clears the status. A test that has come to rest starts again: the command approaches the desired displacement.
    /// While the command is still coming to rest, nothing is cleared and the result is False.
    fn clear(&mut self) -> bool {
        self.system.guard().clear()
    }

    /// Delay, amplitude and errors over the fading past, as a `dashpot.TrackingReading`.
    #[getter]
    fn tracking<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyAny>> {
        let reading = self.system.tracking();
        TRACKING.make(
            py,
            (
                reading.delay_s,
                reading.amplitude,
                reading.relative_error,
                reading.error_m,
            ),
        )
    }

    /// Energy that the actuator adds to the vehicle, as a `dashpot.EnergyReading`.
    #[getter]
    fn energy<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyAny>> {
        let energy = self.system.energy();
        ENERGY.make(py, (energy.added_j(), energy.added_share()))
    }

    /// Status bits since the last `clear`, as a `dashpot.HybridStatus`.
    #[getter]
    fn status<'py>(&mut self, py: Python<'py>) -> Outcome<Bound<'py, PyAny>> {
        STATUS.make(py, (self.system.guard().status().bits(),))
    }

    /// Phase of the test: `"approaching"`, `"running"`, `"ending"` while the command comes to rest, or `"held"`.
    #[getter]
    fn phase(&mut self) -> &'static str {
        let guard = self.system.guard();
        match (guard.is_running(), guard.has_ended(), guard.is_held()) {
            (true, ..) => "running",
            (_, false, _) => "approaching",
            (.., false) => "ending",
            (.., true) => "held",
        }
    }

    /// Kind of the compensator.
    #[getter]
    fn compensator(&self) -> &'static str {
        self.system.compensator().kind()
    }

    /// Present coefficients of an inverse or adaptive compensator, 1 to s^3; `None` for the other kinds.
    #[getter]
    fn coefficients(&self) -> Option<(f32, f32, f32, f32)> {
        self.system.compensator().coefficients().map(Into::into)
    }

    /// Step (s), in single precision.
    #[getter]
    fn step_s(&self) -> f32 {
        self.step_s
    }

    fn __copy__(&self) -> Self {
        self.clone()
    }

    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> Self {
        self.clone()
    }
}
