//! Starts the server of a page.

use std::io::{self, Write};
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
    told: String,
}

impl Served {
    /// Prints the address of the page.
    pub fn announce(&self) {
        // If standard error is closed, the page is served all the same.
        let _ = io::stderr().lock().write_all(self.told.as_bytes());
    }

    /// Ends the server, after all viewers have what waits for them.
    pub fn end(self) {
        // Viewers who still write must not delay the end.
        drop(self.to_hear);
        self.server.stop();
    }
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
