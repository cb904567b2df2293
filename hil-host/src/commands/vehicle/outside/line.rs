//! External dampers behind one link.

use dashpot_core::Damper;
use dashpot_core::link::MAX_DAMPERS;

use super::choice::{Choice, Source};
use super::report::Target;
use crate::commands::failure::{Failure, Outcome, remedy};
use crate::commands::line::LineOptions;
use crate::commands::step_size::StepSize;
use dashpot_files::case::Case;
use dashpot_host_link::{
    Bank, Client, Desk, EmulatorError, Link, LinkError, Session, SessionError,
};
use dashpot_vehicle_run::Run;

/// Number of slots of the in-process target: as many as a target may have.
const DESK_SLOTS: usize = MAX_DAMPERS;

/// Allowed deviation from a whole number for the ratio between the steps of case and target. The ratio is not exact,
/// because a target reports its step in single precision.
const SAME_STEP: f64 = 1e-6;

/// A target and its dampers.
pub(super) struct Line {
    name: String,
    bank: Bank<Box<dyn Link + Send>>,
    dampers: Vec<usize>,
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
    /// The link cannot be opened, the target has too few slots, or its step does not divide that of the case.
    pub(super) fn open(
        choice: &Choice,
        dampers: Vec<usize>,
        case: &Case,
        options: &LineOptions,
    ) -> Outcome<Self> {
        let name = &choice.name;
        let failed = |error: SessionError| refused(name, &error);
        let link = match &choice.source {
            Source::Link(link) => options.open(link).map_err(|error| failed(error.into()))?,
            Source::Desk | Source::File(_) => desk(case, &dampers)?,
        };
        let client = Client::new(link, options.retry_limits(), fastrand::u16(..));
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
        Ok(Self {
            name: name.clone(),
            bank: Bank::start(session, &built).map_err(failed)?,
            steps: steps as u32,
            sent_m: vec![0.0; dampers.len()],
            displacements_m: vec![0.0; dampers.len()],
            dampers,
        })
    }

    /// Sends the displacements and applies the returned forces from the next tick on.
    ///
    /// If the target takes several steps per tick, displacements are interpolated linearly.
    ///
    /// # Errors
    /// The link fails; the message names it.
    pub(super) fn exchange(&mut self, run: &mut Run) -> Result<(), String> {
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
            let forces_n = self.bank.step(&self.displacements_m).map_err(named)?;
            if step == self.steps {
                for (damper, force_n) in self.dampers.iter().zip(forces_n) {
                    super::set_force_n(run, *damper, f64::from(*force_n))
                        .map_err(|error| format!("{}: {error}", self.name))?;
                }
            }
        }
        for (sent_m, damper) in self.sent_m.iter_mut().zip(&self.dampers) {
            *sent_m = run.state().damper_displacements_m()[*damper];
        }
        Ok(())
    }

    /// Closes the session and returns the results of the target.
    ///
    /// # Errors
    /// The link fails; the message names it.
    pub(super) fn finish(self) -> Result<Target, String> {
        let Self {
            name, bank, steps, ..
        } = self;
        match bank.finish() {
            Ok(found) => Ok(Target {
                link: name,
                steps_a_tick: steps,
                found,
            }),
            Err(error) => Err(named(&name, &error)),
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
    let element = case.vehicle.dampers().nth(damper);
    let parameters = element
        .and_then(|element| case.damper(&element.name))
        .ok_or_else(|| Failure::new(format!("the vehicle has no damper {damper}")))?;
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
        _ => error.to_string(),
    }
}
