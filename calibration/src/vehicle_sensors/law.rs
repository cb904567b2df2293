//! Forces between body and bogie over their displacement.

use dashpot_core::{CheckedParameters, DamperParameters};
use dashpot_testbench::compiled::Compiled;
use nalgebra::Complex;

use super::error::SensorsError;
use super::transform::Spectrum;

/// Rate at which dampers are stepped (Hz).
const DAMPER_RATE_HZ: f64 = 4000.0;

/// A force over the displacement of its ends.
#[derive(Debug, Clone)]
pub(super) enum Force {
    /// Spring (N/m) and dashpot (N s/m) in parallel.
    Linear { stiffness: f64, damping: f64 },
    /// A damper with its mounts and clearance.
    Damper(Box<CheckedParameters>),
    /// No force up to a displacement (m).
    Stop { gap_m: f64 },
}

fn invalid(damper: &str, error: &dyn std::fmt::Display) -> SensorsError {
    SensorsError::Damper {
        damper: damper.to_owned(),
        reason: error.to_string(),
    }
}

impl Force {
    pub fn damper(name: &str, parameters: &DamperParameters) -> Result<Self, SensorsError> {
        let checked = parameters.check().map_err(|error| invalid(name, &error))?;
        Ok(Self::Damper(Box::new(checked)))
    }

    /// Returns the force (N) over `displacement` (m), both as spectra. `sign` is that of [`super::layout::Connection`].
    pub fn over(
        &self,
        name: &str,
        displacement: &Spectrum,
        sign: f64,
    ) -> Result<Spectrum, SensorsError> {
        let parameters = match self {
            Self::Linear { stiffness, damping } => {
                return Ok(displacement.times(|w| Complex::new(*stiffness, w * damping)));
            }
            Self::Stop { .. } => return Ok(displacement.times(|_| Complex::ZERO)),
            Self::Damper(parameters) => parameters,
        };
        let (step_s, motion_m) = displacement.signal(DAMPER_RATE_HZ);
        let damper =
            f64::compiled_build(parameters, step_s).map_err(|error| invalid(name, &error))?;
        let mut state = damper.at_rest(sign * motion_m.first().unwrap_or(&0.0));
        let force_n = motion_m
            .iter()
            .map(|x_m| sign * f64::compiled_step(&damper, &mut state, sign * x_m));
        Ok(displacement.of_signal(force_n.collect()))
    }
}
