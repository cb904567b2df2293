//! The operator's side of the run: it checks actions, builds what they change, and orders it from the real-time thread.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender};

use dashpot_live::{
    Action, Built, Change, Desk, FACTOR, MAX_STEPS, Message, Place, Request, Scene, Simulation,
    Status, within,
};
use dashpot_rail::track::Track;
use dashpot_vehicle_run::Run;
use serde_json::{Value, json};

mod runs;

use super::control::Control;
use super::observed::Observed;
use super::order::{Note, Order};
use crate::commands::failure::Outcome;
use crate::commands::live::source::{Source, Told, read};

/// How long an action waits before it acts, s: so that it acts at the tick that the setting names.
const AHEAD_S: f64 = 0.05;

/// Answer to a message that only the engine of a page knows.
const ALLOWED: &str = "not possible with dashpot live; allowed: act, run, step, reset, compare, save, load, record, \
                       stop, status, take-over";

/// The dampers outside, as far as the operator's side needs to know.
#[derive(Debug, Clone, Default)]
pub(super) struct OutsideFacts {
    /// Indices of the dampers.
    pub dampers: Vec<usize>,
    /// True if something goes on when the vehicle pauses.
    pub is_real: bool,
    pub has_rig: bool,
}

/// The operator's side.
pub(super) struct DeskSide {
    pub orders: SyncSender<Order>,
    pub notes: Receiver<Note>,
    pub control: Arc<Control>,
    pub observed: Arc<Observed>,
    pub outside: OutsideFacts,
    /// True if there is a file to record to.
    pub can_record: bool,
    built: Built,
    desk: Desk,
    scene: Value,
    epoch: u32,
    ended: Option<String>,
    /// True while the vehicle as new runs beside.
    is_comparing: bool,
    /// A run that the real-time thread has brought to where the vehicle is.
    copied: Option<Box<Simulation>>,
    /// Tracks that the real-time thread may still use. It must not be the one that frees them.
    tracks: Vec<Arc<Track>>,
    actions: u64,
}

impl DeskSide {
    /// The side of a run at its start.
    ///
    /// # Errors
    /// A vehicle that cannot be drawn.
    pub fn new(
        (built, desk): (Built, Desk),
        run: &Run,
        names: &[String],
        (orders, notes): (SyncSender<Order>, Receiver<Note>),
        (control, observed): (Arc<Control>, Arc<Observed>),
        outside: OutsideFacts,
    ) -> Outcome<Self> {
        let scene = scene(&desk, run, names, outside.has_rig)?;
        Ok(Self {
            orders,
            notes,
            control,
            observed,
            outside,
            can_record: false,
            built,
            desk,
            scene,
            epoch: 1,
            ended: None,
            is_comparing: false,
            copied: None,
            tracks: Vec::new(),
            actions: 0,
        })
    }

    /// Actions of all runs.
    pub fn actions(&self) -> u64 {
        self.actions
    }

    fn order(&self, order: Order) -> Result<(), String> {
        let sent = self.orders.send(order);
        sent.map_err(|_| "the run has ended".to_owned())
    }

    /// Does an action.
    ///
    /// # Errors
    /// The action is not possible; nothing changes.
    pub fn act(&mut self, action: &Action) -> Result<(), String> {
        self.refuse_outside(action)?;
        let mut place = self.control.place();
        if self.control.factor() > 0.0 {
            let ahead = AHEAD_S / self.built.case().step_s;
            place = Place {
                tick: place.tick + ahead.ceil() as u64,
                ..place
            };
        }
        let change = self.desk.act(action, place);
        let change = change.map_err(|error| error.to_string())?;
        if let Change::Track(track) = &change {
            self.tracks.push(Arc::clone(track));
        }
        self.actions += 1;
        self.order(Order::Change {
            at: place.tick,
            change,
        })
    }

    /// A damper outside is what it is.
    fn refuse_outside(&self, action: &Action) -> Result<(), String> {
        let Some(damper) = action.damper() else {
            return Ok(());
        };
        let mut names = self.built.case().vehicle.dampers();
        let index = names.position(|element| element.name == damper);
        match index.is_some_and(|index| self.outside.dampers.contains(&index)) {
            true => Err(format!(
                "{damper} is outside; it cannot be changed from here"
            )),
            false => Ok(()),
        }
    }

    fn refuse_real(&self, what: &str) -> Result<(), String> {
        match self.outside.is_real {
            true => Err(format!(
                "{what}: not possible while a real damper is outside; allowed: the emergency stop"
            )),
            false => Ok(()),
        }
    }

    /// Sets the speed of time.
    ///
    /// # Errors
    /// A real damper is outside, or the factor is not allowed.
    pub fn set_factor(&mut self, factor: f64) -> Result<(), String> {
        within("factor", factor, FACTOR).map_err(|error| error.to_string())?;
        if factor != 1.0 {
            self.refuse_real("another pace than real time")?;
        }
        self.order(Order::Factor(factor))?;
        self.control.set_factor(factor);
        Ok(())
    }

    /// Makes ticks of a paused run.
    ///
    /// # Errors
    /// A real damper is outside, or the run is not paused.
    pub fn step(&mut self, ticks: u32) -> Result<(), String> {
        self.refuse_real("single steps")?;
        if self.control.factor() > 0.0 {
            return Err("single steps: allowed while the run is paused".into());
        }
        self.order(Order::Steps(ticks.min(MAX_STEPS)))
    }
}

impl Source for DeskSide {
    fn scene(&self) -> &Value {
        &self.scene
    }

    fn status(&self) -> Value {
        let mut status = Status::new(&self.desk, None);
        status.factor = self.control.factor();
        status.ended.clone_from(&self.ended);
        status.warnings = self.observed.warnings();
        status.is_comparing = self.is_comparing;
        status.is_recording = self.observed.recording.is_on();
        status.recorded_ticks = self.observed.recording.ticks();
        let mut status = json!(status);
        status["late_ticks"] = json!(self.control.late_ticks());
        status
    }

    fn health(&self) -> Option<Value> {
        Some(json!({"type": "health", "readings": self.observed.health()}))
    }

    /// Takes what the real-time thread says, and frees what it has no use for any more.
    fn look_after(&mut self) -> bool {
        let mut is_news = false;
        while let Ok(note) = self.notes.try_recv() {
            match note {
                Note::Spent(Order::Copy(copied)) => self.copied = Some(copied),
                Note::Spent(order) => drop(order),
                Note::Stopped => is_news = true,
                Note::Ended(ending) => {
                    self.ended = Some(ending.to_string());
                    is_news = true;
                }
            }
        }
        self.tracks.retain(|track| Arc::strong_count(track) > 1);
        is_news
    }

    fn operate(&mut self, message: Value) -> Result<Told, String> {
        match read::<Message>(message)?.request {
            Request::Act { action } => self.act(&action)?,
            Request::Run { factor } => self.set_factor(factor)?,
            Request::Step { ticks } => self.step(ticks)?,
            Request::Record { on } => self.observed.recording.operate(on, self.can_record)?,
            Request::Reset => {
                self.reset()?;
                return Ok(Told::Scene);
            }
            Request::Compare { on } => self.compare(on)?,
            Request::Save => return Ok(Told::Answer(json!({"state": self.save()?}))),
            Request::Load { state } => {
                self.load(&state)?;
                return Ok(Told::Scene);
            }
            Request::Start { .. } => {
                return Err("the case is chosen when dashpot live starts".into());
            }
            _ => return Err(ALLOWED.into()),
        }
        Ok(Told::Status)
    }

    fn end(&mut self, ending: String) {
        self.ended = Some(ending);
    }
}

fn scene(desk: &Desk, run: &Run, names: &[String], has_rig: bool) -> Outcome<Value> {
    let mut scene = Scene::new(desk, run, names)?;
    scene.source = "machine";
    scene.has_rig = has_rig;
    Ok(json!(scene))
}
