//! A compensator of any kind.

use dashpot_core::hybrid::{
    AdaptiveTimeSeries, Compensator, InverseModel, Motion, PolynomialExtrapolation, Uncompensated,
};

/// A compensator of one of the kinds.
#[allow(clippy::large_enum_variant)] // a program has one or two of them
#[derive(Clone)]
pub enum AnyCompensator {
    Uncompensated(Uncompensated),
    Polynomial(PolynomialExtrapolation),
    Inverse(InverseModel),
    Adaptive(AdaptiveTimeSeries),
}

impl AnyCompensator {
    /// The keyword of its kind.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Uncompensated(_) => "none",
            Self::Polynomial(_) => "polynomial",
            Self::Inverse(_) => "inverse",
            Self::Adaptive(_) => "adaptive",
        }
    }

    /// Coefficients of displacement to jerk, if it has any.
    pub fn coefficients(&self) -> Option<[f32; 4]> {
        match self {
            Self::Uncompensated(_) | Self::Polynomial(_) => None,
            Self::Inverse(inverse) => Some(inverse.coefficients()),
            Self::Adaptive(adaptive) => Some(adaptive.coefficients()),
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
