//! The compensators of the core for an actuator that is known.

use dashpot_core::BuildError;
use dashpot_core::hybrid::{
    AdaptiveSettings, AdaptiveTimeSeries, Compensator, InverseModel, Motion,
    PolynomialExtrapolation, Uncompensated,
};
use dashpot_files::actuator::ActuatorParameters;

use crate::actuator::inverse_series;
use crate::specimen::Specimen;

/// Kind of compensation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compensation {
    /// The desired displacement is the command.
    None,
    /// Extrapolation by a polynomial of third order over the delay at low frequency.
    Polynomial,
    /// The inverse of the actuator.
    Inverse,
    /// The adaptive time series, which starts from that inverse.
    Adaptive,
}

/// Highest frequency at which the inverse is fitted (Hz): that of the motion of bogies, with a margin.
const HIGHEST_HZ: f64 = 12.0;

/// Largest error of the delay that the adaptive time series corrects (s).
const DELAY_ERROR_S: f32 = 0.01;

impl Compensation {
    /// Builds the compensator for an actuator with a specimen, for ticks of `step_s`.
    ///
    /// # Errors
    /// The step, or the delay of the actuator in ticks, is outside the range of the compensator.
    pub fn build(
        self,
        actuator: &ActuatorParameters,
        specimen: &Specimen,
        step_s: f64,
    ) -> Result<AnyCompensator, BuildError> {
        let series = Self::series(actuator, specimen, step_s).map(|a| a as f32);
        Ok(match self {
            Self::None => AnyCompensator::None(Uncompensated),
            Self::Polynomial => AnyCompensator::Polynomial(Box::new(PolynomialExtrapolation::new(
                3,
                series[1] / series[0],
                step_s as f32,
            )?)),
            Self::Inverse => AnyCompensator::Inverse(InverseModel::new(series)?),
            Self::Adaptive => {
                let settings = AdaptiveSettings::new(series, DELAY_ERROR_S);
                AnyCompensator::Adaptive(Box::new(AdaptiveTimeSeries::new(
                    &settings,
                    step_s as f32,
                )?))
            }
        })
    }

    /// Coefficients of the inverse of the actuator.
    pub fn series(actuator: &ActuatorParameters, specimen: &Specimen, step_s: f64) -> [f64; 4] {
        inverse_series(
            actuator,
            |s| specimen.dynamic_stiffness(s),
            HIGHEST_HZ,
            step_s,
        )
    }
}

/// One of the compensators of the core.
#[derive(Clone, Debug)]
pub enum AnyCompensator {
    /// None.
    None(Uncompensated),
    /// Extrapolation.
    Polynomial(Box<PolynomialExtrapolation>),
    /// Inverse model.
    Inverse(InverseModel),
    /// Adaptive time series.
    Adaptive(Box<AdaptiveTimeSeries>),
}

impl AnyCompensator {
    fn inner(&mut self) -> &mut dyn Compensator {
        match self {
            Self::None(inner) => inner,
            Self::Polynomial(inner) => inner.as_mut(),
            Self::Inverse(inner) => inner,
            Self::Adaptive(inner) => inner.as_mut(),
        }
    }
}

impl Compensator for AnyCompensator {
    fn command_m(&mut self, desired: &Motion) -> f32 {
        self.inner().command_m(desired)
    }

    fn observe(&mut self, sent_m: f32, measured_m: f32) {
        self.inner().observe(sent_m, measured_m);
    }

    fn rest_at(&mut self, displacement_m: f32) {
        self.inner().rest_at(displacement_m);
    }
}
