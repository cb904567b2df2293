//! External dampers behind one link.

use std::time::Duration;

use dashpot_core::Damper;
use dashpot_core::link::MAX_DAMPERS;

use super::choice::{Choice, Source};
use super::force::set_force_n;
use super::named_damper::named_damper;
use super::report::Target;
use super::silence::Silence;
use crate::commands::failure::{Failure, Outcome, remedy};
use crate::commands::line::LineOptions;
use crate::commands::step_size::StepSize;
use dashpot_files::case::Case;
use dashpot_host_link::{
    Bank, Client, Desk, EmulatorError, Hold, Link, LinkError, RetryLimits, Session, SessionError,
};
use dashpot_vehicle_run::{LostDamper, OutsideLoss, Run};

/// Number of slots of the in-process target: as many as a target may have.
const DESK_SLOTS: usize = MAX_DAMPERS;

/// Allowed deviation from a whole number for the ratio between the steps of case and target. The ratio is not exact,
/// because a target reports its step in single precision.
const SAME_STEP: f64 = 1e-6;

/// How long a line waits for the answers of its target.
#[derive(Debug, Clone, Copy)]
pub struct Waits {
    /// Waits and tries outside the ticks and, without `hold`, in the ticks.
    pub retry_limits: RetryLimits,
    /// In real time: longest wait in a tick, and largest number of ticks in a row without an answer.
    pub hold: Option<(Duration, u64)>,
}

/// A target and its dampers.
pub struct Line {
    name: String,
    bank: Bank<Box<dyn Link + Send>>,
    hold: Option<Hold>,
    silence: Silence,
    is_lost: bool,
    /// True in a tick that follows one without an answer.
    comes_last: bool,
    dampers: Vec<usize>,
    /// Names of the dampers.
    names: Vec<String>,
    /// Number of steps of the target per tick of the case.
    steps: u32,
    /// Last displacements sent, m.
    sent_m: Vec<f64>,
    displacements_m: Vec<f32>,
}

impl Line {
    /// Opens the link given by `choice` and loads `dampers` of the vehicle.
    ///
    /// # Errors
    /// The link cannot be opened, or see [`Self::start`].
    pub(super) fn open(
        choice: &Choice,
        dampers: Vec<usize>,
        case: &Case,
        options: &LineOptions,
        waits: Waits,
    ) -> Outcome<Self> {
        let name = &choice.name;
        let link = match &choice.source {
            Source::Link(link) => options
                .open(link)
                .map_err(|error| refused(name, &error.into()))?,
            Source::Desk | Source::Rig(_) | Source::File(_) => desk(case, &dampers)?,
        };
        Self::start(name, link, dampers, case, waits)
    }

    /// Loads `dampers` of the vehicle into the target behind `link`, which messages call `name`.
    ///
    /// # Errors
    /// The target does not answer, has too few slots, or its step does not divide that of the case.
    pub fn start(
        name: &str,
        link: Box<dyn Link + Send>,
        dampers: Vec<usize>,
        case: &Case,
        waits: Waits,
    ) -> Outcome<Self> {
        let failed = |error: SessionError| refused(name, &error);
        let client = Client::new(link, waits.retry_limits, fastrand::u16(..));
        let session = Session::open(client).map_err(failed)?;
        let step = StepSize::of_target(session.target().step_s)?;
        let steps = (case.step_s / step.step_s()).round();
        if steps < 1.0 || (case.step_s / step.step_s() - steps).abs() > SAME_STEP * steps {
            return Err(Failure::wrong_use(format!(
                "--outside {name}: the step of the target is {step} us, that of the case {} us; allowed: --step-us \
                 {step} or a whole multiple",
                1e6 * case.step_s
            )));
        }
        let built: Vec<Damper<f32>> = dampers
            .iter()
            .map(|damper| build(case, *damper, step.step_s()))
            .collect::<Outcome<_>>()?;
        let all: Vec<&str> = case.vehicle.dampers().map(|e| e.name.as_str()).collect();
        let hold = |(wait, ticks): (Duration, u64)| Hold::new(wait, ticks * steps as u64);
        Ok(Self {
            name: name.to_owned(),
            bank: Bank::start(session, &built).map_err(failed)?,
            hold: waits.hold.map(hold),
            silence: Silence::default(),
            is_lost: false,
            comes_last: false,
            names: dampers
                .iter()
                .map(|damper| all[*damper].to_owned())
                .collect(),
            steps: steps as u32,
            sent_m: vec![0.0; dampers.len()],
            displacements_m: vec![0.0; dampers.len()],
            dampers,
        })
    }

    /// Indices of the dampers in the vehicle.
    pub(super) fn dampers(&self) -> &[usize] {
        &self.dampers
    }

    /// Answers that the target did not give.
    pub fn silence(&self) -> Silence {
        self.silence
    }

    /// Decides whether other targets come before this one in the coming exchange.
    pub(super) fn begin_tick(&mut self) {
        self.comes_last = self.bank.missing_answers().in_a_row > 0;
    }

    /// True if other targets come before this one.
    pub(super) fn comes_last(&self) -> bool {
        self.comes_last
    }

    /// True if [`Self::exchange`] has failed.
    pub(super) fn is_lost(&self) -> bool {
        self.is_lost
    }

    /// Sends the displacements and applies the returned forces from the next tick on. In real time, the last forces
    /// are used again if the answer is late; `time_left` returns the time until the deadline of the tick.
    ///
    /// If the target takes several steps per tick, displacements are interpolated linearly.
    ///
    /// # Errors
    /// The link fails, or in real time too many answers in a row are missing.
    pub(super) fn exchange(
        &mut self,
        run: &mut Run,
        time_left: impl Fn() -> Duration,
    ) -> Result<(), Box<OutsideLoss>> {
        let time_s = run.time_s();
        match self.steps(run, time_left) {
            Ok(()) => {
                self.silence.update(self.bank.missing_answers(), time_s);
                Ok(())
            }
            Err(message) => {
                self.is_lost = true;
                Err(Box::new(self.loss(message, time_s)))
            }
        }
    }

    /// Makes the steps of one tick.
    ///
    /// # Errors
    /// The link fails; the message names it.
    fn steps(&mut self, run: &mut Run, time_left: impl Fn() -> Duration) -> Result<(), String> {
        let named = |error: SessionError| named(&self.name, &error);
        for step in 1..=self.steps {
            let share = f64::from(step) / f64::from(self.steps);
            let all = run.state().damper_displacements_m();
            for ((displacement_m, from_m), damper) in self
                .displacements_m
                .iter_mut()
                .zip(&self.sent_m)
                .zip(&self.dampers)
            {
                // The last step uses the displacement itself, bit for bit.
                *displacement_m = if step == self.steps {
                    all[*damper] as f32
                } else {
                    (from_m + share * (all[*damper] - from_m)) as f32
                };
            }
            let displacements_m = &self.displacements_m;
            let forces_n = match &self.hold {
                Some(hold) => self.bank.step_or_hold(displacements_m, time_left(), hold),
                None => self.bank.step(displacements_m),
            }
            .map_err(named)?;
            if step == self.steps {
                for (damper, force_n) in self.dampers.iter().zip(forces_n) {
                    set_force_n(run, *damper, f64::from(*force_n))
                        .map_err(|error| format!("{}: {error}", self.name))?;
                }
            }
        }
        for (sent_m, damper) in self.sent_m.iter_mut().zip(&self.dampers) {
            *sent_m = run.state().damper_displacements_m()[*damper];
        }
        Ok(())
    }

    /// Describes the loss of the target at `time_s`.
    fn loss(&mut self, message: String, time_s: f64) -> OutsideLoss {
        let (since_s, missing) = self.silence.end(self.bank.missing_answers(), time_s);
        let lost = self.names.iter().zip(self.bank.forces_n());
        let lost = lost.map(|(name, force_n)| LostDamper::new(name, f64::from(*force_n)));
        OutsideLoss::new(message, lost.collect(), since_s, missing)
    }

    /// Closes the session at `time_s`, the end of the run, and returns the results of the target.
    ///
    /// # Errors
    /// The link fails.
    pub(super) fn finish(mut self, time_s: f64) -> Result<Target, (Box<OutsideLoss>, Silence)> {
        match self.bank.finish() {
            Ok(found) => Ok(Target {
                link: self.name,
                steps_a_tick: self.steps,
                found,
            }),
            Err(error) => {
                let message = named(&self.name, &error);
                let loss = self.loss(message, time_s);
                Err((Box::new(loss), self.silence))
            }
        }
    }
}

/// Formats an error so that it names the link exactly once.
fn named(name: &str, error: &SessionError) -> String {
    let text = in_words(error);
    if text.contains(name) {
        text
    } else {
        format!("{name}: {text}")
    }
}

/// Creates a target in this process with the step of the case.
fn desk(case: &Case, dampers: &[usize]) -> Outcome<Box<dyn Link + Send>> {
    let first = dampers.first().copied().unwrap_or_default();
    let damper = build(case, first, case.step_s)?;
    let desk = Desk::new([damper; DESK_SLOTS]).map_err(LinkError::from)?;
    Ok(Box::new(desk))
}

/// Builds the damper with index `damper` in single precision.
fn build(case: &Case, damper: usize, step_s: f64) -> Outcome<Damper<f32>> {
    let (_, parameters) = named_damper(case, damper)?;
    Ok(parameters.build(step_s)?)
}

/// Reports that a target given by `--outside` cannot be used.
fn refused(name: &str, error: &SessionError) -> Failure {
    match error {
        SessionError::TooManyDampers { .. } => {
            Failure::wrong_use(format!("--outside {name}: {error}"))
        }
        SessionError::Link(LinkError::Emulator(EmulatorError::NoImage(_))) => {
            Failure::new(format!(
                "--outside {name}: {error}; build it with `cargo xtask firmware`, or name one with qemu:IMAGE"
            ))
        }
        _ => Failure::new(format!("--outside {name}: {}", in_words(error))),
    }
}

/// Formats the error, with the options that help if the target does not answer in time.
fn in_words(error: &SessionError) -> String {
    match error {
        SessionError::Link(source) | SessionError::After { source, .. } => {
            format!("{error}{}", remedy(source))
        }
        SessionError::Unanswered { .. } => {
            format!("{error}; use a longer --timeout-ms or more --hold-ticks")
        }
        _ => error.to_string(),
    }
}
