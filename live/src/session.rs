//! A live run in one thread: the vehicle, the vehicle as new beside it, the desk, and the answers to a page.

use std::collections::VecDeque;
use std::rc::Rc;
use std::sync::Arc;

use dashpot_rail::contact::Tables;
use dashpot_vehicle_run::VehicleRunError;
use dashpot_vehicle_run::contact::WheelOnRail;
use serde_json::{Value, json};

use crate::error::within;
use crate::frame::flags;
use crate::message::{FACTOR, MAX_STEPS};
use crate::recording::Recording;
use crate::saved::{Saved, Subject};
use crate::{
    Action, ActionError, Built, Choice, Desk, Message, Observer, Request, Scene, Simulation,
    Status, reference_digest,
};

/// Where the tables of a pair of wheel and rail come from.
pub type TablesOf = Rc<dyn Fn(&WheelOnRail) -> Result<Arc<Tables>, ActionError>>;

/// A live run in one thread.
pub struct Session {
    tables: TablesOf,
    choice: Choice,
    built: Built,
    desk: Desk,
    main: Watched,
    as_new: Option<Watched>,
    pending: VecDeque<(u64, Action)>,
    recording: Recording,
    scene: Scene,
    factor: f64,
    is_stopped: bool,
}

/// A vehicle and the numbers of its frames.
#[derive(Clone)]
struct Watched {
    simulation: Simulation,
    observer: Observer,
}

impl Watched {
    fn step(&mut self) -> Result<bool, VehicleRunError> {
        let is_done = self.simulation.step()?;
        if is_done {
            let state = self.simulation.run().state();
            self.observer.add(state.ticks(), state);
        }
        Ok(is_done)
    }
}

fn read(text: &str) -> Result<Message, Vec<Value>> {
    serde_json::from_str(text).map_err(|error| {
        // A message with an unknown request has a number all the same.
        let id = serde_json::from_str::<Value>(text).ok();
        let id = id.and_then(|value| value.get("id")?.as_u64()).unwrap_or(0);
        vec![answer(id, Err(&ActionError::Message(error.to_string())))]
    })
}

/// The answer to the message with this number: more fields, or an error.
fn answer(id: u64, result: Result<Value, &ActionError>) -> Value {
    let error = result.as_ref().err().map(ToString::to_string);
    let mut answer = json!({"type": "answer", "id": id, "error": error});
    if let (Some(answer), Ok(Value::Object(fields))) = (answer.as_object_mut(), result) {
        answer.extend(fields);
    }
    answer
}

impl Session {
    /// A run of a choice at its start, whose actions follow by themselves.
    ///
    /// # Errors
    /// The choice is no case, or the tables do not belong to it.
    pub fn new(
        choice: Choice,
        actions: Vec<(u64, Action)>,
        tables: TablesOf,
    ) -> Result<Self, ActionError> {
        let built = Built::new(choice.case()?, &*tables)?;
        Self::of(choice, built, actions, tables)
    }

    fn of(
        choice: Choice,
        built: Built,
        actions: Vec<(u64, Action)>,
        tables: TablesOf,
    ) -> Result<Self, ActionError> {
        let run = built.run()?;
        let desk = Desk::new(built.case(), &run)?;
        let observer = Observer::new(&desk, &run)?;
        Ok(Self {
            scene: Scene::new(&desk, &run, observer.names())?,
            main: Watched {
                simulation: Simulation::new(built.case(), run),
                observer,
            },
            as_new: None,
            built,
            tables,
            choice,
            desk,
            pending: actions.into(),
            recording: Recording::default(),
            factor: 1.0,
            is_stopped: false,
        })
    }

    /// What a page draws, as JSON.
    pub fn scene(&self) -> Value {
        json!(self.scene)
    }

    /// State of the desk and of the run, as JSON.
    pub fn status(&self) -> Value {
        let mut status = Status::new(&self.desk, Some(&self.choice));
        status.factor = self.factor;
        status.ended = self.main.simulation.ending().map(ToString::to_string);
        status.warnings = self.main.observer.warnings();
        status.is_comparing = self.as_new.is_some();
        status.is_recording = self.recording.is_on();
        status.recorded_ticks = self.recording.ticks();
        json!(status)
    }

    /// Number of vehicles: 1, or 2 with the vehicle as new.
    pub fn runs(&self) -> u32 {
        1 + u32::from(self.as_new.is_some())
    }

    /// Simulates up to `ticks` ticks; returns their number, which is smaller if the run ends.
    ///
    /// # Errors
    /// See [`Simulation::step`].
    pub fn advance(&mut self, ticks: u32) -> Result<u32, ActionError> {
        for tick in 0..ticks {
            let place = self.main.simulation.place();
            while let Some((at, _)) = self.pending.front()
                && *at <= place.tick
            {
                let action = self.pending.pop_front().map(|(_, action)| action);
                action.map_or(Ok(()), |action| self.act(&action))?;
            }
            if !self.main.step()? {
                return Ok(tick);
            }
            if let Some(as_new) = &mut self.as_new {
                as_new.step()?;
            }
            self.recording.add(
                self.main.observer.values(),
                self.main.simulation.run().time_s(),
            );
        }
        Ok(ticks)
    }

    /// Writes a frame of a vehicle: 0, or 1 for the vehicle as new; false if there is no such vehicle.
    pub fn frame(&mut self, run: u32, to: &mut Vec<u8>) -> bool {
        let watched = match run {
            0 => Some(&mut self.main),
            1 => self.as_new.as_mut(),
            _ => None,
        };
        let Some(watched) = watched else {
            return false;
        };
        let mut found = 0;
        if watched.simulation.ending().is_some() {
            found |= flags::ENDED;
        }
        if self.is_stopped {
            found |= flags::STOPPED;
        }
        watched.observer.frame(run, [0.0; 2], found, to);
        true
    }

    /// Begins with the first message of a page, which starts a run; returns the messages to the page, the answer last.
    ///
    /// # Errors
    /// The answer, if the message does not start a run.
    pub fn first(text: &str, tables: TablesOf) -> Result<(Self, Vec<Value>), Vec<Value>> {
        let message = read(text)?;
        let Request::Start { choice, actions } = message.request else {
            let error = ActionError::Message("no run yet; allowed: start".into());
            return Err(vec![answer(message.id, Err(&error))]);
        };
        match Self::new(choice, actions, tables) {
            Ok(session) => {
                let messages = vec![
                    session.scene(),
                    session.status(),
                    answer(message.id, Ok(json!({}))),
                ];
                Ok((session, messages))
            }
            Err(error) => Err(vec![answer(message.id, Err(&error))]),
        }
    }

    /// Does what a page wants; returns the messages to it, the answer last.
    pub fn message(&mut self, text: &str) -> Vec<Value> {
        let message = match read(text) {
            Ok(message) => message,
            Err(answers) => return answers,
        };
        match self.request(message.request) {
            Ok((mut messages, fields)) => {
                messages.push(self.status());
                messages.push(answer(message.id, Ok(fields)));
                messages
            }
            Err(error) => vec![answer(message.id, Err(&error))],
        }
    }

    fn request(&mut self, request: Request) -> Result<(Vec<Value>, Value), ActionError> {
        let none = json!({});
        match request {
            Request::Start { choice, actions } => {
                self.replace_by(self.started(choice, actions)?)?;
                return Ok((vec![self.scene()], none));
            }
            Request::Reset => {
                self.replace_by(self.started(self.choice.clone(), Vec::new())?)?;
                return Ok((vec![self.scene()], none));
            }
            Request::Act { action } => self.act(&action)?,
            Request::Run { factor } => {
                within("factor", factor, FACTOR)?;
                self.factor = factor;
                self.is_stopped &= factor == 0.0;
            }
            Request::Step { ticks } => {
                self.advance(ticks.min(MAX_STEPS))?;
            }
            Request::Compare { on } => self.compare(on)?,
            Request::Save => {
                let text = self.save()?;
                return Ok((Vec::new(), json!({"state": text})));
            }
            Request::Load { state } => {
                self.load(&state)?;
                return Ok((vec![self.scene()], none));
            }
            Request::Record { on } => self.recording.turn(on),
            Request::Recording { format } => {
                let file = self.recording.file(self.main.observer.names(), &format)?;
                return Ok((vec![file], none));
            }
            Request::Digest => {
                let digest = reference_digest(&*self.tables)?;
                return Ok((Vec::new(), json!({"digest": digest})));
            }
            Request::Status => {
                let health = json!({"type": "health", "readings": self.main.observer.health()});
                return Ok((vec![health], none));
            }
            Request::Stop => {
                self.factor = 0.0;
                self.is_stopped = true;
            }
        }
        Ok((Vec::new(), none))
    }

    /// Another run at its start, with the tables of this one; a run of the same choice is not built again.
    fn started(&self, choice: Choice, actions: Vec<(u64, Action)>) -> Result<Self, ActionError> {
        let built = match choice == self.choice {
            true => self.built.clone(),
            false => Built::new(choice.case()?, &*self.tables)?,
        };
        Self::of(choice, built, actions, Rc::clone(&self.tables))
    }

    /// Goes on with another run, at the same pace and with the vehicle as new beside it if it was there.
    fn replace_by(&mut self, other: Self) -> Result<(), ActionError> {
        let (factor, was_comparing) = (self.factor, self.as_new.is_some());
        *self = other;
        self.factor = factor;
        self.compare(was_comparing)
    }

    fn act(&mut self, action: &Action) -> Result<(), ActionError> {
        let change = self.desk.act(action, self.main.simulation.place())?;
        self.main.simulation.apply(&change)?;
        if let Some(as_new) = &mut self.as_new
            && action.damper().is_none()
        {
            as_new.simulation.apply(&change)?;
        }
        Ok(())
    }

    /// Lets the vehicle as new begin where the vehicle is, or takes it away.
    fn compare(&mut self, on: bool) -> Result<(), ActionError> {
        self.as_new = match on {
            true => {
                let mut as_new = self.main.clone();
                for change in self.desk.dampers_as_new()? {
                    as_new.simulation.apply(&change)?;
                }
                Some(as_new)
            }
            false => None,
        };
        Ok(())
    }

    fn save(&self) -> Result<String, ActionError> {
        let subject = Subject::Choice(self.choice.clone());
        Saved::new(subject, &self.desk, &self.main.simulation)?.text()
    }

    fn load(&mut self, text: &str) -> Result<(), ActionError> {
        let saved = Saved::read(text)?;
        let Subject::Choice(choice) = saved.subject() else {
            return Err(ActionError::State(
                "the state is of a run of `dashpot live` and can be loaded there",
            ));
        };
        let mut loaded = self.started(choice.clone(), Vec::new())?;
        saved.restore(&mut loaded.desk, &mut loaded.main.simulation)?;
        self.replace_by(loaded)
    }
}
