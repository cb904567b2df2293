//! A target over its link, without a vehicle: driven by a sine from here, or watched while it runs free.

mod driven;
mod figures;
mod motion;
mod order;
mod report;
mod scene;
mod side;
mod tap;
mod watched;

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};

use dashpot_core::Damper;
use dashpot_files::damper;
use dashpot_host_link::{Bank, Client, LinkChoice, Session};
use dashpot_live::DamperDesk;
use dashpot_realtime::pacing::Pacer;
use driven::Driven;
use figures::{SharedFigures, Slot};
use motion::{Motion, Sine};
use order::{ORDERS, Order};
use report::{Ended, Report};
use side::TargetSide;
use tap::{Tap, names};
use watched::{Model, Watched};

use super::conversation::Conversation;
use super::options::LiveArguments;
use super::recorded::RecordingState;
use super::recorder::{Block, Recorder};
use super::rows::Rows;
use super::serve::serve;
use super::stop::Stop;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::link::target::Target;
use crate::commands::step_size::StepSize;
use crate::commands::{interruption, print_report};

/// Blocks of rows that wait for the disk: several seconds.
const BLOCKS: usize = 64;

/// What the thread that talks with the target shares with the operator's side.
#[derive(Default)]
struct Shared {
    stop: Arc<Stop>,
    figures: Arc<SharedFigures>,
    recording: Arc<RecordingState>,
}

/// Dampers of a target's slots: on the desk, and built for its step.
#[derive(Default)]
struct Dampers {
    desks: Vec<DamperDesk>,
    built: Vec<Damper<f32>>,
}

/// Shows a target until somebody stops it.
///
/// # Errors
/// The target or a damper cannot be used, the address cannot be used, the target is lost, or a force of a driven target
/// differs from that of this host.
pub(super) fn run(arguments: &LiveArguments, link: &LinkChoice) -> Outcome<()> {
    let options = arguments.outside.line_options();
    let client = Client::new(
        options.open(link)?,
        options.retry_limits(),
        fastrand::u16(..),
    );
    let target = Target::greeted(client)?;
    let step = StepSize::of_target(target.greeting.step_s)?;
    let dampers = dampers(arguments, &target, step.step_s())?;
    let shared = Shared::default();
    warn_of_other_dampers(&target, &dampers, &shared.figures);
    let line = link.to_string();
    let sine = (!target.greeting.running).then(Sine::default);
    let scene = scene::scene(&line, &target.greeting, &dampers.desks, sine.as_ref());
    let record = arguments.record.as_deref();
    let recorder = record.map(|path| Recorder::new(path, &names(target.greeting.dampers)));
    let recorder = recorder.transpose()?;
    shared.recording.turn(recorder.is_some());
    let served = serve(
        arguments,
        "target",
        &format!("target at {line}"),
        &shared.stop,
    )?;
    let _ends_gently = interruption::end_gently();
    served.announce();
    let (to_target, orders) = sync_channel(ORDERS);
    let core_version = target.greeting.core_version.clone();
    let side = TargetSide {
        scene,
        dampers: dampers.desks,
        motion: sine,
        step_s: step.step_s(),
        slots: target.greeting.dampers,
        orders: to_target,
        figures: Arc::clone(&shared.figures),
        recording: Arc::clone(&shared.recording),
        can_record: recorder.is_some(),
        ended: None,
    };
    let hub = served.server.hub().clone();
    let mut conversation = Conversation::new(hub.clone(), side);
    let (blocks, to_write) = sync_channel::<Block>(BLOCKS);
    let signals = names(target.greeting.dampers).len();
    let tap = Tap::new(
        hub.clone(),
        Arc::clone(&shared.recording),
        Rows::new(recorder.is_some().then_some(blocks)),
        (step.step_s(), signals),
    );
    let talk = talking(
        arguments,
        target,
        dampers.built,
        (sine, step),
        orders,
        &shared,
        tap,
    )?;
    let ended = std::thread::scope(|scope| {
        if let Some(recorder) = recorder {
            let state = &shared.recording;
            scope.spawn(move || recorder.run(&to_write, state));
        }
        let talking = scope.spawn(talk);
        conversation.run(&served.to_hear, || talking.is_finished());
        let joined = talking.join();
        joined.map_err(|_| Failure::new("the thread of the link failed"))?
    });
    let ending = match &ended {
        Ok(ended) => ended.in_words(),
        Err(error) => error.to_string(),
    };
    conversation.end(ending);
    served.end();
    let ended = ended?;
    let report = Report {
        link: line,
        core_version,
        step_us: step.step_us(),
        warnings: shared.figures.lock().warnings.clone(),
        viewers: hub.count().into(),
        recording: record.map(|path| shared.recording.report(path)),
        ended,
    };
    print_report(arguments.format, &report, report::print)?;
    report.verdict()
}

/// The thread that talks with the target, not yet started.
type Talk = Box<dyn FnOnce() -> Outcome<Ended> + Send>;

/// Prepares the thread that talks with the target.
fn talking(
    arguments: &LiveArguments,
    target: Target,
    built: Vec<Damper<f32>>,
    (sine, step): (Option<Sine>, StepSize),
    orders: Receiver<Order>,
    shared: &Shared,
    tap: Tap,
) -> Outcome<Talk> {
    let (stop, figures) = (Arc::clone(&shared.stop), Arc::clone(&shared.figures));
    let greeting = &target.greeting;
    let (slots, clock_hz, step_s) = (greeting.dampers, greeting.clock_hz, step.step_s());
    figures.lock().slots = vec![Slot::default(); slots];
    let Some(sine) = sine else {
        let models = (!built.is_empty()).then(|| built.into_iter().map(Model::new).collect());
        let watched = Watched {
            target,
            models,
            step_s,
            orders,
            stop,
            figures,
            tap,
            waiting: vec![VecDeque::new(); slots],
        };
        return Ok(Box::new(move || {
            let (ticks, is_stopped) = watched.run()?;
            Ok(Ended::Watched { ticks, is_stopped })
        }));
    };
    let bank = Bank::start(Session::open(target.into_client())?, &built)?;
    let options = arguments.options.options();
    Ok(Box::new(move || {
        let driven = Driven {
            bank: bank.paced(Pacer::new(step_s, &options)?),
            motion: Motion::new(sine),
            step_s,
            clock_hz,
            dampers: slots,
            orders,
            stop,
            figures,
            tap,
        };
        let (report, is_stopped) = driven.run()?;
        let report = Box::new(report);
        Ok(Ended::Driven { report, is_stopped })
    }))
}

/// The dampers of the target's slots. A target that runs free has its own; without a word about them they are unknown.
fn dampers(arguments: &LiveArguments, target: &Target, step_s: f64) -> Outcome<Dampers> {
    let names = &arguments.target.slot_dampers;
    if names.is_empty() && target.greeting.running {
        return Ok(Dampers::default());
    }
    let slots = target.greeting.dampers;
    let given: Vec<&str> = match &names[..] {
        [] => vec![damper::PRESETS[0].0; slots],
        [one] => vec![one; slots],
        each if each.len() == slots => each.iter().map(String::as_str).collect(),
        other => {
            return Err(Failure::wrong_use(format!(
                "--slot-damper: {} given, but the target has {slots} slots; allowed: one for all slots or {slots}",
                other.len()
            )));
        }
    };
    let mut dampers = Dampers::default();
    for (slot, name) in given.into_iter().enumerate() {
        let parameters = damper::load(name, &[])?;
        let desk = DamperDesk::new(&scene::name(slot), &parameters)?;
        dampers.desks.push(desk);
        dampers.built.push(parameters.build(step_s)?);
    }
    Ok(dampers)
}

/// Warns if a target that runs free has other dampers than it was said.
fn warn_of_other_dampers(target: &Target, dampers: &Dampers, figures: &SharedFigures) {
    if !target.greeting.running {
        return;
    }
    let revisions = target.greeting.revisions.iter().zip(&dampers.built);
    let others = revisions
        .enumerate()
        .filter(|(_, (revision, damper))| **revision != damper.revision());
    figures.lock().warnings = others
        .map(|(slot, (revision, damper))| {
            format!(
                "slot {slot} runs another damper (revision {revision:#010x}) than the model beside it ({:#010x})",
                damper.revision()
            )
        })
        .collect();
}
