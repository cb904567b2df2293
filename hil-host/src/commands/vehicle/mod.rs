//! `dashpot vehicle`: a vehicle on a track, its histories, indices and page.

mod check;
mod drawing;
mod figures;
mod history;
mod options;
mod outside;
mod page;
mod report;
mod spectra;

use std::path::{Path, PathBuf};

use history::History;
use options::CaseArguments;
use outside::{Outside, OutsideArguments};
use report::{Pace, Report};

use super::{Format, RealtimeArguments, interruption, print_report, progress};
use crate::commands::failure::{Failure, Outcome};
use crate::files::case::Case;
#[cfg(feature = "parquet")]
use crate::files::columns;
use crate::files::output::{cannot_write_rows, create_folder, write_bytes, write_whole};
use crate::realtime::pacing::Pacer;
use crate::study::vehicle::recorded::all_signals;
use crate::study::vehicle::{Ending, Indexer, Run, signals};

/// A vehicle on a track: time histories, indices and a page.
#[derive(Debug, Clone, clap::Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  dashpot vehicle --case straight-180
  dashpot vehicle --case curve-r600 --damper vertical=in-service --output worn
  dashpot vehicle --vehicle coach --track straight --speed-km-h 160 --duration-s 20
  dashpot vehicle --case curve-r300 --check
  dashpot vehicle --case straight-180 --duration-s 60 --realtime --fifo 80 --core 1
  dashpot vehicle --case curve-r600 --outside \"front lateral damper 1=serial:/dev/ttyACM0\" --realtime
  dashpot vehicle --case straight-180 --outside \"rear vertical damper 2=force.csv\"

Written into the folder of --output: history.csv, a row a tick, with --parquet history.parquet too; spectra.csv, power spectral densities at
the ride points and of the leading wheels' Y/Q; indices.json; report.html, a page to send.
Displacements are from where the vehicle stands, relative to the track, to the right and down positive; Q is down on the rail, Y towards
the middle of the track. Exit code 1 and the reason when the vehicle derails, diverges, or is interrupted, or a link to a damper outside is
lost: what was computed is kept.

A damper outside is given its displacement at the end of a tick; the force that it answers acts at the end of the next, one tick late. The
same run with all dampers inside is computed after it, and the difference told. A recorded force acts at its time; its file must last as long as
the run."
)]
pub struct VehicleArguments {
    #[command(flatten)]
    case: CaseArguments,
    /// Folder that results are written to.
    #[arg(long, default_value = "dashpot-vehicle", value_name = "FOLDER")]
    output: PathBuf,
    /// Writes no page.
    #[arg(long)]
    no_page: bool,
    /// Writes history.parquet too, the columns of history.csv as float64; only in a build with the feature `parquet`.
    #[arg(long)]
    parquet: bool,
    /// Holds the run against the reference solution, and fails where it is out of bounds; takes some hundred times as long.
    #[arg(long, conflicts_with = "realtime")]
    check: bool,
    /// Runs in real ticks and reports missed deadlines.
    #[arg(long)]
    realtime: bool,
    #[command(flatten)]
    options: RealtimeArguments,
    #[command(flatten)]
    outside: OutsideArguments,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Ticks between two looks whether the user wants to end.
const TICKS_A_LOOK: u64 = 256;

/// Runs the command.
///
/// # Errors
/// A case that is refused; a folder that cannot be written; a run that does not come to its end; a check that fails.
pub fn run(arguments: &VehicleArguments) -> Outcome<()> {
    let options = arguments
        .options
        .options_under("--realtime", arguments.realtime)?;
    if arguments.parquet && !cfg!(feature = "parquet") {
        return Err(Failure::wrong_use(
            "--parquet is left out of this build; build dashpot-hil with the feature `parquet`",
        ));
    }
    let case = arguments.case.case()?;
    if arguments.check {
        return check::run(&case, arguments.format);
    }
    let mut outside = arguments.outside.read(&case)?;
    let mut run = Run::new(&case).map_err(|error| options::refused(&case, &error))?;
    if let Some(outside) = &mut outside {
        arguments.outside.connect(outside, &case, &mut run)?;
    }
    let pacer = if arguments.realtime {
        Some(Pacer::new(case.step_s, &options)?)
    } else {
        None
    };
    let folder = &arguments.output;
    create_folder(folder)?;
    let path = folder.join("history.csv");
    let (history, mut report) = follow(&case, &mut run, outside.as_mut(), pacer, &path)?;
    let mut forces = Vec::new();
    if let Some(outside) = outside {
        let (found, in_both) = outside.finish(&case, &run, &mut report.ending)?;
        report.outside = Some(found);
        forces = in_both;
    }
    #[cfg(feature = "parquet")]
    if arguments.parquet {
        let columns = folder.join("history.parquet");
        columns::write(&path, &columns)?;
        report.files.push(columns);
    }
    let mut spectra = spectra::of_case(&case)?;
    if report.indices.is_some() {
        spectra::add_history(&mut spectra, &path)?;
    }
    report.files.push(path);
    let path = folder.join("spectra.csv");
    spectra::write(&spectra, &path)?;
    report.files.push(path);
    if !arguments.no_page {
        let path = folder.join("report.html");
        write_bytes(
            &path,
            page::write(&case, &run, &report, &history, &spectra, &forces)?.as_bytes(),
        )?;
        report.files.push(path);
    }
    let path = folder.join("indices.json");
    report.files.push(path.clone());
    let text =
        serde_json::to_string_pretty(&report).map_err(|error| Failure::new(error.to_string()))?;
    write_bytes(&path, (text + "\n").as_bytes())?;
    print_report(arguments.format, &report, report::print)?;
    match &report.ending {
        Ending::Completed => Ok(()),
        ending => Err(Failure::new(ending.to_string())),
    }
}

/// Runs to the end, and writes a row for each tick.
fn follow(
    case: &Case,
    run: &mut Run,
    mut outside: Option<&mut Outside>,
    mut pacer: Option<Pacer>,
    path: &Path,
) -> Outcome<(History, Report)> {
    let all = all_signals(run, &case.vehicle);
    let mut history = History::new(all.clone(), run.ticks(), case.step_s);
    let mut indexer = Indexer::new(case);
    let bar = progress::bar(run.ticks(), "vehicle");
    let _ends_gently = interruption::end_gently();
    let mut ending = Ending::Completed;
    let mut work = Pace::default();
    write_whole::<Failure>(path, |file| {
        let failed = |error: csv::Error| cannot_write_rows(path, error);
        let mut rows = csv::Writer::from_writer(file);
        rows.write_record(all.iter().map(signals::Signal::name))
            .map_err(failed)?;
        let mut row: Vec<f64> = Vec::with_capacity(all.len());
        let mut ticks = 0;
        loop {
            let timing = pacer.as_mut().map(|pacer| pacer.wait(ticks));
            if let Some(outside) = &outside {
                outside.before(run)?;
            }
            let started = std::time::Instant::now();
            let mut ended = run.step().map_err(|error| options::refused(case, &error))?;
            let took = started.elapsed();
            if let (Some(outside), None) = (&mut outside, &ended) {
                ended = outside.exchange(run);
            }
            if let (Some(pacer), Some(timing)) = (pacer.as_mut(), timing) {
                pacer.finish(timing);
            }
            if ended == Some(Ending::Completed) {
                break;
            }
            ticks += 1;
            work.add(took);
            let time_s = super::nearest_nanosecond(run.time_s());
            row.clear();
            row.extend(all.iter().map(|signal| signal.of(run.state(), time_s)));
            rows.serialize(&row).map_err(failed)?;
            history.add(&row);
            indexer.add(run.state());
            let wants_to_end = ticks % TICKS_A_LOOK == 0 && interruption::is_wanted();
            if ticks % TICKS_A_LOOK == 0 {
                bar.set_position(ticks);
            }
            if let Some(ended) = ended.or_else(|| wants_to_end.then(|| run.interrupted())) {
                ending = ended;
                break;
            }
        }
        Ok(rows.flush().map_err(|error| failed(error.into()))?)
    })?;
    bar.finish_and_clear();
    let pacing = pacer.as_ref().map(Pacer::report);
    let report = Report::new(case, ending, indexer.indices(), &work, pacing);
    Ok((history, report))
}
