//! A compensator of any kind, as the settings say.

use dashpot_core::BuildError;
use dashpot_core::hybrid::{
    AdaptiveTimeSeries, Compensator, InverseModel, Motion, PolynomialExtrapolation, TransferSystem,
    Uncompensated,
};

use super::settings;
use super::types::{
    DASHPOT_COMPENSATOR_ADAPTIVE, DASHPOT_COMPENSATOR_INVERSE, DASHPOT_COMPENSATOR_NONE,
    DASHPOT_COMPENSATOR_POLYNOMIAL, DashpotTransferSettings,
};

/// A compensator of one of the kinds.
#[allow(clippy::large_enum_variant)] // the caller's storage is as large as the largest kind
pub(super) enum AnyCompensator {
    Uncompensated(Uncompensated),
    Polynomial(PolynomialExtrapolation),
    Inverse(InverseModel),
    Adaptive(AdaptiveTimeSeries),
}

impl AnyCompensator {
    /// Coefficients of displacement to jerk, and whether they stay.
    pub(super) fn coefficients(&self) -> ([f32; 4], bool) {
        match self {
            Self::Uncompensated(_) | Self::Polynomial(_) => ([1.0, 0.0, 0.0, 0.0], true),
            Self::Inverse(inverse) => (inverse.coefficients(), true),
            Self::Adaptive(adaptive) => (adaptive.coefficients(), adaptive.is_frozen()),
        }
    }
}

impl Compensator for AnyCompensator {
    fn command_m(&mut self, desired: &Motion) -> f32 {
        match self {
            Self::Uncompensated(none) => none.command_m(desired),
            Self::Polynomial(polynomial) => polynomial.command_m(desired),
            Self::Inverse(inverse) => inverse.command_m(desired),
            Self::Adaptive(adaptive) => adaptive.command_m(desired),
        }
    }

    fn observe(&mut self, sent_m: f32, measured_m: f32) {
        match self {
            Self::Uncompensated(none) => none.observe(sent_m, measured_m),
            Self::Polynomial(polynomial) => polynomial.observe(sent_m, measured_m),
            Self::Inverse(inverse) => inverse.observe(sent_m, measured_m),
            Self::Adaptive(adaptive) => adaptive.observe(sent_m, measured_m),
        }
    }

    fn rest_at(&mut self, displacement_m: f32) {
        match self {
            Self::Uncompensated(none) => none.rest_at(displacement_m),
            Self::Polynomial(polynomial) => polynomial.rest_at(displacement_m),
            Self::Inverse(inverse) => inverse.rest_at(displacement_m),
            Self::Adaptive(adaptive) => adaptive.rest_at(displacement_m),
        }
    }
}

/// Why a setting is refused. The value itself is a `f64` in the core, which a processor for single precision must not
/// compute.
pub(super) struct Refused {
    pub(super) section: &'static str,
    pub(super) field: &'static str,
    pub(super) allowed: &'static str,
}

impl From<BuildError> for Refused {
    fn from(error: BuildError) -> Self {
        Self {
            section: error.section,
            field: error.field,
            allowed: error.allowed,
        }
    }
}

/// Builds the system of the settings.
///
/// # Errors
/// A setting is outside its range.
pub(super) fn build(
    given: &DashpotTransferSettings,
    step_s: f32,
) -> Result<TransferSystem<AnyCompensator>, Refused> {
    let compensator = match given.compensator {
        DASHPOT_COMPENSATOR_NONE => AnyCompensator::Uncompensated(Uncompensated),
        DASHPOT_COMPENSATOR_POLYNOMIAL => {
            // An order that does not fit is outside the range as well.
            let order = u8::try_from(given.polynomial_order).unwrap_or(u8::MAX);
            let delay_s = given.polynomial_delay_s;
            AnyCompensator::Polynomial(PolynomialExtrapolation::new(order, delay_s, step_s)?)
        }
        DASHPOT_COMPENSATOR_INVERSE => {
            AnyCompensator::Inverse(InverseModel::new(given.coefficients)?)
        }
        DASHPOT_COMPENSATOR_ADAPTIVE => {
            AnyCompensator::Adaptive(AdaptiveTimeSeries::new(&settings::adaptive(given), step_s)?)
        }
        _ => {
            let allowed = "DASHPOT_COMPENSATOR_NONE to DASHPOT_COMPENSATOR_ADAPTIVE";
            return Err(BuildError::new("settings", "compensator", 0.0, allowed).into());
        }
    };
    let others = settings::others(given)?;
    Ok(TransferSystem::new(compensator, &others, step_s)?)
}
