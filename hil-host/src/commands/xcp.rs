//! A server of XCP beside a run.

use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use dashpot_files::output::write_bytes;
use dashpot_host_link::a2l::{self, Description};
use dashpot_host_link::xcp::{Feed, Gate, Image, Pacing, Parameters, Running, Server, Summary};

use super::failure::{Failure, Outcome};
use super::interruption;

/// Address without a value of `--xcp`: that of the standard's examples, on this machine only.
pub(super) const DEFAULT: &str = "127.0.0.1:5555";

/// A server that runs.
pub(super) struct Served {
    address: SocketAddr,
    feed: Option<Feed>,
    running: Running,
    gate: Option<Arc<Gate>>,
    file: Option<PathBuf>,
}

/// Binds the sockets of `--xcp`.
///
/// # Errors
/// The address cannot be used.
pub(super) fn bind(address: SocketAddr) -> Outcome<Server> {
    Server::bind(address).map_err(|error| Failure::new(format!("--xcp {address}: {error}")))
}

/// True if only this machine reaches an address, so that a master may calibrate.
pub(super) fn may_calibrate(address: SocketAddr) -> bool {
    address.ip().is_loopback()
}

impl Served {
    /// Starts a server, and writes the A2L file to `file` if there is one.
    ///
    /// # Errors
    /// The file cannot be written, or the system starts no thread.
    pub(super) fn start(
        server: Server,
        slave: &Description,
        parameters: impl Parameters + 'static,
        is_realtime: bool,
        file: Option<&Path>,
    ) -> Outcome<Self> {
        if let Some(file) = file {
            write_bytes(file, a2l::write(slave).as_bytes())?;
        }
        let address = server.address();
        let gate = (!is_realtime).then(Arc::<Gate>::default);
        let pacing = gate.clone().map_or(Pacing::Realtime, Pacing::Virtual);
        let image = Image::new(slave, parameters);
        let wanted: fn() -> bool = interruption::is_wanted;
        let started = server.start(image, pacing, slave.step_s, wanted);
        let (feed, running) =
            started.map_err(|error| Failure::new(format!("--xcp {address}: {error}")))?;
        Ok(Self {
            address,
            feed: Some(feed),
            running,
            gate,
            file: file.map(Path::to_owned),
        })
    }

    /// Describes how to reach the server of `what` runs.
    pub(super) fn note(&self, what: &str) -> String {
        let rights = match may_calibrate(self.address) {
            true => "",
            false => ", read-only because others may reach this address",
        };
        let waits = match self.gate {
            Some(_) => format!("; {what} runs while a master measures"),
            None => String::new(),
        };
        let file = self.file.as_ref();
        let file = file.map_or(String::new(), |file| {
            format!("; A2L file {}", file.display())
        });
        format!(
            "note: XCP on {} (UDP and TCP){rights}{waits}{file}",
            self.address
        )
    }

    /// Address of both sockets.
    pub(super) fn address(&self) -> SocketAddr {
        self.address
    }

    /// The A2L file.
    pub(super) fn file(&self) -> Option<&Path> {
        self.file.as_deref()
    }

    /// What the run waits for before each tick; `None` in real time.
    pub(super) fn gate(&self) -> Option<Arc<Gate>> {
        self.gate.clone()
    }

    /// Returns the end for the thread that follows the run. Dropping it ends the server.
    pub(super) fn take_feed(&mut self) -> Option<Feed> {
        self.feed.take()
    }

    /// Waits until the master has disconnected.
    ///
    /// # Errors
    /// The server failed.
    pub(super) fn finish(mut self) -> Outcome<Summary> {
        self.feed = None;
        let summary = self.running.finish();
        summary.map_err(|error| Failure::new(error.to_string()))
    }
}
