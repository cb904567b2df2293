//! What each recording says about its damper: a reading at its end, or why there is none.

use std::path::Path;

use dashpot_core::CheckedParameters;
use dashpot_core::health::{HealthModel, HealthReading, HealthSettings, HealthStatus};
use dashpot_core::parameters::Element;

use super::parameter::Parameter;
use super::recordings::Listed;
use crate::health::{Noise, doubts_in_words};
use crate::recorded_health::{NOISE_NEEDS, history, noise};
use dashpot_files::{FileError, damper};
use dashpot_recording::{Channels, Measurement};

/// How recordings are read and estimated.
#[derive(Clone, Debug)]
pub struct Estimation {
    /// Name of the damper's model, for errors.
    pub damper: String,
    /// The damper's model, for recordings that name none.
    pub parameters: CheckedParameters,
    /// Channels of all recordings.
    pub channels: Channels,
    /// Step (s).
    pub step_s: f64,
    /// Settings of the estimator; its noise is used where it is not estimated.
    pub settings: HealthSettings,
    /// True to estimate the displacement noise from each recording.
    pub estimates_displacement_noise: bool,
    /// True to estimate the force noise from each recording.
    pub estimates_force_noise: bool,
    /// True to use readings of which several parameters have changed together.
    pub accepts_several_changed: bool,
}

/// Why a recording is not used.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// The file cannot be read or used.
    Unreadable(String),
    /// The recording has no date, no mileage or too little motion.
    Unusable(String),
    /// The reading cannot be trusted.
    Doubtful(String),
}

/// The reading at the end of a recording.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// The recording.
    pub listed: Listed,
    /// The reading and the model it was compared with; `None` if the recording could not be estimated.
    pub reading: Option<(HealthReading, Box<HealthModel>)>,
    /// Why it is not used; `None` if it is.
    pub refusal: Option<Refusal>,
}

impl Refusal {
    /// Returns the reason, a sentence without a full stop.
    pub fn reason(&self) -> &str {
        match self {
            Self::Unreadable(reason) | Self::Unusable(reason) | Self::Doubtful(reason) => reason,
        }
    }
}

impl Estimation {
    /// Loads the model of a recording; a physical damper has the temperature of the recording.
    ///
    /// # Errors
    /// The damper is invalid; the message names it.
    pub fn parameters(&self, listed: &Listed) -> Result<CheckedParameters, String> {
        let (name, model) = match &listed.model {
            Some(model) => (model, damper::load(model, &[])),
            None => (&self.damper, Ok(self.parameters.clone())),
        };
        let model = model.and_then(|model| match listed.temperature_c {
            Some(temperature_c) if matches!(model.element, Element::Physical(_)) => {
                let warm = [format!("oil.temperature_c={temperature_c}")];
                damper::change(name, &model, &warm)
            }
            _ => Ok(model),
        });
        model.map_err(|error| error.to_string())
    }

    /// Estimates the recordings of one damper, in order.
    ///
    /// The first reading that fits the model is the baseline of the following ones, because no damper is exactly the
    /// nominal one: only what changes from then on is a change.
    pub fn readings(&self, recordings: &[Listed]) -> Vec<Recorded> {
        self.readings_cancellable(recordings, &|| false)
    }

    /// Like [`Self::readings`], up to the recording before which `is_unwanted` returns true.
    pub(super) fn readings_cancellable(
        &self,
        recordings: &[Listed],
        is_unwanted: &dyn Fn() -> bool,
    ) -> Vec<Recorded> {
        let mut baseline = None;
        let mut readings = Vec::new();
        for listed in recordings.iter().take_while(|_| !is_unwanted()) {
            let (reading, refusal) = match self.reading(listed, baseline.as_ref()) {
                Ok((reading, model)) => {
                    let accepts = self.accepts_several_changed || baseline.is_none();
                    let refusal =
                        doubts(&reading, accepts).or_else(|| little_motion(&reading, &model));
                    if refusal.is_none() && baseline.is_none() && is_informative(&reading) {
                        baseline = Some(reading);
                    }
                    (Some((reading, Box::new(model))), refusal)
                }
                Err(refusal) => (None, Some(refusal)),
            };
            readings.push(Recorded {
                listed: listed.clone(),
                reading,
                refusal,
            });
        }
        readings
    }

    fn reading(
        &self,
        listed: &Listed,
        baseline: Option<&HealthReading>,
    ) -> Result<(HealthReading, HealthModel), Refusal> {
        let path: &Path = &listed.file;
        let parameters = self.parameters(listed).map_err(Refusal::Unreadable)?;
        let unreadable = |error: FileError| Refusal::Unreadable(error.to_string());
        let mut settings = self.settings;
        if self.estimates_displacement_noise || self.estimates_force_noise {
            let measurement = Measurement::open(path, &self.channels).map_err(unreadable)?;
            let found = noise(measurement, self.step_s).map_err(unreadable)?;
            let Some(Noise {
                displacement_m,
                force_n,
            }) = found
            else {
                return Err(Refusal::Unusable(NOISE_NEEDS.into()));
            };
            if self.estimates_displacement_noise {
                settings.displacement_noise_m = displacement_m;
            }
            if self.estimates_force_noise {
                settings.force_noise_n = force_n;
            }
        }
        let unusable = |error: dashpot_core::BuildError| Refusal::Unusable(error.to_string());
        let mut model = parameters
            .health_model(&settings, self.step_s)
            .map_err(unusable)?;
        if let Some(baseline) = baseline {
            // A mount that cannot be told from a rigid one is no baseline; the nominal damper then stays it.
            let _ = model.set_baseline(baseline.as_baseline());
        }
        let measurement = Measurement::open(path, &self.channels).map_err(unreadable)?;
        let (history, _) =
            history(measurement, &model, self.step_s, f64::INFINITY).map_err(unreadable)?;
        let last = history.last().copied();
        let last = last.ok_or_else(|| Refusal::Unusable("there is no sample".into()))?;
        Ok((last, model))
    }
}

/// True if the recording says enough about every parameter.
fn is_informative(reading: &HealthReading) -> bool {
    !reading.status.contains(HealthStatus::LITTLE_EXCITATION)
}

/// Returns the refusal of a reading that no trend can use.
fn little_motion(reading: &HealthReading, model: &HealthModel) -> Option<Refusal> {
    let is_known = |parameter: Parameter| parameter.fitted(reading, model).is_some();
    let reason = "too little motion in contact to know any parameter";
    (!Parameter::ALL.into_iter().any(is_known)).then(|| Refusal::Unusable(reason.into()))
}

/// Returns why a reading cannot be trusted.
fn doubts(reading: &HealthReading, accepts_several_changed: bool) -> Option<Refusal> {
    let mut judged = *reading;
    if accepts_several_changed {
        judged.status -= HealthStatus::SEVERAL_CHANGED;
    }
    let doubts = doubts_in_words(&judged);
    (!doubts.is_empty()).then(|| Refusal::Doubtful(doubts.join("; ")))
}
