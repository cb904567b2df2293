//! A target with an open session.

use dashpot_core::link::{PROTOCOL, Reals, Request, Response};
use serde::Serialize;

use crate::commands::failure::{Failure, Outcome};
use crate::commands::line::LineArguments;
use crate::commands::step_size::StepSize;
use dashpot_host_link::{Client, Link, LinkError};

/// A target with an open session.
pub(in crate::commands) struct Target {
    client: Client<Box<dyn Link + Send>>,
    pub(in crate::commands) greeting: Greeting,
}

/// Answer of a target to the first request of a session.
#[derive(Serialize)]
pub(in crate::commands) struct Greeting {
    pub(in crate::commands) core_version: String,
    pub(super) protocol: u16,
    pub(in crate::commands) dampers: usize,
    /// Step of every damper (s).
    pub(in crate::commands) step_s: f32,
    /// Last tick.
    pub(super) tick: u32,
    /// True if the target is free-running.
    pub(in crate::commands) running: bool,
    /// Frequency of the clock that measures steps (Hz).
    pub(in crate::commands) clock_hz: u32,
    /// Revision of the damper in each slot.
    pub(in crate::commands) revisions: Vec<u32>,
}

/// Formats the step (s) of a target or an image, in microseconds if it is an allowed step.
pub(super) fn step_in_words(step_s: f32) -> String {
    StepSize::from_target(step_s).map_or_else(|| format!("{step_s} s"), |step| format!("{step} us"))
}

impl Target {
    /// Opens the link and starts a session with a random number.
    pub(super) fn open(line: &LineArguments) -> Outcome<Self> {
        let client = Client::new(line.open()?, line.retry_limits(), fastrand::u16(..));
        Self::greeted(client)
    }

    /// Starts a session.
    pub(in crate::commands) fn greeted(mut client: Client<Box<dyn Link + Send>>) -> Outcome<Self> {
        let welcome = client.hello()?;
        let greeting = Greeting {
            core_version: welcome.core_version.into(),
            protocol: PROTOCOL,
            dampers: welcome.revisions.len(),
            step_s: welcome.step_s,
            tick: welcome.tick,
            running: welcome.running,
            clock_hz: welcome.clock_hz,
            revisions: welcome.revisions.to_vec(),
        };
        Ok(Self { client, greeting })
    }

    /// Returns the client, for a session of another kind.
    pub(in crate::commands) fn into_client(self) -> Client<Box<dyn Link + Send>> {
        self.client
    }

    /// Returns the client that sends requests to the target.
    pub(super) fn client(&mut self) -> &mut Client<Box<dyn Link + Send>> {
        &mut self.client
    }

    /// Sends a request and returns the value that `read` extracts from the response.
    ///
    /// `read` returns `None` for a response to another kind of request, which is an error.
    pub(in crate::commands) fn ask<R>(
        &mut self,
        request: &Request<'_>,
        read: impl FnOnce(Response<'_>) -> Option<R>,
    ) -> Outcome<R> {
        let response = self.client.request(request)?;
        read(response).ok_or_else(|| LinkError::Unreadable.into())
    }

    /// Sends a request whose response carries no data.
    pub(in crate::commands) fn order(&mut self, request: &Request<'_>) -> Outcome<()> {
        self.ask(request, |response| {
            (response == Response::Done).then_some(())
        })
    }

    /// Returns one value of `option` per damper, given one value per damper or one value for all.
    pub(super) fn for_each_damper(&self, option: &str, values: &[f32]) -> Outcome<Reals> {
        let dampers = self.greeting.dampers;
        match values {
            [one] => Ok(vec![*one; dampers].into_iter().collect()),
            each if each.len() == dampers => Ok(each.iter().copied().collect()),
            other => Err(Failure::wrong_use(format!(
                "{option}: {} values, but the target has {dampers} slots; allowed: 1 value for all slots or \
                 {dampers} values",
                other.len()
            ))),
        }
    }
}
