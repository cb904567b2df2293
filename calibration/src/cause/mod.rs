//! The most likely cause of a change: a bank of models of the same damper, each with one fault of damper or sensor.
//!
//! Each model is fitted to the recording by its one parameter. Small errors of the rig, an offset of the force and a
//! delay, are fitted in every model, with a narrow prior. The fits are compared by their sums of squares, whose scatter
//! and correlation are those of the best fit, and by Schwarz's criterion (BIC) for their numbers of parameters.

mod bank;
mod fitted;
mod held;
mod search;
mod words;

use std::collections::VecDeque;

use serde::Serialize;

use super::CalibrationError;
use super::loops::{LoopTest, Recorded};
use super::residual::correlation_samples;
use bank::{Bank, SMALL_LAG_S};
use dashpot_files::FileError;
use dashpot_files::damper::KeyedParameters;
use dashpot_recording::{MeasuredSample, Measurement};
use fitted::Fitted;

/// Share of samples in which a signal is held, from which on this is the cause.
const HELD_SHARE: f64 = 0.005;

/// Share of the force beyond the noise that the best cause may leave unexplained.
pub const MAX_UNEXPLAINED: f64 = 0.1;

/// End of the recording in which the cause of a change is looked for (s): short, because a model is fitted to all of
/// it, so a change within it gives a value in between.
const END_S: f64 = 8.0;

/// Returns the end of a recording, in which the cause of a change is looked for. `name` is used in results.
///
/// # Errors
/// The recording cannot be read.
pub fn end_of(mut measurement: Measurement, name: String) -> Result<Recorded, FileError> {
    let mut samples = VecDeque::new();
    while let Some(sample) = measurement.next_sample()? {
        let is_early = |first: &MeasuredSample| sample.time_s - first.time_s > END_S;
        while samples.front().is_some_and(is_early) {
            samples.pop_front();
        }
        samples.push_back(sample);
    }
    let of = |value: fn(&MeasuredSample) -> f64| samples.iter().map(value).collect();
    Ok(Recorded {
        name,
        times_s: of(|sample| sample.time_s),
        displacements_m: of(|sample| sample.displacement_m),
        forces_n: of(|sample| sample.force_n),
    })
}

/// Cause of a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CauseKind {
    /// Nothing has changed by more than a third of what raises an alarm.
    AsNew,
    /// More or less flow at the same force: worn valves, or oil of another temperature. Value: factor of the flow.
    Flow,
    /// A softer or stiffer mount. Value: stiffness (N/m).
    Stiffness,
    /// Another clearance. Value: clearance 2a (m).
    Clearance,
    /// The force sensor has the wrong scale. Value: its factor.
    ForceScale,
    /// The displacement sensor has the wrong scale. Value: its factor.
    DisplacementScale,
    /// The zero of the force sensor is off. Value: reading at zero force (N).
    ForceZero,
    /// The force is later than the displacement. Value: delay (s).
    Lag,
    /// One of the two signals has the wrong sign.
    Reversed,
    /// The force keeps its value while the damper moves: a stuck sensor or dropouts. Value: share of the samples.
    ForceHeld,
    /// The displacement keeps its value while the force grows. Value: share of the samples.
    DisplacementHeld,
}

/// A possible cause.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cause {
    /// The cause.
    pub kind: CauseKind,
    /// Its size, in the unit given with [`CauseKind`].
    pub value: f64,
    /// Probability among the causes in this list.
    pub probability: f64,
}

/// Possible causes, the most likely first.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Causes {
    /// All causes.
    pub causes: Vec<Cause>,
    /// Root mean square of the force that even the best cause does not explain, beyond the noise, as a share of the
    /// force. If it is above [`MAX_UNEXPLAINED`], no cause explains the recording.
    pub unexplained: f64,
    /// Offset of the force fitted along with the best cause (N).
    pub force_offset_n: f64,
    /// Delay of the force fitted along with it (s).
    pub delay_s: f64,
}

impl Causes {
    /// Returns the most likely cause; `None` if none explains the recording.
    pub fn likely(&self) -> Option<&Cause> {
        let first = self.causes.first();
        first.filter(|_| self.unexplained <= MAX_UNEXPLAINED)
    }

    /// Returns what a reader has to know about the causes, as sentences without full stops.
    pub fn remarks(&self) -> Vec<String> {
        let mut remarks = Vec::new();
        if self.unexplained > MAX_UNEXPLAINED {
            remarks.push(format!(
                "none of these causes alone explains the recording: {:.0} % of the force remain",
                100.0 * self.unexplained
            ));
        }
        let is = |kind| self.causes.first().is_some_and(|cause| cause.kind == kind);
        if self.delay_s.abs() > SMALL_LAG_S && !is(CauseKind::Lag) {
            remarks.push(format!(
                "besides, the force is {:.1} ms later than the displacement",
                1e3 * self.delay_s
            ));
        }
        remarks
    }

    /// Finds the causes of what a recording shows of `damper`, with steps of `step_s` (s).
    ///
    /// # Errors
    /// The recording is too short or too long, or its force acts in one direction only.
    pub fn find(
        damper: &KeyedParameters,
        recorded: &Recorded,
        step_s: f64,
    ) -> Result<Self, CalibrationError> {
        if let Some(held) = held::held(recorded).filter(|cause| cause.value > HELD_SHARE) {
            return Ok(Self {
                causes: vec![held],
                unexplained: 0.0,
                force_offset_n: 0.0,
                delay_s: 0.0,
            });
        }
        let bank = Bank {
            damper: damper.clone(),
            tests: LoopTest::from_recording(recorded, step_s)?,
            step_s,
        };
        let fits = bank.fits();
        let Some(best) = fits.iter().min_by(|a, b| a.square.total_cmp(&b.square)) else {
            return Err(CalibrationError::NoFit("no cause can be simulated".into()));
        };
        Ok(Self {
            unexplained: bank.unexplained(best),
            force_offset_n: best.offset_n,
            delay_s: best.delay_s,
            causes: weighed(&fits, best),
        })
    }
}

/// Returns the causes with their probabilities, the most likely first.
fn weighed(fits: &[Fitted], best: &Fitted) -> Vec<Cause> {
    let samples = best.residuals.len() as f64;
    let correlation = correlation_samples(&best.residuals);
    let independent = (samples / correlation).max(2.0);
    // The scatter of the best fit counts as that of the recording.
    let scatter = (best.square / samples).max(f64::MIN_POSITIVE);
    let criterion = |fit: &Fitted| {
        let square = fit.square / scatter / correlation;
        square + fit.penalty + f64::from(fit.parameters) * independent.ln()
    };
    let least = fits.iter().map(criterion).fold(f64::INFINITY, f64::min);
    let weight = |fit: &Fitted| (0.5 * (least - criterion(fit))).exp();
    let sum: f64 = fits.iter().map(weight).sum();
    let cause = |fit: &Fitted| Cause {
        kind: fit.kind,
        value: fit.value,
        probability: weight(fit) / sum,
    };
    let (small, mut causes): (Vec<&Fitted>, Vec<Cause>) = (
        fits.iter().filter(|fit| fit.is_small).collect(),
        fits.iter().filter(|fit| !fit.is_small).map(cause).collect(),
    );
    causes.push(Cause {
        kind: CauseKind::AsNew,
        value: 0.0,
        probability: small.into_iter().map(weight).sum::<f64>() / sum,
    });
    causes.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    causes
}
