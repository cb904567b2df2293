//! `dashpot replay --health`: the likely cause of what the end of a recording shows.

use std::collections::VecDeque;

use dashpot_calibration::Recorded;
use dashpot_calibration::cause::Causes;
use dashpot_core::CheckedParameters;
use dashpot_files::damper::KeyedParameters;
use dashpot_files::input;
use dashpot_recording::{MeasuredSample, Measurement};
use dashpot_report::health::LikelyCauses;

use super::ReplayArguments;
use crate::commands::failure::Outcome;

/// End of the recording in which the cause of a change is looked for (s): short, because a model is fitted to all of
/// it, so a change within it gives a value in between.
const CAUSE_S: f64 = 8.0;

/// Causes with a smaller probability are not shown.
const SHOWN_PROBABILITY: f64 = 0.02;

/// Returns the likely causes of a change at the end of the recording; `None` if it is too short to tell.
pub(super) fn causes(
    arguments: &ReplayArguments,
    parameters: &CheckedParameters,
) -> Outcome<Option<Causes>> {
    let path = &arguments.input;
    let mut measurement = Measurement::open(path, &arguments.recording.channels())?;
    let mut samples = VecDeque::new();
    while let Some(sample) = measurement.next_sample()? {
        let is_early = |first: &MeasuredSample| sample.time_s - first.time_s > CAUSE_S;
        while samples.front().is_some_and(is_early) {
            samples.pop_front();
        }
        samples.push_back(sample);
    }
    let of = |value: fn(&MeasuredSample) -> f64| samples.iter().map(value).collect();
    let recorded = Recorded {
        name: input::name(path).display().to_string(),
        times_s: of(|sample| sample.time_s),
        displacements_m: of(|sample| sample.displacement_m),
        forces_n: of(|sample| sample.force_n),
    };
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
