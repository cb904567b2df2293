//! Measurement and calibration of a running vehicle by XCP.

mod pages;
mod report;
mod slot;
mod stepping;

use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError};

use dashpot_files::case::Case;
use dashpot_host_link::a2l::{Description, Measurement};
use dashpot_host_link::xcp::{Feed, Fixed};
use dashpot_live::{ActionError, SignalWords};
use dashpot_vehicle_run::Run;

use crate::commands::failure::{Failure, Outcome};
use crate::commands::vehicle::drive::Exchange;
use crate::commands::xcp::{Served, bind, may_calibrate};
use pages::{Changes, DamperPages, PAGES};
pub(super) use report::XcpReport;
use slot::Slot;
use stepping::Stepping;

/// Name of the A2L file.
const A2L: &str = "xcp.a2l";

/// A run, and what a master must know of it.
pub(super) struct Measured<'a> {
    pub(super) case: &'a Case,
    pub(super) run: &'a Run,
    /// Names of the values of a tick.
    pub(super) names: &'a [String],
    /// Dampers that are not simulated within the vehicle.
    pub(super) external: &'a [usize],
    pub(super) is_realtime: bool,
}

/// A server with what it passes to the thread that steps.
pub(super) struct Xcp {
    served: Served,
    slot: Arc<Slot>,
    changes: Changes,
}

impl Xcp {
    /// Starts the server and writes the A2L file into `folder`. On another address than that of this machine, nothing
    /// can be calibrated.
    ///
    /// # Errors
    /// The address cannot be used, or the file cannot be written.
    pub(super) fn start(address: SocketAddr, measured: &Measured, folder: &Path) -> Outcome<Self> {
        let server = bind(address)?;
        let Measured { case, run, .. } = *measured;
        let mut slave = Description::new(&case.name, server.address());
        slave.step_s = case.step_s;
        slave.measurements = measured.names.iter().map(|name| described(name)).collect();
        let (slot, changes) = (Arc::new(Slot::default()), Changes::default());
        let (file, is_realtime) = (folder.join(A2L), measured.is_realtime);
        let served = match may_calibrate(server.address()) {
            true => {
                let pages = DamperPages::new(case, run, measured.external, &slot, &changes);
                let refused = |error: ActionError| Failure::new(format!("{}: {error}", case.name));
                let (pages, parameters) = pages.map_err(refused)?;
                slave.parameters = parameters;
                slave.pages = PAGES.to_vec();
                Served::start(server, &slave, pages, is_realtime, Some(&file))?
            }
            false => Served::start(server, &slave, Fixed, is_realtime, Some(&file))?,
        };
        Ok(Self {
            served,
            slot,
            changes,
        })
    }

    /// Describes how to reach the server.
    pub(super) fn note(&self) -> String {
        self.served.note("the vehicle")
    }

    /// The A2L file.
    pub(super) fn file(&self) -> Option<PathBuf> {
        self.served.file().map(Path::to_owned)
    }

    /// Returns the end for the thread that follows the run. Dropping it ends the server.
    pub(super) fn take_feed(&mut self) -> Option<Feed> {
        self.served.take_feed()
    }

    /// Wraps the exchange of the thread that steps.
    pub(super) fn stepping<'a, E: Exchange>(&self, inner: &'a mut E) -> Stepping<'a, E> {
        Stepping {
            inner,
            slot: Arc::clone(&self.slot),
            gate: self.served.gate(),
        }
    }

    /// Waits until the master has disconnected.
    ///
    /// # Errors
    /// The server failed.
    pub(super) fn finish(self) -> Outcome<XcpReport> {
        let address = self.served.address();
        let summary = self.served.finish()?;
        let changes = self.changes.lock();
        Ok(XcpReport {
            address: address.to_string(),
            is_read_only: !may_calibrate(address),
            summary,
            changes: changes.unwrap_or_else(PoisonError::into_inner).clone(),
        })
    }
}

/// Describes a signal by its name in a history.
fn described(name: &str) -> Measurement {
    let words = SignalWords::of(name);
    Measurement {
        name: name.to_owned(),
        description: words.label().to_owned(),
        unit: words.unit().to_owned(),
    }
}
