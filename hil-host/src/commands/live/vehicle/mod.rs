//! A vehicle in real time, with dampers outside if wanted.
//!
//! Four threads: the real-time thread (`ticking`), the one that makes frames from every tick (`watching`), the one that
//! writes the recording (`recorder`), and the one that talks with viewers (`conversation`); each connection has two
//! more in `dashpot_server`. The real-time thread shares nothing with them but rings and atomic numbers.

mod beside;
mod burst;
mod control;
mod desk_side;
mod observed;
mod order;
mod report;
mod tick;
mod ticking;
mod watching;

use std::sync::Arc;
use std::sync::mpsc::sync_channel;

use control::Control;
use desk_side::{DeskSide, OutsideFacts};
use observed::Observed;
use order::{Rings, rings};
use report::Report;
use ticking::{Ticked, Ticking};
use watching::Watching;

use super::conversation::Conversation;
use super::options::LiveArguments;
use super::recorder::{Block, Recorder};
use super::rows::Rows;
use super::serve::{Served, serve};
use crate::commands::failure::{Failure, Outcome};
use crate::commands::paced::Paced;
use crate::commands::vehicle::check_realtime;
use crate::commands::vehicle::outside::lines::Lines;
use crate::commands::{interruption, print_report};
use dashpot_live::{Built, Desk, Observer, Simulation, WheelOnRail};
use dashpot_realtime::budget;
use dashpot_realtime::handover::handover;
use dashpot_realtime::pacing::{Pacer, PacingReport};
use dashpot_vehicle_run::{Ending, Run};

/// Blocks of rows that wait for the disk: several seconds.
const BLOCKS: usize = 64;

/// A run at its start, with everything that its threads share.
struct Prepared {
    built: Built,
    run: Run,
    desk: Desk,
    observer: Observer,
    control: Arc<Control>,
    observed: Arc<Observed>,
}

/// Runs the vehicle while viewers watch.
///
/// # Errors
/// The case is invalid, the address cannot be used, a damper outside fails, or the run ends otherwise than asked.
pub(super) fn run(arguments: &LiveArguments) -> Outcome<()> {
    let case = arguments.case()?;
    let mut outside = arguments.outside.read(&case, true)?;
    check_realtime(case.step_s, arguments.options.options())?;
    let mut prepared = prepare(case)?;
    let record = arguments.record.as_deref();
    let recorder = record.map(|path| Recorder::new(path, prepared.observer.names()));
    let recorder = recorder.transpose()?;
    let case = prepared.built.case();
    let (name, vehicle) = (case.name.clone(), case.vehicle.name.clone());
    let served = serve(arguments, &name, &vehicle, &prepared.control.stop)?;
    let _ends_gently = interruption::end_gently();
    let mut facts = OutsideFacts::default();
    if let Some(outside) = &mut outside {
        outside.without_comparison();
        let case = prepared.built.case();
        arguments
            .outside
            .connect(outside, case, &mut prepared.run)?;
        let (lines, _) = outside.parts();
        facts = OutsideFacts {
            has_rig: lines.has_rig(),
            dampers: outside.dampers().to_vec(),
            is_real: outside.is_real(),
        };
    }
    served.announce();
    let case = prepared.built.case().clone();
    let observed = Arc::clone(&prepared.observed);
    let lines = outside.as_mut().map(|outside| outside.parts().0);
    let followed = follow(arguments, prepared, lines, facts, recorder, &served);
    let (ticked, pacing, mut conversation) = followed?;
    let mut ending = ticked.ending;
    let run = ticked.simulation.run();
    let found = match outside {
        Some(outside) => Some(outside.finish(&case, run, &mut ending)?.0),
        None => None,
    };
    conversation.end(ending.to_string());
    let viewers = served.server.hub().clone();
    served.end();
    let report = Report {
        case: case.name.clone(),
        vehicle: case.vehicle.name.clone(),
        track: case.track.name.clone(),
        step_s: case.step_s,
        ticks: ticked.ticks,
        actions: conversation.source.actions(),
        ending,
        is_stopped: ticked.is_stopped,
        realtime: Paced::with_times(&pacing, case.step_s, 0),
        viewers: viewers.count().into(),
        unobserved_ticks: ticked.skipped,
        recording: record.map(|file| observed.recording.report(file)),
        warnings: observed.warnings(),
        outside: found,
    };
    print_report(arguments.format, &report, report::print)?;
    verdict(&report, pacing, arguments.limits.fail_on_miss)
}

fn prepare(case: dashpot_files::case::Case) -> Outcome<Prepared> {
    let built = Built::new(case, |pair: &WheelOnRail| Ok(pair.tables()?))?;
    let run = built.run()?;
    let desk = Desk::new(built.case(), &run)?;
    Ok(Prepared {
        observer: Observer::new(&desk, &run)?,
        desk,
        built,
        run,
        control: Arc::default(),
        observed: Arc::default(),
    })
}

/// Runs the vehicle to its end while viewers watch.
fn follow(
    arguments: &LiveArguments,
    prepared: Prepared,
    lines: Option<&mut Lines>,
    facts: OutsideFacts,
    recorder: Option<Recorder>,
    served: &Served,
) -> Outcome<(Ticked, PacingReport, Conversation<DeskSide>)> {
    let Prepared {
        built,
        run,
        desk,
        observer,
        control,
        observed,
    } = prepared;
    let (step_s, names) = (built.case().step_s, observer.names().to_vec());
    let simulation = Box::new(Simulation::new(built.case(), run.clone()));
    let Rings {
        to_ticks,
        orders,
        notes,
        to_desk,
    } = rings();
    let (giver, taker) = handover(tick::room(&run));
    let options = arguments.options.options();
    let stop_above_ns = arguments.limits.stop_above_ns;
    observed.recording.turn(recorder.is_some());
    let can_record = recorder.is_some();
    std::thread::scope(|scope| {
        let blocks = recorder.map(|recorder| {
            let (blocks, to_write) = sync_channel::<Block>(BLOCKS);
            let state = &observed.recording;
            spawn(scope, "recording", move || recorder.run(&to_write, state))?;
            Outcome::Ok(blocks)
        });
        let watching = Watching {
            observer,
            as_new: None,
            hub: served.server.hub().clone(),
            control: &control,
            observed: &observed,
            rows: Rows::new(blocks.transpose()?),
            step_s,
        };
        spawn(scope, "frames", move || watching.run(&taker))?;
        let on_thread = &control;
        let stepping = spawn(scope, "ticks", move || {
            let ticking = Ticking::new(simulation, lines, on_thread, (orders, to_desk), giver);
            let mut pacer = Pacer::new(step_s, &options)?.stopping_above_ns(stop_above_ns);
            let ticked = ticking.run(&mut pacer, interruption::is_wanted)?;
            Outcome::Ok((ticked, pacer.into_report()))
        })?;
        let both = (Arc::clone(&control), Arc::clone(&observed));
        let desk = DeskSide::new((built, desk), &run, &names, (to_ticks, notes), both, facts);
        let mut desk = match desk {
            Ok(desk) => desk,
            Err(error) => {
                control.end();
                return Err(error);
            }
        };
        desk.can_record = can_record;
        let mut conversation = Conversation::new(served.server.hub().clone(), desk);
        conversation.run(&served.to_hear, || stepping.is_finished());
        let joined = stepping.join();
        let (ticked, pacing) = joined.map_err(|_| Failure::new("the stepping thread failed"))??;
        Ok((ticked, pacing, conversation))
    })
}

/// Starts a thread of this name.
fn spawn<'scope, T: Send + 'scope>(
    scope: &'scope std::thread::Scope<'scope, '_>,
    name: &str,
    work: impl FnOnce() -> T + Send + 'scope,
) -> Outcome<std::thread::ScopedJoinHandle<'scope, T>> {
    let thread = std::thread::Builder::new().name(name.into());
    thread
        .spawn_scoped(scope, work)
        .map_err(|error| Failure::new(format!("cannot start the thread `{name}`: {error}")))
}

/// Judges how the run ended.
///
/// # Errors
/// It ended otherwise than asked, its recording failed, or with `--fail-on-miss` a deadline was missed.
fn verdict(report: &Report, pacing: PacingReport, fail_on_miss: bool) -> Outcome<()> {
    budget::Run::from(pacing).verdict(fail_on_miss)?;
    let recording = report.recording.as_ref();
    if let Some(error) = recording.and_then(|recording| recording.error.as_ref()) {
        return Err(Failure::new(error.clone()));
    }
    let is_asked = report.is_stopped || interruption::is_wanted();
    match &report.ending {
        Ending::Completed | Ending::Interrupted { .. } => Ok(()),
        Ending::GuardEnded { .. } if is_asked => Ok(()),
        ending => Err(Failure::new(ending.to_string())),
    }
}
