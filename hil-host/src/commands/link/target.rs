//! A target that said hello.

use dashpot_core::link::{PROTOCOL, Reals, Request, Response};
use serde::Serialize;

use crate::commands::failure::{Failure, Outcome};
use crate::commands::line::LineArguments;
use crate::commands::step_size::StepSize;
use dashpot_host_link::{Client, Link, LinkError};

/// A target that said hello.
pub(super) struct Target {
    client: Client<Box<dyn Link + Send>>,
    pub(super) greeting: Greeting,
}

/// What a target says of itself.
#[derive(Serialize)]
pub(super) struct Greeting {
    pub(super) core_version: String,
    pub(super) protocol: u16,
    pub(super) dampers: usize,
    /// Step of every damper (s).
    pub(super) step_s: f32,
    /// Last tick.
    pub(super) tick: u32,
    /// Whether the tick runs free.
    pub(super) running: bool,
    /// Rate of the clock that measures steps (Hz).
    pub(super) clock_hz: u32,
    /// Of the damper in each place.
    pub(super) revisions: Vec<u32>,
}

/// A step as a target or an image has it (s), in words.
pub(super) fn step_in_words(step_s: f32) -> String {
    StepSize::from_target(step_s).map_or_else(|| format!("{step_s} s"), |step| format!("{step} us"))
}

impl Target {
    /// Opens the line and says hello under a session number drawn at random.
    pub(super) fn open(line: &LineArguments) -> Outcome<Self> {
        let mut client = Client::new(line.open()?, line.retry_limits(), fastrand::u16(..));
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

    /// Who asks it.
    pub(super) fn client(&mut self) -> &mut Client<Box<dyn Link + Send>> {
        &mut self.client
    }

    /// Asks, and takes what `read` finds in the answer; `None` where that is an answer to something else.
    pub(super) fn ask<R>(
        &mut self,
        request: &Request<'_>,
        read: impl FnOnce(Response<'_>) -> Option<R>,
    ) -> Outcome<R> {
        let response = self.client.request(request)?;
        read(response).ok_or_else(|| LinkError::Unreadable.into())
    }

    /// Asks for something to be done.
    pub(super) fn order(&mut self, request: &Request<'_>) -> Outcome<()> {
        self.ask(request, |response| {
            (response == Response::Done).then_some(())
        })
    }

    /// A value of `option` for each damper, of one for all or one for each.
    pub(super) fn for_each_damper(&self, option: &str, values: &[f32]) -> Outcome<Reals> {
        let dampers = self.greeting.dampers;
        match values {
            [one] => Ok(vec![*one; dampers].into_iter().collect()),
            each if each.len() == dampers => Ok(each.iter().copied().collect()),
            other => Err(Failure::wrong_use(format!(
                "{option}: {} values, the target has {dampers} places; allowed: 1, for all places, \
                 or {dampers}, one for each",
                other.len()
            ))),
        }
    }
}
