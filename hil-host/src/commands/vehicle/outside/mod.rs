//! Dampers outside the simulated vehicle: behind a link, or as a recorded force.

mod choice;
mod line;
mod report;

use choice::{Choice, Source};
use line::Line;
pub(super) use report::{OutsideReport, print};

use crate::commands::failure::{Failure, Outcome};
use crate::commands::line::LineOptions;
use crate::commands::recording::ForceHistoryArguments;
use crate::commands::vehicle::drive::Exchange;
use dashpot_files::case::Case;
use dashpot_recording::ForceHistory;
use dashpot_study::verification::{Beside, Effect, Forces};
use dashpot_vehicle_run::{Ending, Run, VehicleRunError, number_outside};

/// Which dampers are outside, and how their links are used.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct OutsideArguments {
    /// Takes the force of one damper from outside: from a target (desk, tcp:HOST:PORT, serial:DEVICE, qemu, qemu:IMAGE) that has its
    /// parameters, or from a recording (CSV, MDF4 or Parquet) with the channels
    /// time_s and force_n; may be given several times.
    #[arg(
        long = "outside",
        value_name = "DAMPER=LINK|FILE",
        conflicts_with = "check"
    )]
    choices: Vec<Choice>,
    #[command(flatten)]
    options: LineOptions,
    #[command(flatten)]
    recording: ForceHistoryArguments,
}

/// The dampers outside, before or between ticks.
pub(super) struct Outside {
    choices: Vec<Choice>,
    /// Number of each chosen damper.
    dampers: Vec<usize>,
    lines: Lines,
    /// None where no damper is behind a link.
    beside: Option<Beside>,
}

/// What gives the forces of the dampers outside, tick by tick.
#[derive(Default)]
pub(super) struct Lines {
    lines: Vec<Line>,
    recorded: Vec<(usize, ForceHistory)>,
}

impl OutsideArguments {
    /// Finds the dampers and reads the files.
    ///
    /// # Errors
    /// A damper that there is not, is given twice or has a fault on the way; a file that cannot be used.
    pub(super) fn read(&self, case: &Case) -> Outcome<Option<Outside>> {
        if self.choices.is_empty() {
            if self.options != LineOptions::default() {
                return Err(Failure::wrong_use(
                    "--timeout-ms, --tries and --baud go with --outside",
                ));
            }
            return match self.recording == ForceHistoryArguments::default() {
                true => Ok(None),
                false => Err(Failure::wrong_use(
                    "options that say how a recording is read go with --outside DAMPER=FILE",
                )),
            };
        }
        let dampers = self.dampers(case)?;
        let last_s = (case.duration_s / case.step_s).round() * case.step_s;
        let mut recorded = Vec::new();
        let channels = self.recording.channels();
        for (choice, damper) in self.choices.iter().zip(&dampers) {
            if let Source::File(path) = &choice.source {
                let needed_s = case.step_s..=last_s;
                let history =
                    ForceHistory::open_with(path, &channels, needed_s).map_err(|error| {
                        let reason = Failure::from(error);
                        Failure::new(format!("--outside \"{}\": {reason}", choice.damper))
                    })?;
                recorded.push((*damper, history));
            }
        }
        Ok(Some(Outside {
            choices: self.choices.clone(),
            dampers,
            lines: Lines {
                lines: Vec::new(),
                recorded,
            },
            beside: None,
        }))
    }

    /// Numbers of the dampers.
    fn dampers(&self, case: &Case) -> Outcome<Vec<usize>> {
        let mut dampers = Vec::new();
        for choice in &self.choices {
            let name = &choice.damper;
            let damper = number_outside(case, name, &dampers).map_err(|error| {
                Failure::wrong_use(format!("--outside \"{name}={}\": {error}", choice.name))
            })?;
            dampers.push(damper);
        }
        Ok(dampers)
    }

    /// Opens the links and loads the dampers behind them.
    ///
    /// # Errors
    /// A link that cannot be used.
    pub(super) fn connect(&self, outside: &mut Outside, case: &Case, run: &mut Run) -> Outcome<()> {
        // Dampers behind one link are one bank.
        let mut links: Vec<(&Choice, Vec<usize>)> = Vec::new();
        let mut behind = Vec::new();
        for (choice, damper) in self.choices.iter().zip(&outside.dampers) {
            if matches!(choice.source, Source::File(_)) {
                continue;
            }
            behind.push(*damper);
            match links
                .iter_mut()
                .find(|(other, _)| other.source == choice.source)
            {
                Some((_, dampers)) => dampers.push(*damper),
                None => links.push((choice, vec![*damper])),
            }
        }
        for (choice, dampers) in links {
            let line = Line::open(choice, dampers, case, &self.options)?;
            outside.lines.lines.push(line);
        }
        if !behind.is_empty() {
            outside.beside = Some(Beside::new(run, case, behind.clone()));
        }
        for damper in behind {
            // At rest, until the first displacement is answered.
            set_force_n(run, damper, 0.0)?;
        }
        Ok(())
    }
}

/// The force of a damper from the next tick on.
fn set_force_n(run: &mut Run, damper: usize, force_n: f64) -> Result<(), VehicleRunError> {
    Ok(run.state_mut().set_outside_force_n(damper, Some(force_n))?)
}

impl Exchange for Lines {
    /// Recorded forces at the end of the tick that comes.
    fn before(&mut self, run: &mut Run) -> Result<(), VehicleRunError> {
        let time_s = run.time_s() + run.vehicle().step_s();
        for (damper, history) in &self.recorded {
            let force_n = history.force_n(time_s);
            set_force_n(run, *damper, force_n)?;
        }
        Ok(())
    }

    /// Displacements of the tick that was go out, the forces that come back act at the end of the next; how the run ended, where a target
    /// is lost.
    fn after(&mut self, run: &mut Run) -> Option<Ending> {
        let mut lines = self.lines.iter_mut();
        let message = lines.find_map(|line| line.exchange(run).err())?;
        Some(run.outside_lost(message))
    }
}

impl Outside {
    /// What exchanges forces within the ticks, and what keeps the run to compare it after its ticks.
    pub(super) fn parts(&mut self) -> (&mut Lines, &mut Option<Beside>) {
        (&mut self.lines, &mut self.beside)
    }

    /// What is told, and the forces in both runs; an ending, where a target is lost at last.
    ///
    /// # Errors
    /// The run with the dampers inside fails.
    pub(super) fn finish(
        self,
        case: &Case,
        run: &Run,
        ending: &mut Ending,
    ) -> Outcome<(OutsideReport, Vec<Forces>)> {
        let mut targets = Vec::new();
        let is_lost = matches!(ending, Ending::OutsideLost { .. });
        for line in self.lines.lines.into_iter().filter(|_| !is_lost) {
            match line.finish() {
                Ok(target) => targets.push(target),
                Err(message) if *ending == Ending::Completed => {
                    *ending = run.outside_lost(message);
                }
                Err(_) => {}
            }
        }
        let compared = self.beside.map(|beside| beside.compare(case)).transpose();
        let compared = compared.map_err(|error| super::options::refused(case, &error))?;
        let (effect, forces): (Option<Effect>, Vec<Forces>) = match compared.flatten() {
            Some((effect, forces)) => (Some(effect), forces),
            None => (None, Vec::new()),
        };
        let mut report = OutsideReport::new(&self.choices, case, targets, effect);
        let histories = self.lines.recorded.iter().map(|(_, history)| history);
        report.add_unended(histories);
        Ok((report, forces))
    }
}
