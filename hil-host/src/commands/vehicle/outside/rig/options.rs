//! Options of rigs whose actuator moves an external damper.

use dashpot_core::hybrid::{EnergySettings, GuardSettings, TransferSettings};
use dashpot_files::actuator::{ActuatorLimits, ActuatorParameters};
use dashpot_files::case::Case;
use dashpot_hybrid::Compensation;

use crate::commands::failure::{Failure, Outcome};
use crate::commands::margin::LinearVehicle;
use crate::commands::print::print_note;

/// Compensation of the actuator's delay.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(in crate::commands) enum Compensate {
    /// No compensation.
    None,
    /// Extrapolation by a polynomial of third order.
    Polynomial,
    /// Inverse model of the actuator.
    Inverse,
    /// Adaptive time series.
    Ats,
}

impl From<Compensate> for Compensation {
    fn from(chosen: Compensate) -> Self {
        match chosen {
            Compensate::None => Self::None,
            Compensate::Polynomial => Self::Polynomial,
            Compensate::Inverse => Self::Inverse,
            Compensate::Ats => Self::Adaptive,
        }
    }
}

/// The actuator between the vehicle and an external damper.
#[derive(Debug, Clone, clap::Args)]
pub(in crate::commands::vehicle) struct RigArguments {
    /// Actuator that moves the external dampers: built-in name (servo, second-order, slow, benchmark) or TOML file.
    /// Dampers on `desk` are then mounted on a virtual rig.
    #[arg(long, requires = "choices", value_name = "ACTUATOR")]
    actuator: Option<String>,
    /// Compensation of the delay of the actuator.
    #[arg(long, value_enum, default_value_t = Compensate::Ats, requires = "actuator")]
    compensate: Compensate,
    /// Go on when the actuator adds energy or follows badly, and beyond the limits of force and velocity. The stroke,
    /// the rate of the command and the age of readings stay limited. For virtual rigs in this process only.
    #[arg(long, requires = "actuator")]
    without_guard: bool,
    /// Start although the plan leaves no margin; see `dashpot hybrid plan`.
    #[arg(long, requires = "actuator")]
    without_margin: bool,
    /// Seed of the noise of virtual rigs.
    #[arg(long, default_value_t = 1, requires = "actuator", value_name = "SEED")]
    rig_seed: u64,
}

/// An actuator and how it is driven.
#[derive(Debug, Clone)]
pub(in crate::commands::vehicle) struct RigOptions {
    pub(super) actuator: ActuatorParameters,
    pub(super) compensate: Compensate,
    pub(in crate::commands::vehicle) without_guard: bool,
    without_margin: bool,
    pub(super) seed: u64,
}

impl RigArguments {
    /// Reads the file of the actuator; `None` without `--actuator`.
    ///
    /// # Errors
    /// The actuator does not exist, or its file cannot be used.
    pub(in crate::commands::vehicle) fn read(&self) -> Outcome<Option<RigOptions>> {
        let Some(name) = &self.actuator else {
            return Ok(None);
        };
        Ok(Some(RigOptions {
            actuator: ActuatorParameters::load(name)?,
            compensate: self.compensate,
            without_guard: self.without_guard,
            without_margin: self.without_margin,
            seed: self.rig_seed,
        }))
    }
}

impl RigOptions {
    /// Checks that the loop with each damper is stable and bears a further delay of one tick.
    ///
    /// # Errors
    /// A damper has no margin, and `--without-margin` is not given.
    pub(in crate::commands::vehicle) fn check_margin(
        &self,
        case: &Case,
        dampers: &[usize],
    ) -> Outcome<()> {
        if self.without_margin {
            return Ok(());
        }
        if dampers.len() > 1 {
            print_note(
                "note: the margin is that of one rig at a time; several rigs together bear less",
            );
        }
        let vehicle = LinearVehicle::new(case)?;
        for (damper, element) in case.vehicle.dampers().enumerate() {
            if !dampers.contains(&damper) {
                continue;
            }
            let margin = vehicle.margin(damper, &self.actuator, self.compensate.into());
            if !margin.bears(case.step_s) {
                return Err(Failure::new(format!(
                    "{} on {}: no margin ({}); see `dashpot hybrid plan`, or start all the same with \
                     --without-margin",
                    element.name,
                    self.actuator.name,
                    margin.text()
                )));
            }
        }
        Ok(())
    }
}

/// Time after which past motion counts 1/e in the tracking, s.
const TRACKING_WINDOW_S: f32 = 1.0;

/// Error of the tracking relative to the desired motion that ends a test.
const TRACKING_ERROR: f32 = 0.3;

/// Guard, energy alarm and tracking for an actuator.
pub(in crate::commands) fn transfer_settings(
    limits: &ActuatorLimits,
    without_guard: bool,
) -> TransferSettings {
    let mut guard = GuardSettings::new(
        limits.stroke_m as f32,
        limits.velocity_m_per_s as f32,
        limits.force_n as f32,
    );
    let mut energy = EnergySettings::default();
    if without_guard {
        // The widest limits that the guard takes. The stroke and the rate of the command stay limited.
        guard.force_n = 1e7;
        guard.least_force_n = 0.0;
        guard.stuck_travel_m = 1.0;
        (guard.error_m, guard.error_s, guard.limited_s) = (1.0, 10.0, 10.0);
        (guard.plausible_m_per_s, guard.plausible_n_per_s) = (1e3, 1e12);
        (energy.largest_share, energy.least_power_w) = (100.0, 1e6);
    }
    TransferSettings {
        guard,
        energy,
        tracking_window_s: TRACKING_WINDOW_S,
        tracking_error: if without_guard { 100.0 } else { TRACKING_ERROR },
    }
}
