//! Starts the server of a page.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, sync_channel};

use dashpot_server::{Server, Settings};

use super::inbox::{EVENTS, Event, Inbox};
use super::options::LiveArguments;
use super::page;
use super::stop::Stop;
use crate::commands::failure::Outcome;

/// A server, what its viewers do, and what the command says about it.
pub(super) struct Served {
    pub server: Server,
    pub to_hear: Receiver<Event>,
    pub told: String,
}

/// Starts the server of a page about `subject`; `name` is that of the run.
///
/// # Errors
/// The address cannot be used, or the token is not allowed.
pub(super) fn serve(
    arguments: &LiveArguments,
    name: &str,
    subject: &str,
    stop: &Arc<Stop>,
) -> Outcome<Served> {
    let (events, to_hear) = sync_channel(EVENTS);
    let settings = Settings {
        listen: arguments.listen,
        token: arguments.token.clone(),
        page: page::served(subject),
    };
    let stop = Arc::clone(stop);
    let server = Server::start(settings, |_| Inbox { events, stop })?;
    let told = format!("{name}: {}\n", server.url());
    Ok(Served {
        server,
        to_hear,
        told,
    })
}
