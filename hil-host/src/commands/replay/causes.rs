//! `dashpot replay --health`: the likely cause of what the end of a recording shows.

use dashpot_calibration::cause::{Causes, end_of};
use dashpot_core::CheckedParameters;
use dashpot_files::damper::KeyedParameters;
use dashpot_files::input;
use dashpot_recording::Measurement;
use dashpot_report::health::LikelyCauses;

use super::ReplayArguments;
use crate::commands::failure::Outcome;

/// Causes with a smaller probability are not shown.
const SHOWN_PROBABILITY: f64 = 0.02;

/// Returns the likely causes of a change at the end of the recording; `None` if it is too short to tell.
pub(super) fn causes(
    arguments: &ReplayArguments,
    parameters: &CheckedParameters,
) -> Outcome<Option<Causes>> {
    let path = &arguments.input;
    let measurement = Measurement::open(path, &arguments.recording.channels())?;
    let recorded = end_of(measurement, input::name(path).display().to_string())?;
    let keyed = KeyedParameters::new(&arguments.damper.damper, parameters)?;
    Ok(Causes::find(&keyed, &recorded, arguments.step_us.step_s()).ok())
}

/// Returns the causes as the page and the text show them.
pub(super) fn likely(causes: &Causes) -> LikelyCauses {
    let shown = causes.causes.iter();
    let shown = shown.filter(|cause| cause.probability >= SHOWN_PROBABILITY);
    LikelyCauses {
        causes: shown
            .map(|cause| (cause.to_string(), cause.probability))
            .collect(),
        remarks: causes.remarks(),
    }
}
