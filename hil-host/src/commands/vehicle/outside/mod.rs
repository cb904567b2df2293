//! Dampers external to the simulated vehicle: behind a link, or as a recorded force.

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
use dashpot_study::verification::{Effect, Forces, InsideComparison};
use dashpot_vehicle_run::{Ending, Run, VehicleRunError, outside_index};

/// External dampers and the options of their links.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct OutsideArguments {
    /// Take the force of one damper from a target (desk, tcp:HOST:PORT, serial:DEVICE, qemu, qemu:IMAGE) or from a
    /// recording (CSV, MDF4 or Parquet) with the channels time_s and force_n. A target is loaded with the damper's
    /// parameters. May be repeated.
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

/// The external dampers of a run.
pub(super) struct Outside {
    choices: Vec<Choice>,
    /// Index of each chosen damper.
    dampers: Vec<usize>,
    lines: Lines,
    /// Comparison with internal dampers; `None` if no damper is behind a link.
    beside: Option<InsideComparison>,
}

/// Sources of the forces of the external dampers, tick by tick.
#[derive(Default)]
pub(super) struct Lines {
    lines: Vec<Line>,
    recorded: Vec<(usize, ForceHistory)>,
}

impl OutsideArguments {
    /// Looks up the dampers and reads the files.
    ///
    /// # Errors
    /// A damper does not exist, is given twice or has a fault during the run, or a file cannot be used.
    pub(super) fn read(&self, case: &Case) -> Outcome<Option<Outside>> {
        if self.choices.is_empty() {
            if self.options != LineOptions::default() {
                return Err(Failure::wrong_use(
                    "--timeout-ms, --tries and --baud require --outside",
                ));
            }
            return match self.recording == ForceHistoryArguments::default() {
                true => Ok(None),
                false => Err(Failure::wrong_use(
                    "options for reading a recording require --outside DAMPER=FILE",
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

    /// Returns the indices of the dampers.
    fn dampers(&self, case: &Case) -> Outcome<Vec<usize>> {
        let mut dampers = Vec::new();
        for choice in &self.choices {
            let name = &choice.damper;
            let damper = outside_index(case, name, &dampers).map_err(|error| {
                Failure::wrong_use(format!("--outside \"{name}={}\": {error}", choice.name))
            })?;
            dampers.push(damper);
        }
        Ok(dampers)
    }

    /// Opens the links and loads the dampers behind them.
    ///
    /// # Errors
    /// A link cannot be used.
    pub(super) fn connect(&self, outside: &mut Outside, case: &Case, run: &mut Run) -> Outcome<()> {
        // Dampers behind one link form one bank.
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
            outside.beside = Some(InsideComparison::new(run, case, behind.clone()));
        }
        for damper in behind {
            // The force is zero until the first response.
            set_force_n(run, damper, 0.0)?;
        }
        Ok(())
    }
}

/// Sets the force of a damper from the next tick on.
fn set_force_n(run: &mut Run, damper: usize, force_n: f64) -> Result<(), VehicleRunError> {
    Ok(run.state_mut().set_outside_force_n(damper, Some(force_n))?)
}

impl Exchange for Lines {
    /// Applies the recorded forces at the end of the coming tick.
    fn before(&mut self, run: &mut Run) -> Result<(), VehicleRunError> {
        let time_s = run.time_s() + run.vehicle().step_s();
        for (damper, history) in &self.recorded {
            let force_n = history.force_n(time_s);
            set_force_n(run, *damper, force_n)?;
        }
        Ok(())
    }

    /// Sends the displacements of the last tick; the returned forces act at the end of the next one. Returns an ending
    /// if a target is lost.
    fn after(&mut self, run: &mut Run) -> Option<Ending> {
        let mut lines = self.lines.iter_mut();
        let message = lines.find_map(|line| line.exchange(run).err())?;
        Some(run.outside_lost(message))
    }
}

impl Outside {
    /// Returns the force sources used within the ticks and the recorder for the comparison after the run.
    pub(super) fn parts(&mut self) -> (&mut Lines, &mut Option<InsideComparison>) {
        (&mut self.lines, &mut self.beside)
    }

    /// Returns the report and the forces in both runs; sets `ending` if a target is lost while its session is closed.
    ///
    /// # Errors
    /// The run with internal dampers fails.
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
