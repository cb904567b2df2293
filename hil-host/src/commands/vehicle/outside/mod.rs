//! Dampers external to the simulated vehicle: behind a link, or as a recorded force.

mod choice;
mod force;
pub mod line;
pub mod lines;
mod named_damper;
mod report;
pub(in crate::commands) mod rig;
pub mod silence;

use std::time::Duration;

use choice::{Choice, Source};
use force::set_force_n;
use line::{Line, Waits};
use lines::Lines;
pub(in crate::commands) use report::{OutsideReport, print};
use rig::{RigArguments, RigLine, RigOptions, Samples};
use silence::Silence;

use crate::commands::failure::{Failure, Outcome};
use crate::commands::line::LineOptions;
use crate::commands::recording::ForceHistoryArguments;
use dashpot_files::case::Case;
use dashpot_recording::ForceHistory;
use dashpot_study::verification::{Effect, Forces, InsideComparison};
use dashpot_vehicle_run::{Ending, Run, outside_index};

/// External dampers and the options of their links.
#[derive(Debug, Clone, clap::Args)]
pub(in crate::commands) struct OutsideArguments {
    /// Take the force of one damper from a target (desk, tcp:HOST:PORT, serial:DEVICE, qemu, qemu:IMAGE), from a rig
    /// (udp:HOST:PORT, with --actuator) or from a recording (CSV, MDF4 or Parquet) with the channels time_s and
    /// force_n. A target is loaded with the damper's parameters. May be repeated.
    #[arg(long = "outside", value_name = "DAMPER=LINK|FILE")]
    choices: Vec<Choice>,
    /// With --realtime: largest number of ticks in a row in which the vehicle may use the last force of a target that
    /// does not answer [default: 100; for a rig 10 ms]. Then the run ends. The first such tick waits for --timeout-ms,
    /// by default one tick, and each further one until its deadline. Without --realtime, the vehicle waits as long as
    /// --timeout-ms and --tries allow.
    #[arg(long, value_name = "TICKS", value_parser = clap::value_parser!(u64).range(0..=10_000))]
    hold_ticks: Option<u64>,
    #[command(flatten)]
    options: LineOptions,
    #[command(flatten)]
    recording: ForceHistoryArguments,
    #[command(flatten)]
    rig: RigArguments,
}

/// Ticks in a row in which the vehicle may use the last force of a silent target, unless `--hold-ticks` sets them. A
/// target that receives nothing loses its link after as many.
const HOLD_TICKS: u64 = 100;

/// The external dampers of a run.
pub(in crate::commands) struct Outside {
    choices: Vec<Choice>,
    /// Index of each chosen damper.
    dampers: Vec<usize>,
    lines: Lines,
    /// Actuator of the dampers on `desk`; `None` without one.
    rig: Option<RigOptions>,
    is_realtime: bool,
    /// True if the run is repeated with internal dampers.
    is_compared: bool,
    /// Comparison with internal dampers; `None` if no damper is behind a link.
    beside: Option<InsideComparison>,
}

impl OutsideArguments {
    /// Returns the options of links.
    pub(in crate::commands) fn line_options(&self) -> &LineOptions {
        &self.options
    }

    /// Looks up the dampers and reads the files.
    ///
    /// # Errors
    /// A damper does not exist, is given twice or has a fault during the run, a file cannot be used, or `--hold-ticks`
    /// is given although the run is not in real time.
    pub(in crate::commands) fn read(
        &self,
        case: &Case,
        is_realtime: bool,
    ) -> Outcome<Option<Outside>> {
        if self.hold_ticks.is_some() && (self.choices.is_empty() || !is_realtime) {
            return Err(Failure::wrong_use(
                "--hold-ticks requires --outside and --realtime",
            ));
        }
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
        let rig = self.rig()?;
        if let Some(rig) = &rig {
            rig.check_margin(case, &dampers)?;
        }
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
                rigs: Vec::new(),
            },
            rig,
            is_realtime,
            is_compared: true,
            beside: None,
        }))
    }

    /// Returns the actuator of the rigs.
    ///
    /// # Errors
    /// The actuator cannot be used, or a damper is neither on the desk nor on a rig.
    fn rig(&self) -> Outcome<Option<RigOptions>> {
        let rig = self.rig.read()?;
        let mut linked = self.choices.iter();
        let is_behind_actuator = |source: &Source| matches!(source, Source::Desk | Source::Rig(_));
        let wrong = linked.find(|choice| match &rig {
            Some(_) => !is_behind_actuator(&choice.source),
            None => matches!(choice.source, Source::Rig(_)),
        });
        let remote = self
            .choices
            .iter()
            .find(|choice| matches!(choice.source, Source::Rig(_)));
        if let (Some(choice), Some(true)) = (remote, rig.as_ref().map(|rig| rig.without_guard)) {
            return Err(Failure::wrong_use(format!(
                "--outside \"{}={}\": --without-guard is allowed with desk only: a rig can be a real one",
                choice.damper, choice.name
            )));
        }
        match wrong {
            None => Ok(rig),
            Some(choice) if rig.is_none() => Err(Failure::wrong_use(format!(
                "--outside \"{}={}\": a rig needs --actuator, which tells how its actuator follows",
                choice.damper, choice.name
            ))),
            Some(choice) => Err(Failure::wrong_use(format!(
                "--outside \"{0}={1}\": an actuator moves a damper, allowed with --actuator: {0}=desk, \
                 {0}=udp:HOST:PORT",
                choice.damper, choice.name
            ))),
        }
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

    /// Returns the wait for an answer in real time, and the allowed number of ticks in a row without one.
    fn hold(&self, case: &Case) -> (Duration, u64) {
        let answer_wait = self.options.timeout();
        (
            answer_wait.unwrap_or(Duration::from_secs_f64(case.step_s)),
            self.hold_ticks.unwrap_or(HOLD_TICKS),
        )
    }

    /// Opens the links and loads the dampers behind them.
    ///
    /// # Errors
    /// A link cannot be used.
    pub(in crate::commands) fn connect(
        &self,
        outside: &mut Outside,
        case: &Case,
        run: &mut Run,
    ) -> Outcome<()> {
        // Dampers behind one link form one bank.
        let mut links: Vec<(&Choice, Vec<usize>)> = Vec::new();
        let mut behind = Vec::new();
        for (choice, damper) in self.choices.iter().zip(&outside.dampers) {
            if matches!(choice.source, Source::File(_)) {
                continue;
            }
            behind.push(*damper);
            if let Some(rig) = &outside.rig {
                let address = match &choice.source {
                    Source::Rig(address) => Some(address.as_str()),
                    _ => None,
                };
                let hold = (outside.is_realtime, self.hold_ticks);
                let line = RigLine::new(rig, *damper, case, address, hold)?;
                outside.lines.rigs.push(line);
                continue;
            }
            match links
                .iter_mut()
                .find(|(other, _)| other.source == choice.source)
            {
                Some((_, dampers)) => dampers.push(*damper),
                None => links.push((choice, vec![*damper])),
            }
        }
        for (choice, dampers) in links {
            let waits = Waits {
                retry_limits: self.options.retry_limits(),
                hold: outside.is_realtime.then(|| self.hold(case)),
            };
            let line = Line::open(choice, dampers, case, &self.options, waits)?;
            outside.lines.lines.push(line);
        }
        if outside.is_compared && !behind.is_empty() {
            outside.beside = Some(InsideComparison::new(run, case, behind.clone()));
        }
        for damper in behind {
            // The force is zero until the first response.
            set_force_n(run, damper, 0.0)?;
        }
        Ok(())
    }
}

/// Signals of the external dampers.
#[derive(Default)]
pub(in crate::commands) struct Traces {
    /// Forces in both runs.
    pub(in crate::commands::vehicle) forces: Vec<Forces>,
    /// Signals of the rigs.
    pub(in crate::commands::vehicle) rigs: Vec<Samples>,
}

impl Outside {
    /// Leaves out the repetition with internal dampers, because nobody knows when the run ends.
    pub(in crate::commands) fn without_comparison(&mut self) {
        self.is_compared = false;
    }

    /// Indices of the dampers in the vehicle.
    pub(in crate::commands) fn dampers(&self) -> &[usize] {
        &self.dampers
    }

    /// True if a damper is behind a link or on a rig, which go on when the vehicle pauses.
    pub(in crate::commands) fn is_real(&self) -> bool {
        self.choices.iter().any(|choice| choice.source.is_real())
    }

    /// Returns the force sources used within the ticks and the recorder for the comparison after the run.
    pub(in crate::commands) fn parts(&mut self) -> (&mut Lines, &mut Option<InsideComparison>) {
        (&mut self.lines, &mut self.beside)
    }

    /// Returns the report and the signals; sets `ending` if a target is lost while its session is closed.
    ///
    /// # Errors
    /// The run with internal dampers fails.
    pub(in crate::commands) fn finish(
        mut self,
        case: &Case,
        run: &Run,
        ending: &mut Ending,
    ) -> Outcome<(OutsideReport, Traces)> {
        // A rig must not wait for the comparison.
        for rig in &mut self.lines.rigs {
            rig.stop(run.time_s());
        }
        let mut targets = Vec::new();
        let mut silences: Vec<(usize, Silence)> = Vec::new();
        for line in self.lines.lines {
            let dampers = line.dampers().to_vec();
            let mut silence = line.silence();
            if !line.is_lost() {
                match line.finish(run.time_s()) {
                    Ok(target) => targets.push(target),
                    Err((loss, ended)) => {
                        silence = ended;
                        if *ending == Ending::Completed {
                            *ending = run.outside_lost(*loss);
                        }
                    }
                }
            }
            silences.extend(dampers.into_iter().map(|damper| (damper, silence)));
        }
        let compared = self.beside.map(|beside| beside.compare(case)).transpose();
        let compared = compared.map_err(|error| super::options::refused(case, &error))?;
        let (effect, forces): (Option<Effect>, Vec<Forces>) = match compared.flatten() {
            Some((effect, forces)) => (Some(effect), forces),
            None => (None, Vec::new()),
        };
        let of_damper = |damper: &usize| {
            let mut all = silences.iter();
            all.find(|(other, _)| other == damper).map(|found| found.1)
        };
        let silences: Vec<Option<Silence>> = self.dampers.iter().map(of_damper).collect();
        let mut report = OutsideReport::new(&self.choices, &silences, case, targets, effect);
        let histories = self.lines.recorded.iter().map(|(_, history)| history);
        report.add_unended(histories);
        let rigs = self.lines.rigs.into_iter().map(RigLine::finish);
        let (rig_reports, rigs): (Vec<_>, Vec<Samples>) = rigs.unzip();
        report.rigs = rig_reports;
        Ok((report, Traces { forces, rigs }))
    }
}
