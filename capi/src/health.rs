//! Functions of the health estimator.

use dashpot_core::health::{
    Baseline, Estimate, Health, HealthImageError, HealthLimits, HealthModel,
};

use crate::error::DashpotError;
use crate::pointer::{Memory, bytes, check, exclusive, shared};
use crate::types::{
    DashpotEstimate, DashpotHealth, DashpotHealthBaseline, DashpotHealthLimits, DashpotHealthModel,
    DashpotHealthReading,
};

impl From<HealthImageError> for DashpotError {
    fn from(error: HealthImageError) -> Self {
        match error {
            HealthImageError::Length { .. } => Self::Length,
            HealthImageError::Magic => Self::Magic,
            HealthImageError::Version(_) => Self::Version,
            HealthImageError::Checksum => Self::Checksum,
            _ => Self::Values,
        }
    }
}

impl From<Estimate> for DashpotEstimate {
    fn from(Estimate { value, sd }: Estimate) -> Self {
        Self { value, sd }
    }
}

/// Returns an initialised model.
///
/// # Safety
/// The caller must keep the contract in the documentation of this crate.
unsafe fn made_model<'a>(
    model: *const DashpotHealthModel,
) -> Result<&'a HealthModel, DashpotError> {
    // SAFETY: the caller keeps the contract; the storage has the layout of `HealthModel`, for which any bytes are
    // valid.
    let model: &HealthModel = unsafe { shared(model.cast()) }?;
    if model.is_marked() {
        Ok(model)
    } else {
        Err(DashpotError::NoHealth)
    }
}

/// Returns an initialised estimate for reading.
///
/// # Safety
/// The caller must keep the contract in the documentation of this crate.
unsafe fn made_health<'a>(health: *const DashpotHealth) -> Result<&'a Health, DashpotError> {
    // SAFETY: the caller keeps the contract; the storage has the layout of `Health`, for which any bytes are valid.
    let health: &Health = unsafe { shared(health.cast()) }?;
    if health.is_marked() {
        Ok(health)
    } else {
        Err(DashpotError::NoHealth)
    }
}

/// Initialises the constants of an estimator from an image, the bytes from `dashpot export --health --lang c` or
/// `HealthModel::to_image` of dashpot-core.
///
/// Do not call it within a tick. It needs as much stack as the size of the model.
///
/// @param model   storage with any content; written
/// @param image   the bytes, at any alignment, outside the storage of the model
/// @param length  number of bytes, `DASHPOT_HEALTH_IMAGE_SIZE`
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_health_model_init(
    model: *mut DashpotHealthModel,
    image: *const u8,
    length: usize,
) -> DashpotError {
    let done = || {
        check(model)?;
        // SAFETY: the caller keeps the contract.
        let image = unsafe { bytes(image, length) }?;
        Memory::of(model).check_apart(Memory::of_bytes(image))?;
        let made = HealthModel::from_image(image)?;
        // SAFETY: the pointer is checked, and the caller keeps the contract; the storage has the layout of
        // `HealthModel`.
        unsafe { model.cast::<HealthModel>().write(made) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Sets the baseline of the alarms: the results of `dashpot_health_read` for the healthy damper.
///
/// @param model     initialised by `dashpot_health_model_init`; no tick may use it during the call
/// @param baseline  finite numbers; flow factor and compliance are positive, standard deviations not negative
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_health_set_baseline(
    model: *mut DashpotHealthModel,
    baseline: *const DashpotHealthBaseline,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract; the reference ends with this statement.
        unsafe { made_model(model) }?;
        // SAFETY: the caller keeps the contract.
        let given = *unsafe { shared(baseline) }?;
        Memory::of(model).check_apart(Memory::of(baseline))?;
        // SAFETY: the caller keeps the contract; the storage has the layout of `HealthModel`.
        let model: &mut HealthModel = unsafe { exclusive(model.cast()) }?;
        let mut baseline = Baseline::new(
            given.flow_factor.value,
            given.compliance_m_per_n.value,
            given.clearance_m.value,
        );
        baseline.flow_factor_sd = given.flow_factor.sd;
        baseline.compliance_sd_m_per_n = given.compliance_m_per_n.sd;
        baseline.clearance_sd_m = given.clearance_m.sd;
        model
            .set_baseline(baseline)
            .map_err(|_| DashpotError::Range)
    };
    DashpotError::from(done())
}

/// Sets the alarm limits. Latched alarms remain.
///
/// @param model   initialised by `dashpot_health_model_init`; no tick may use it during the call
/// @param limits  any numbers; an infinite or NaN limit disables its alarm
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_health_set_limits(
    model: *mut DashpotHealthModel,
    limits: *const DashpotHealthLimits,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract; the reference ends with this statement.
        unsafe { made_model(model) }?;
        // SAFETY: the caller keeps the contract.
        let given = *unsafe { shared(limits) }?;
        Memory::of(model).check_apart(Memory::of(limits))?;
        // SAFETY: the caller keeps the contract; the storage has the layout of `HealthModel`.
        let model: &mut HealthModel = unsafe { exclusive(model.cast()) }?;
        let mut limits = HealthLimits::default();
        limits.flow_factor = given.flow_factor;
        limits.compliance = given.compliance;
        limits.clearance_m = given.clearance_m;
        limits.deviations = given.deviations;
        model.set_limits(limits);
        Ok(())
    };
    DashpotError::from(done())
}

/// Initialises an estimate.
///
/// @param health  storage with any content; written
/// @param model   initialised by `dashpot_health_model_init`
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_health_init(
    health: *mut DashpotHealth,
    model: *const DashpotHealthModel,
) -> DashpotError {
    let done = || {
        check(health)?;
        // SAFETY: the caller keeps the contract.
        let model = unsafe { made_model(model) }?;
        Memory::of(health).check_apart(Memory::of(model))?;
        // SAFETY: the pointer is checked, and the caller keeps the contract; the storage has the layout of `Health`.
        unsafe { health.cast::<Health>().write(Health::new(model)) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Takes the sample of a tick in at most 297 instructions. A sample that is not finite or not credible is not an error:
/// it is left out, latched in the status and counted.
///
/// @param model           initialised by `dashpot_health_model_init`
/// @param health          initialised by `dashpot_health_init`, changed
/// @param displacement_m  measured displacement (m), positive in extension
/// @param force_n         measured force (N), positive when it resists extension
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_health_tick(
    model: *const DashpotHealthModel,
    health: *mut DashpotHealth,
    displacement_m: f32,
    force_n: f32,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract; the second reference ends with this statement.
        let model = unsafe { (made_model(model)?, made_health(health)?).0 };
        Memory::of(health).check_apart(Memory::of(model))?;
        // SAFETY: the caller keeps the contract; the storage has the layout of `Health`.
        let health: &mut Health = unsafe { exclusive(health.cast()) }?;
        health.tick(model, displacement_m, force_n);
        Ok(())
    };
    DashpotError::from(done())
}

/// Reads the estimates with their standard deviations. It needs square roots and divisions, so do not call it in every
/// tick.
///
/// @param model    initialised by `dashpot_health_model_init`
/// @param health   initialised by `dashpot_health_init`
/// @param reading  written
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_health_read(
    model: *const DashpotHealthModel,
    health: *const DashpotHealth,
    reading: *mut DashpotHealthReading,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract.
        let (model, health) = unsafe { (made_model(model)?, made_health(health)?) };
        check(reading)?;
        Memory::of(reading).check_apart(Memory::of(model))?;
        Memory::of(reading).check_apart(Memory::of(health))?;
        let read = health.reading(model);
        let read = DashpotHealthReading {
            flow_factor: read.flow_factor.into(),
            stiffness_n_per_m: read.stiffness_n_per_m.into(),
            clearance_m: read.clearance_m.into(),
            lag_s: read.lag_s.into(),
            compliance_m_per_n: read.compliance_m_per_n.into(),
            samples: read.samples,
            rejected: read.rejected,
            status: read.status.bits(),
            force_zero_n: read.force_zero_n.into(),
            added_friction_n: read.added_friction_n.into(),
        };
        // SAFETY: the pointer is checked, and the caller keeps the contract.
        unsafe { reading.write(read) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Clears the status bits and the count of rejected samples. Alarms return if their cause remains.
///
/// @param health  initialised by `dashpot_health_init`, changed
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_health_clear_status(health: *mut DashpotHealth) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract; the reference ends with this statement.
        unsafe { made_health(health) }?;
        // SAFETY: the caller keeps the contract; the storage has the layout of `Health`.
        let health: &mut Health = unsafe { exclusive(health.cast()) }?;
        health.clear_status();
        Ok(())
    };
    DashpotError::from(done())
}
