//! `dashpot vehicle`: simulates a vehicle on a track and writes histories, indices and a page.

mod check;
mod contact;
mod drawing;
pub mod drive;
mod figures;
mod history;
mod options;
pub mod outside;
mod page;
mod report;
mod spectra;
mod tables;
mod track;
mod wear;
mod wheelsets;
mod xcp;

use std::net::SocketAddr;
use std::path::{Path, PathBuf};

use drive::{Driven, Exchange, drive};
use history::History;
pub(super) use options::CaseArguments;
use outside::lines::Lines;
pub(super) use outside::rig::Datagrams;
pub(super) use outside::rig::options::Compensate;
use outside::{Outside, OutsideArguments, Traces};
use report::Report;
use xcp::{Measured, Xcp, XcpReport};

use super::tick_times::histogram_help;
use super::{Format, RealtimeArguments, TickLimitArguments, interruption, print_report, progress};
use crate::commands::failure::{Failure, Outcome};
use crate::commands::print::print_note;
use dashpot_files::case::Case;
use dashpot_files::output::{cannot_write_rows, create_folder, write_bytes, write_whole};
use dashpot_realtime::budget as timing;
use dashpot_realtime::handover::{Sender, handover};
use dashpot_realtime::options::RealtimeOptions;
use dashpot_realtime::pacing::{Pacer, PacingReport};
#[cfg(feature = "parquet")]
use dashpot_recording::columns;
use dashpot_study::sweep::{ContactTables, ContactTablesError};
use dashpot_vehicle_run::damping::DampingInfluence;
use dashpot_vehicle_run::recorded::all_signals;
use dashpot_vehicle_run::{
    Ending, Indexer, RideError, Run, RunWear, TickRecord, ValidityWatch, VehicleRunError,
    check_ride, confirmed, filtered_names,
};

/// Simulate a vehicle on a track: time histories, indices and a page.
#[derive(Debug, Clone, clap::Args)]
#[command(
    allow_negative_numbers = true,
    after_help = concat!("Examples:
  dashpot vehicle --case straight-180
  dashpot vehicle --case curve-r600 --damper vertical=in-service --output worn
  dashpot vehicle --vehicle coach --track straight --speed-km-h 160 --duration-s 20
  dashpot vehicle --case curve-r300 --check
  dashpot vehicle --case straight-180 --duration-s 60 --realtime --fifo 80 --core 1
  dashpot vehicle --case curve-r600 --outside \"front lateral damper 1=serial:/dev/ttyACM0\" --realtime
  dashpot vehicle --case straight-180 --outside \"rear vertical damper 2=force.csv\"
  dashpot vehicle --case straight-180 --outside \"front yaw damper 1=desk\" --actuator servo --compensate ats
  dashpot vehicle --case straight-180 --realtime --xcp 127.0.0.1:5555

Files in the --output folder: history.csv, one row per tick (with --parquet also history.parquet); spectra.csv, power
spectral densities at the ride points and of the leading wheels' Y/Q; wear.csv, the depth
of wear over each wheel's profile, an estimate by the law of --wear-law; indices.json; report.html, a self-contained page;
with --xcp xcp.a2l, for the tool.

Displacements are relative to the position at standstill in the track frame, positive to the right and down. Q acts
down on the rail, Y towards the track centre. The exit code is 1 if the vehicle derails, overturns or diverges, if a
wheel load exceeds 50 times the static load, if the run is interrupted, or if the link to an external damper is lost;
the results up to then are kept. A wheel load above 10 times the static load and a wheel unloaded for more than 50 ms
are reported as warnings with time and position.

--realtime steps on one thread and writes on another; all work of a tick is timed. The exit code is 1 if more than one
deadline in a thousand is missed, or any with --fail-on-miss. The times of the ticks are printed as by dashpot budget.
", histogram_help!(), "

--outside sends a damper's displacement at the end of a tick; the returned force acts at the end of the next tick, one
tick late. The run is then repeated with all dampers simulated internally, and the difference is reported. A recorded
force is applied without this delay; the recording must cover the whole run.

--actuator mounts a damper on a virtual rig: an actuator moves it, late and smaller, and its measured force acts on the
vehicle. --compensate corrects the delay. A guard ends the test if a limit is exceeded or if the actuator adds energy to
the vehicle; the command then comes to rest in 0.2 s. hybrid.csv has the signals of the rig.

If a target does not answer in time, the vehicle goes on with the last force in real time, for at most --hold-ticks
ticks in a row; without --realtime it waits. Then the run ends. The error names the damper, the time of the first
missing answer, how many are missing, and the force that was held.")
)]
pub struct VehicleArguments {
    #[command(flatten)]
    case: CaseArguments,
    /// Output folder.
    #[arg(long, default_value = "dashpot-vehicle", value_name = "FOLDER")]
    output: PathBuf,
    /// Law by which the wear of the wheels is estimated.
    #[arg(long, value_enum, default_value_t = wear::Law::Archard, value_name = "LAW")]
    wear_law: wear::Law,
    /// Do not write the page.
    #[arg(long)]
    no_page: bool,
    /// Also write history.parquet, with the columns of history.csv as float64. Needs a build with the feature
    /// `parquet`.
    #[arg(long)]
    parquet: bool,
    /// Compare the run with the reference solution and fail if it is out of bounds. Takes about a hundred times as
    /// long.
    #[arg(long, conflicts_with_all = ["realtime", "choices"])]
    check: bool,
    /// Run in real time and report missed deadlines; exit code 1 if more than one in a thousand is missed.
    #[arg(long)]
    realtime: bool,
    #[command(flatten)]
    limits: TickLimitArguments,
    #[command(flatten)]
    options: RealtimeArguments,
    /// Folder of contact tables that `dashpot tables` computed; others are an error [default: the user's cache
    /// folder].
    #[arg(long, value_name = "FOLDER", conflicts_with = "check")]
    contact_tables: Option<PathBuf>,
    #[command(flatten)]
    outside: OutsideArguments,
    /// Let a measurement and calibration tool (INCA, CANape, pyXCP) measure every signal and calibrate the dampers, by
    /// XCP on UDP and TCP [default address: 127.0.0.1:5555]. Without --realtime the vehicle runs while the tool
    /// measures, as fast as it reads. On an address of the network, nothing can be calibrated.
    #[arg(long, value_name = "ADDRESS:PORT", num_args = 0..=1, default_missing_value = super::xcp::DEFAULT,
        conflicts_with = "check")]
    xcp: Option<SocketAddr>,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Number of ticks between updates of the progress bar.
const TICKS_PER_UPDATE: u64 = 256;

/// Runs the command.
///
/// # Errors
/// The case is invalid, the folder cannot be written, the run does not complete or misses too many deadlines, or the
/// check fails.
pub fn run(arguments: &VehicleArguments) -> Outcome<()> {
    let options = arguments
        .options
        .options_under("--realtime", arguments.realtime)?;
    let limits = arguments
        .limits
        .limits_under("--realtime", arguments.realtime)?;
    if arguments.parquet && !cfg!(feature = "parquet") {
        return Err(Failure::wrong_use(
            "--parquet is not available in this build; build dashpot-hil with the feature `parquet`",
        ));
    }
    let case = arguments.case.case()?;
    if arguments.check {
        return check::run(&case, arguments.format);
    }
    note_missing_ride(&case);
    let mut outside = arguments.outside.read(&case, arguments.realtime)?;
    let run = match &arguments.contact_tables {
        Some(folder) => ContactTables::new(folder).run(&case),
        None => Run::new(&case).map_err(ContactTablesError::Contact),
    };
    let mut run = run.map_err(|error| match error {
        ContactTablesError::Contact(error) => options::refused(&case, &error),
        error => error.into(),
    })?;
    if let Some(outside) = &mut outside {
        arguments.outside.connect(outside, &case, &mut run)?;
    }
    let realtime = arguments.realtime.then_some(Realtime {
        options,
        stop_above_ns: limits.stop_above_ns,
    });
    if let Some(realtime) = &realtime {
        check_realtime(case.step_s, realtime.options)?;
    }
    let folder = &arguments.output;
    create_folder(folder)?;
    let names = names(&run, &case);
    let external = outside.as_ref().map_or(&[][..], Outside::dampers);
    let measured = Measured {
        case: &case,
        run: &run,
        names: &names,
        external,
        is_realtime: arguments.realtime,
    };
    let xcp = arguments
        .xcp
        .map(|address| Xcp::start(address, &measured, folder));
    let mut xcp = xcp.transpose()?;
    if let Some(xcp) = &xcp {
        print_note(&xcp.note());
        // A run that a tool changes cannot be repeated.
        outside.iter_mut().for_each(Outside::without_comparison);
    }
    let path = folder.join("history.csv");
    let mut wear = RunWear::new(&case, &run, arguments.wear_law.law());
    let (history, mut report) = follow(
        &case,
        &mut run,
        outside.as_mut(),
        xcp.as_mut(),
        realtime,
        (&path, names),
        &mut wear,
    )?;
    if let Some(xcp) = xcp {
        report.files.extend(xcp.file());
        report.xcp = Some(xcp.finish()?);
    }
    let is_changed = report.xcp.as_ref().is_some_and(XcpReport::has_changes);
    if outside.is_none() && !is_changed {
        let ended = report.ending.clone();
        report.ending =
            confirmed(&case, &run, ended).map_err(|error| options::refused(&case, &error))?;
        report.damping = damping_influence(&case, &run, &report)?;
    }
    report.wear = wear.indices().filter(|_| report.indices.is_some());
    let mut traces = Traces::default();
    if let Some(outside) = outside {
        let (found, signals) = outside.finish(&case, &run, &mut report.ending)?;
        report.outside = Some(found);
        traces = signals;
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
    if !traces.rigs.is_empty() {
        let path = folder.join("hybrid.csv");
        outside::rig::write(&traces.rigs, &path)?;
        report.files.push(path);
    }
    let path = folder.join("wear.csv");
    wear::write(report.wear.as_ref(), &path)?;
    report.files.push(path);
    if !arguments.no_page {
        let path = folder.join("report.html");
        write_bytes(
            &path,
            page::write(&case, &run, &report, &history, &spectra, &traces)?.as_bytes(),
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
        Ending::Completed | Ending::SlowTick { .. } => verdict(report.pacing, limits),
        ending => Err(Failure::new(ending.to_string())),
    }
}

/// Checks the deadlines and the durations of the ticks of a real-time run.
///
/// # Errors
/// A tick took longer than `--stop-above-ns`, or too many deadlines were missed: any with `--fail-on-miss`.
fn verdict(pacing: Option<PacingReport>, limits: TickLimitArguments) -> Outcome<()> {
    let Some(pacing) = pacing else { return Ok(()) };
    let allowed = pacing.verdict();
    timing::Run::from(pacing).verdict(limits.fail_on_miss)?;
    Ok(allowed?)
}

/// Examines how far the greatest wheel load of a completed run without external dampers depends on the normal damping.
fn damping_influence(case: &Case, run: &Run, report: &Report) -> Outcome<Option<DampingInfluence>> {
    let Some(indices) = report
        .indices
        .as_ref()
        .filter(|_| report.ending == Ending::Completed)
    else {
        return Ok(None);
    };
    let wheels = indices
        .wheelsets
        .iter()
        .flat_map(|wheelset| &wheelset.wheels);
    let loads = wheels.filter_map(|wheel| Some((wheel.load_greatest_n, wheel.load_static_n?)));
    let greatest = loads.max_by(|(a, _), (b, _)| a.total_cmp(b));
    let Some((load_n, static_n)) = greatest else {
        return Ok(None);
    };
    let _ends_gently = interruption::end_gently();
    let is_cancelled = &interruption::is_wanted;
    DampingInfluence::of(case, run, load_n, load_n / static_n, is_cancelled)
        .map_err(|error| options::refused(case, &error))
}

/// Prints a note to standard error, before a possibly long run, if the run will have no ride indices.
fn note_missing_ride(case: &Case) {
    let Err(reason) = check_ride(case) else {
        return;
    };
    let remedy = match reason {
        RideError::Short { .. } => "use --duration-s for a longer run",
        RideError::Step { .. } => "use --step-us for another step",
    };
    let note = format!(
        "note: {reason}; the report will have no Sperling's index and no mean comfort; {remedy}"
    );
    print_note(&note);
}

/// Capacity of the buffer between stepping and writing, in ticks: 2 s at 1 ms, about 20 MB for a locomotive.
const RECORDS: usize = 2048;

/// How a real-time run is paced.
#[derive(Debug, Clone, Copy)]
struct Realtime {
    options: RealtimeOptions,
    /// Longest allowed work of a tick, ns.
    stop_above_ns: Option<u64>,
}

/// Checks that the real-time options can be applied, on a short-lived thread.
///
/// # Errors
/// See [`Pacer::new`].
pub(super) fn check_realtime(step_s: f64, options: RealtimeOptions) -> Outcome<()> {
    let tried = std::thread::spawn(move || Pacer::new(step_s, &options).map(drop));
    match tried.join() {
        Ok(pacer) => Ok(pacer?),
        Err(_) => Err(Failure::new("the real-time thread failed")),
    }
}

/// Runs the case on a separate thread and writes one row per tick on this one, so that the real-time thread does no
/// I/O.
fn follow(
    case: &Case,
    run: &mut Run,
    outside: Option<&mut Outside>,
    mut xcp: Option<&mut Xcp>,
    realtime: Option<Realtime>,
    (path, names): (&Path, Vec<String>),
    wear: &mut RunWear,
) -> Outcome<(History, Report)> {
    let all = all_signals(run, &case.vehicle);
    let mut history = History::new(names.clone(), run.ticks(), case.step_s);
    let mut indexer = Indexer::new(case);
    let mut watch = ValidityWatch::new(case, run.track());
    let (exchange, mut beside) = outside.map(Outside::parts).unzip();
    let bar = progress::bar(run.ticks(), "vehicle");
    let _ends_gently = interruption::end_gently();
    let feed = xcp.as_mut().and_then(|xcp| xcp.take_feed());
    let xcp = xcp.as_deref();
    let (giver, taker) = handover(vec![TickRecord::new(run.time_s(), run.state()); RECORDS]);
    let (driven, pacing) = write_whole::<_, Failure>(path, |file| {
        let failed = |error: csv::Error| cannot_write_rows(path, error);
        let mut rows = csv::Writer::from_writer(file);
        rows.write_record(&names).map_err(failed)?;
        let mut row: Vec<f64> = Vec::with_capacity(names.len());
        let mut ticks = 0_u64;
        let driven = std::thread::scope(|scope| {
            let stepping = std::thread::Builder::new()
                .name("ticks".into())
                .spawn_scoped(scope, || {
                    step_through(case, run, (exchange, xcp), realtime, giver)
                });
            let stepping = stepping.map_err(|error| {
                Failure::new(format!("cannot start the stepping thread: {error}"))
            })?;
            // On an error, the receiver is dropped, which stops the stepping thread.
            let taker = taker;
            let mut written = Ok(());
            while written.is_ok()
                && taker.receive(|record| {
                    ticks += 1;
                    let time_s = super::nearest_nanosecond(record.time_s);
                    row.clear();
                    row.extend(all.iter().map(|signal| signal.value(record, time_s)));
                    indexer.add(record);
                    row.extend(indexer.filtered());
                    written = rows.serialize(&row);
                    history.add(&row);
                    if let Some(feed) = &feed {
                        feed.tick(time_s, &row);
                    }
                    watch.add(record);
                    wear.add(record);
                    if let Some(beside) = beside.as_deref_mut().and_then(Option::as_mut) {
                        beside.add(record);
                    }
                })
            {
                if ticks.is_multiple_of(TICKS_PER_UPDATE) {
                    bar.set_position(ticks);
                }
            }
            drop(taker);
            let joined = stepping.join();
            written.map_err(failed)?;
            joined.map_err(|_| Failure::new("the stepping thread failed"))?
        })?;
        rows.flush().map_err(|error| failed(error.into()))?;
        Ok(driven)
    })?;
    bar.finish_and_clear();
    let warnings = watch.warnings();
    let report = Report::new(case, &driven, indexer.indices(), warnings, pacing);
    Ok((history, report))
}

/// Runs every tick, on the thread that becomes real-time.
fn step_through(
    case: &Case,
    run: &mut Run,
    (exchange, xcp): (Option<&mut Lines>, Option<&Xcp>),
    realtime: Option<Realtime>,
    records: Sender<TickRecord>,
) -> Outcome<(Driven, Option<PacingReport>)> {
    let mut pacer = match realtime {
        Some(realtime) => {
            let pacer = Pacer::new(case.step_s, &realtime.options)?;
            Some(pacer.stopping_above_ns(realtime.stop_above_ns))
        }
        None => None,
    };
    let pacing = pacer.as_mut();
    let driven = match exchange {
        Some(lines) => drive_measured(run, lines, xcp, pacing, records),
        None => drive_measured(run, &mut (), xcp, pacing, records),
    };
    let driven = driven.map_err(|error| options::refused(case, &error))?;
    Ok((driven, pacer.map(Pacer::into_report)))
}

/// Runs every tick, with calibrated dampers if there is a server of XCP.
fn drive_measured(
    run: &mut Run,
    exchange: &mut impl Exchange,
    xcp: Option<&Xcp>,
    pacing: Option<&mut Pacer>,
    records: Sender<TickRecord>,
) -> Result<Driven, VehicleRunError> {
    match xcp {
        Some(xcp) => {
            let mut stepping = xcp.stepping(exchange);
            drive(run, &mut stepping, pacing, records, interruption::is_wanted)
        }
        None => drive(run, exchange, pacing, records, interruption::is_wanted),
    }
}

/// Names of the values of a tick: all signals, then the filtered forces.
fn names(run: &Run, case: &Case) -> Vec<String> {
    let all = all_signals(run, &case.vehicle);
    let names = all.iter().map(|signal| signal.name().to_owned());
    names.chain(filtered_names(&case.vehicle)).collect()
}
