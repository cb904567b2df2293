//! Talks with viewers: scene and status to each, answers to messages, one of them operates.

use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use dashpot_server::{Hub, ViewerId};
use serde_json::{Value, json};

use super::inbox::Event;
use super::pace::BURST;
use super::roles::Roles;
use super::source::{Source, Told};

/// Time between two statuses without news.
const STATUS: Duration = Duration::from_secs(1);

/// Shortest time between two statuses to all viewers, so that one who writes much does not flood the others.
const NEWS: Duration = Duration::from_millis(50);

/// The conversation with all viewers.
pub(super) struct Conversation<S> {
    hub: Hub,
    /// Where the numbers come from.
    pub source: S,
    roles: Roles,
    told: Instant,
    /// True if all viewers should get a status soon.
    is_news: bool,
}

impl<S: Source> Conversation<S> {
    pub fn new(hub: Hub, source: S) -> Self {
        Self {
            hub,
            source,
            roles: Roles::default(),
            told: Instant::now(),
            is_news: false,
        }
    }

    /// Talks until the run is over.
    pub fn run(&mut self, events: &Receiver<Event>, is_over: impl Fn() -> bool) {
        while !is_over() {
            match events.recv_timeout(BURST) {
                Ok(event) => self.hear(event),
                Err(RecvTimeoutError::Timeout) => {}
                // The server has failed; the run goes on without viewers.
                Err(RecvTimeoutError::Disconnected) => std::thread::sleep(BURST),
            }
            self.is_news |= self.source.look_after();
            let since = self.told.elapsed();
            if since >= STATUS {
                let viewers = self.hub.viewers().into_iter();
                self.tell_health(viewers.map(|(viewer, _)| viewer));
            }
            if since >= STATUS || (self.is_news && since >= NEWS) {
                self.tell_status();
            }
        }
        self.source.look_after();
    }

    /// Tells all viewers how the run ended.
    pub fn end(&mut self, ending: String) {
        self.source.end(ending);
        self.tell_status();
    }

    fn tell_status(&mut self) {
        (self.told, self.is_news) = (Instant::now(), false);
        let status = self.source.status();
        let viewers = self.hub.viewers();
        let count = viewers.len();
        for (viewer, lost_frames) in viewers {
            let status = self.status_of(viewer, status.clone(), (count, lost_frames));
            self.hub.send(viewer, &status);
        }
    }

    fn tell_health(&self, viewers: impl Iterator<Item = ViewerId>) {
        let Some(health) = self.source.health().map(|health| health.to_string()) else {
            return;
        };
        for viewer in viewers {
            self.hub.send(viewer, &health);
        }
    }

    fn status_of(&self, viewer: ViewerId, mut status: Value, counts: (usize, u64)) -> String {
        status["role"] = json!(self.roles.of(viewer));
        (status["viewers"], status["lost_frames"]) = (json!(counts.0), json!(counts.1));
        status.to_string()
    }

    /// The status of one viewer.
    fn own_status(&self, viewer: ViewerId) -> String {
        let viewers = self.hub.viewers();
        let lost = viewers.iter().find(|(other, _)| *other == viewer);
        let lost_frames = lost.map_or(0, |(_, lost_frames)| *lost_frames);
        self.status_of(viewer, self.source.status(), (viewers.len(), lost_frames))
    }

    fn scene_of(&self, viewer: ViewerId) -> String {
        let mut scene = self.source.scene().clone();
        scene["role"] = json!(self.roles.of(viewer));
        scene.to_string()
    }

    fn hear(&mut self, event: Event) {
        match event {
            Event::Joined(viewer, wanted) => {
                self.roles.join(viewer, wanted);
                let first = [self.scene_of(viewer), self.own_status(viewer)];
                self.hub.begin(viewer, &first);
                self.source.joined();
                self.is_news = true;
            }
            Event::Left(viewer) => {
                self.roles.leave(viewer);
                self.is_news = true;
            }
            Event::Message(viewer, message) => self.answer(viewer, message),
            Event::Unreadable(viewer, error) => {
                self.hub.send(viewer, &answer(None, Err(error)));
            }
        }
    }

    fn answer(&mut self, viewer: ViewerId, message: Value) {
        let id = message.get("id").cloned();
        let result = self.message(viewer, message);
        if result.is_ok() {
            self.hub.send(viewer, &self.own_status(viewer));
            self.is_news = true;
        }
        // Without a number nobody waits for the answer, but an error should be seen.
        if id.is_some() || result.is_err() {
            self.hub.send(viewer, &answer(id, result));
        }
    }

    /// Returns the fields of the answer.
    fn message(&mut self, viewer: ViewerId, message: Value) -> Result<Value, String> {
        let none = json!({});
        match message.get("do").and_then(Value::as_str) {
            Some("take-over") => {
                self.roles.take_over(viewer)?;
                return Ok(none);
            }
            Some("status") => {
                self.tell_health(std::iter::once(viewer));
                return Ok(none);
            }
            // The inbox has already passed it on.
            Some("stop") => return Ok(none),
            _ => {}
        }
        if !self.roles.is_operator(viewer) {
            return Err("you watch: only the operator acts; allowed: stop, take-over".into());
        }
        match self.source.operate(message)? {
            Told::Status => {}
            Told::Scene => {
                for (viewer, _) in self.hub.viewers() {
                    self.hub.send(viewer, &self.scene_of(viewer));
                }
            }
            Told::Answer(fields) => return Ok(fields),
        }
        Ok(none)
    }
}

/// The answer to a message.
fn answer(id: Option<Value>, result: Result<Value, String>) -> String {
    let mut answer = json!({"type": "answer", "id": id, "error": result.as_ref().err()});
    if let (Some(answer), Ok(Value::Object(fields))) = (answer.as_object_mut(), result) {
        answer.extend(fields);
    }
    answer.to_string()
}
