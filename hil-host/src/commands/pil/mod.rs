//! `dashpot pil`: processor-in-the-loop comparison of a target with this host.

mod figures;
mod history;
mod page;
mod report;
mod rows;
mod served;

use std::io::Write;
use std::net::SocketAddr;
use std::path::{Path, PathBuf};

use dashpot_core::{CheckedParameters, Damper};
use history::History;
use report::{Found, print};
use rows::Rows;
use served::ServedSlots;

use super::arguments::damper_help;
use super::line::LineArguments;
use super::recording::MotionArguments;
use super::step_size::StepSize;
use super::{Format, RealtimeArguments, interruption, print_report_beside, progress, streams};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::damper;
use dashpot_files::input;
use dashpot_files::output::{self, cannot_write, write_whole_if};
use dashpot_host_link::{Client, FaultRates, FaultyLink, Link, Pace, Session};
use dashpot_realtime::pacing::Pacer;
use dashpot_recording::Recording;
use dashpot_recording::tick_grid::TickGrid;

/// Run dampers on a target and compare every force with this host, bit for bit.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot pil --link qemu --damper in-service --input data/excitations/ride_made.csv --page pil.html
  dashpot pil --link serial:/dev/ttyACM0 --damper my.toml --input run7.csv --paced --output f.csv
  dashpot pil --link tcp:localhost:5555 --damper a.toml --damper b.toml --input run7.csv
  dashpot pil --link qemu --input run7.csv --faults drop=0.01,corrupt=0.01,reset=0.001 --seed 7

A single --damper is loaded into every slot of the target. With one --damper per slot, the first goes into slot 0, the
second into slot 1 and so on. Slot i runs i ticks behind slot 0.

--paced sends each tick when it is due, one step after the previous one; a tick misses its deadline if the response
arrives after the next tick is due. Without --paced, a tick is sent as soon as the previous response arrives.

--output writes one row per tick: tick, time_s; for each slot i displacement_m_i, target_force_n_i, host_force_n_i and
status_i (the target's status bits); clock_ticks of the target for the whole bank; round_trip_ns; and event, which is
empty or a list of words separated by spaces: repeat (request repeated), recovery (dampers and states restored), late
(deadline missed), mismatch, and the injected faults drop, corrupt, delay, duplicate, reorder and reset.

--faults sets probabilities per frame: drop, corrupt, delay, duplicate, reorder, reset.

To start your own emulator for --link tcp:localhost:5555, without Nagle's delay:
  qemu-system-arm -M mps2-an500 -cpu cortex-m7 -nographic -monitor none -icount shift=0 \\
    -serial tcp:127.0.0.1:5555,server=on,nodelay=on -kernel IMAGE

The exit code is 1 if a force differs; the files are written in any case.")]
pub struct PilArguments {
    /// Presets or files.
    #[arg(
        help = damper_help("; once for all slots of the target, or once per slot"),
        long = "damper",
        default_value = "paper",
        value_name = "NAME|FILE"
    )]
    dampers: Vec<String>,
    /// Override a key of every damper: table.key=value, such as mount.clearance_m=1e-3.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<String>,
    #[command(flatten)]
    line: LineArguments,
    /// Recorded motion: text (CSV), MDF4 or Parquet; `-` for standard input.
    #[arg(long, value_name = "FILE")]
    input: PathBuf,
    #[command(flatten)]
    recording: MotionArguments,
    /// Displacements, forces and events of every tick, CSV; `-` for standard output.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Page of the run, a self-contained HTML file; `-` for standard output.
    #[arg(long, value_name = "FILE")]
    page: Option<PathBuf>,
    /// Maximum number of ticks [default: the whole recording].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    ticks: Option<u32>,
    /// Send each tick when it is due and report missed deadlines.
    #[arg(long)]
    paced: bool,
    #[command(flatten)]
    realtime: RealtimeArguments,
    /// Faults to inject on the link: kind=probability, separated by commas.
    #[arg(long, value_name = "FAULTS")]
    faults: Option<FaultRates>,
    /// Seed of the injected faults.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Let a measurement and calibration tool (INCA, CANape, pyXCP) measure every slot, by XCP on UDP and TCP
    /// [default address: 127.0.0.1:5555]. Without --paced, the ticks are sent while the tool measures.
    #[arg(long, value_name = "ADDRESS:PORT", num_args = 0..=1, default_missing_value = super::xcp::DEFAULT)]
    xcp: Option<SocketAddr>,
    /// A2L file for the tool of --xcp.
    #[arg(long, value_name = "FILE", requires = "xcp")]
    a2l: Option<PathBuf>,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Runs the command.
///
/// # Errors
/// A damper, recording, target or file cannot be used, the target is lost for good, or a force differs.
pub fn run(arguments: &PilArguments) -> Outcome<()> {
    arguments.check_files()?;
    arguments
        .realtime
        .options_under("--paced", arguments.paced)?;
    let load = |name: &String| damper::load(name, &arguments.overrides);
    let parameters: Vec<_> = arguments
        .dampers
        .iter()
        .map(load)
        .collect::<Result<_, _>>()?;
    let recording = Recording::open_with(&arguments.input, &arguments.recording.channels())?;
    // Open both files before the run, so that an unwritable file is reported early.
    let found = write_whole_if::<_, Failure>(arguments.page.as_deref(), |page| {
        let (found, history) = write_whole_if(arguments.output.as_deref(), |file| {
            drive(arguments, &parameters, recording, file)
        })?;
        if let Some((path, page)) = page {
            page.write_all(page::write(&found, &history)?.as_bytes())
                .map_err(|error| cannot_write(path, error))?;
        }
        Ok(found)
    })?;
    let data = arguments
        .files()
        .find(|path| input::is_standard_stream(path));
    print_report_beside(
        data.unwrap_or(Path::new("")),
        arguments.format,
        &found,
        print,
    )?;
    let report = &found.report;
    if report.mismatches > 0 || report.state_mismatches > 0 {
        return Err(Failure::new(format!(
            "{} forces or status words and {} states differ from those of the host",
            report.mismatches, report.state_mismatches
        )));
    }
    Ok(())
}

impl PilArguments {
    /// Returns the output files.
    fn files(&self) -> impl Iterator<Item = &Path> {
        [&self.output, &self.page]
            .into_iter()
            .flatten()
            .map(PathBuf::as_path)
    }

    /// Rejects the same file for two options.
    fn check_files(&self) -> Outcome<()> {
        let dampers = self
            .dampers
            .iter()
            .map(|name| ("--damper", Path::new(name)));
        let inputs: Vec<_> = dampers.chain([("--input", self.input.as_path())]).collect();
        streams::refuse_second_standard_input(&inputs)?;
        for (option, path) in [("--output", &self.output), ("--page", &self.page)] {
            if let Some(path) = path {
                streams::refuse_input(option, path, &self.input)?;
            }
        }
        streams::refuse_same_output(&[
            ("--output", self.output.as_deref()),
            ("--page", self.page.as_deref()),
        ])
    }
}

/// Runs the recording through the target and writes each tick to `file`, if given.
fn drive(
    arguments: &PilArguments,
    parameters: &[CheckedParameters],
    recording: Recording,
    file: Option<(&Path, &mut dyn Write)>,
) -> Outcome<(Found, History)> {
    let rates = arguments.faults.unwrap_or_default();
    let link = FaultyLink::new(arguments.line.open()?, rates, arguments.seed)?;
    let client = Client::new(link, arguments.line.retry_limits(), fastrand::u16(..));
    let mut session = Session::open(client)?;
    let target = session.target();
    let step = StepSize::of_target(target.step_s)?;
    let step_s = step.step_s();
    let build = |parameters: &CheckedParameters| parameters.build(step_s);
    let dampers: Vec<Damper<f32>> = parameters.iter().map(build).collect::<Result<_, _>>()?;
    let bar = progress::bar(input::length(&arguments.input), "pil");
    let mut ticks = TickGrid::new(recording, step_s)?;
    let start_s = ticks.start_s();
    let mut history = History::new(target.dampers, start_s, step_s);
    let mut rows = file
        .map(|(path, file)| Rows::new(path, file, target.dampers, start_s, step_s))
        .transpose()?;
    let mut pace = if arguments.paced {
        Pace::Paced(Box::new(Pacer::new(step_s, &arguments.realtime.options())?))
    } else {
        Pace::default()
    };
    let served = arguments.xcp.map(|address| {
        let (file, is_paced) = (arguments.a2l.as_deref(), arguments.paced);
        ServedSlots::start(address, target.dampers, [start_s, step_s], is_paced, file)
    });
    let mut served = served.transpose()?;
    let gate = served.as_ref().and_then(ServedSlots::gate);
    let mut left = arguments.ticks.unwrap_or(u32::MAX);
    let motion = || {
        if let Some(gate) = &gate {
            gate.pass(interruption::is_wanted);
        }
        if left == 0 {
            return Ok(None);
        }
        left -= 1;
        if left.is_multiple_of(256) {
            bar.set_position(ticks.recording().position());
        }
        Ok(ticks.next_tick()?.map(|tick| tick.displacement_m as f32))
    };
    let report = session.run(&dampers, motion, &mut pace, |record| {
        history.record(record);
        if let Some(served) = &mut served {
            served.record(record);
        }
        if let Some(rows) = &mut rows {
            rows.write(record)?;
        }
        Ok::<(), Failure>(())
    })?;
    rows.map_or(Ok(()), Rows::finish)?;
    let xcp = served.map(ServedSlots::finish).transpose()?;
    bar.finish_and_clear();
    let found = Found {
        dampers: arguments.dampers.clone(),
        step_us: step.step_us(),
        report,
        gaps: ticks.recording().gaps(),
        xcp,
        injected_faults: arguments.faults.map(|_| session.link().injected_faults()),
        seed: arguments.faults.map(|_| arguments.seed),
        files: arguments
            .files()
            .map(|path| output::name(path).display().to_string())
            .collect(),
    };
    Ok((found, history))
}
