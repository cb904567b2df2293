//! `dashpot vehicle`: a vehicle on a track, its histories, indices and page.

mod check;
mod drawing;
pub mod drive;
mod figures;
mod history;
mod options;
mod outside;
mod page;
mod report;
mod spectra;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use drive::{Driven, drive};
use history::History;
use options::CaseArguments;
use outside::{Lines, Outside, OutsideArguments};
use report::Report;

use super::{Format, RealtimeArguments, interruption, print_report, progress};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::case::Case;
use dashpot_files::output::{cannot_write_rows, create_folder, write_bytes, write_whole};
use dashpot_realtime::handover::{Sender, handover};
use dashpot_realtime::options::RealtimeOptions;
use dashpot_realtime::pacing::{Pacer, PacingReport};
#[cfg(feature = "parquet")]
use dashpot_recording::columns;
use dashpot_vehicle_run::recorded::all_signals;
use dashpot_vehicle_run::{
    Ending, Indexer, NoRide, Run, TickRecord, ValidityWatch, check_ride, signals,
};

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
the middle of the track. Exit code 1 and the reason when the vehicle derails, overturns or diverges, a wheel load passes 50 times that at
standstill, the run is interrupted, or a link to a damper outside is lost: what was computed is kept. A wheel load over 10 times that at
standstill, and a wheel without load for more than 50 ms, are warnings with time and place.

--realtime steps on a thread of its own and writes on another; everything between two ticks is timed. Exit code 1 when more than one
deadline in a thousand was missed.

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
    /// Runs in real ticks and reports missed deadlines; exit code 1 when more than one in a thousand was missed.
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

/// Ticks between two updates of the progress bar.
const TICKS_A_LOOK: u64 = 256;

/// Runs the command.
///
/// # Errors
/// A case that is refused; a folder that cannot be written; a run that does not come to its end or whose ticks are late; a check that fails.
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
    note_missing_ride(&case);
    let mut outside = arguments.outside.read(&case)?;
    let mut run = Run::new(&case).map_err(|error| options::refused(&case, &error))?;
    if let Some(outside) = &mut outside {
        arguments.outside.connect(outside, &case, &mut run)?;
    }
    let realtime = arguments.realtime.then_some(options);
    if let Some(options) = realtime {
        check_realtime(case.step_s, options)?;
    }
    let folder = &arguments.output;
    create_folder(folder)?;
    let path = folder.join("history.csv");
    let (history, mut report) = follow(&case, &mut run, outside.as_mut(), realtime, &path)?;
    let mut forces = Vec::new();
    if let Some(outside) = outside {
        let (found, in_both) = outside.finish(&case, &run, &mut report.ending)?;
        report.outside = Some(found);
        forces = in_both;
    }
    #[cfg(feature = "parquet")]
    if arguments.parquet {
        let columns = folder.join("history.parquet");
        columns::write(&path, &columns, &[])?;
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
        Ending::Completed => Ok(report
            .pacing
            .as_ref()
            .map_or(Ok(()), PacingReport::verdict)?),
        ending => Err(Failure::new(ending.to_string())),
    }
}

/// Says before the run, which may take long, that it will have no indices of ride. The report goes to standard
/// output, this beside it.
fn note_missing_ride(case: &Case) {
    let Err(reason) = check_ride(case) else {
        return;
    };
    let way_on = match reason {
        NoRide::Short { .. } => "--duration-s makes it longer",
        NoRide::Step { .. } => "--step-us sets another step",
    };
    let note = format!(
        "note: {reason}; the report will have no Sperling's index and no mean comfort; {way_on}\n"
    );
    let _ = io::stderr().lock().write_all(note.as_bytes());
}

/// Records that a tick may be ahead of the file that is written: 2 s at 1 ms, some 20 MB for a locomotive.
const RECORDS: usize = 2048;

/// Whether real ticks can be had as asked for: a thread that ends at once becomes real-time.
///
/// # Errors
/// As [`Pacer::new`].
fn check_realtime(step_s: f64, options: RealtimeOptions) -> Outcome<()> {
    let tried = std::thread::spawn(move || Pacer::new(step_s, &options).map(drop));
    match tried.join() {
        Ok(pacer) => Ok(pacer?),
        Err(_) => Err(Failure::new("the real-time thread failed")),
    }
}

/// Runs to the end on a thread of its own, and writes a row for each tick on this one: a real-time thread has no report to make.
fn follow(
    case: &Case,
    run: &mut Run,
    outside: Option<&mut Outside>,
    realtime: Option<RealtimeOptions>,
    path: &Path,
) -> Outcome<(History, Report)> {
    let all = all_signals(run, &case.vehicle);
    let mut history = History::new(all.clone(), run.ticks(), case.step_s);
    let mut indexer = Indexer::new(case);
    let mut watch = ValidityWatch::new(case);
    let (exchange, mut beside) = outside.map(Outside::parts).unzip();
    let bar = progress::bar(run.ticks(), "vehicle");
    let _ends_gently = interruption::end_gently();
    let (giver, taker) = handover(vec![TickRecord::new(run.time_s(), run.state()); RECORDS]);
    let (driven, pacing) = write_whole::<_, Failure>(path, |file| {
        let failed = |error: csv::Error| cannot_write_rows(path, error);
        let mut rows = csv::Writer::from_writer(file);
        rows.write_record(all.iter().map(signals::Signal::name))
            .map_err(failed)?;
        let mut row: Vec<f64> = Vec::with_capacity(all.len());
        let mut ticks = 0_u64;
        let driven = std::thread::scope(|scope| {
            let stepping = std::thread::Builder::new()
                .name("ticks".into())
                .spawn_scoped(scope, || step_through(case, run, exchange, realtime, giver));
            let stepping = stepping.map_err(|error| {
                Failure::new(format!("the thread of the ticks cannot start: {error}"))
            })?;
            // Dropped on an error, which ends the other thread.
            let taker = taker;
            let mut written = Ok(());
            while written.is_ok()
                && taker.receive(|record| {
                    ticks += 1;
                    let time_s = super::nearest_nanosecond(record.time_s);
                    row.clear();
                    row.extend(all.iter().map(|signal| signal.of(record, time_s)));
                    written = rows.serialize(&row);
                    history.add(&row);
                    indexer.add(record);
                    watch.add(record);
                    if let Some(beside) = beside.as_deref_mut().and_then(Option::as_mut) {
                        beside.add(record);
                    }
                })
            {
                if ticks.is_multiple_of(TICKS_A_LOOK) {
                    bar.set_position(ticks);
                }
            }
            drop(taker);
            let joined = stepping.join();
            written.map_err(failed)?;
            joined.map_err(|_| Failure::new("the thread of the ticks failed"))?
        })?;
        rows.flush().map_err(|error| failed(error.into()))?;
        Ok(driven)
    })?;
    bar.finish_and_clear();
    let warnings = watch.warnings();
    let report = Report::new(case, &driven, indexer.indices(), warnings, pacing);
    Ok((history, report))
}

/// Takes every tick; on the thread that becomes real-time.
fn step_through(
    case: &Case,
    run: &mut Run,
    exchange: Option<&mut Lines>,
    realtime: Option<RealtimeOptions>,
    records: Sender<TickRecord>,
) -> Outcome<(Driven, Option<PacingReport>)> {
    let mut pacer = match realtime {
        Some(options) => Some(Pacer::new(case.step_s, &options)?),
        None => None,
    };
    let pacing = pacer.as_mut();
    let driven = match exchange {
        Some(lines) => drive(run, lines, pacing, records, interruption::is_wanted),
        None => drive(run, &mut (), pacing, records, interruption::is_wanted),
    };
    let driven = driven.map_err(|error| options::refused(case, &error))?;
    Ok((driven, pacer.map(Pacer::into_report)))
}
