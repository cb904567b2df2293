//! Measurement of a run by XCP.

use std::net::SocketAddr;
use std::path::Path;
use std::sync::Arc;

use dashpot_host_link::TickRecord;
use dashpot_host_link::a2l::{Description, Measurement};
use dashpot_host_link::xcp::{Feed, Fixed, Gate, Summary};

use crate::commands::failure::Outcome;
use crate::commands::print::{nearest_nanosecond, print_note};
use crate::commands::xcp::{Served, bind};

/// Name, words and unit of the signals of a run.
const OF_RUN: [(&str, &str, &str); 4] = [
    ("tick", "tick", "1"),
    ("time_s", "time", "s"),
    ("clock_ticks", "clock of the target for the whole bank", "1"),
    ("round_trip_ns", "round trip of the request", "ns"),
];

/// Name, words and unit of the signals of each slot.
const OF_SLOT: [(&str, &str, &str); 4] = [
    ("displacement_m", "displacement", "m"),
    ("target_force_n", "force of the target", "N"),
    ("host_force_n", "force of this host", "N"),
    ("status", "status bits of the target", "1"),
];

/// A server that passes every signal of each tick to a tool.
pub(super) struct ServedSlots {
    served: Served,
    feed: Option<Feed>,
    values: Vec<f64>,
    start_s: f64,
    step_s: f64,
}

impl ServedSlots {
    /// Starts the server for a run whose first tick is at `start_s` (s).
    ///
    /// # Errors
    /// The address cannot be used, or the A2L file cannot be written.
    pub fn start(
        address: SocketAddr,
        slots: usize,
        [start_s, step_s]: [f64; 2],
        is_paced: bool,
        file: Option<&Path>,
    ) -> Outcome<Self> {
        let server = bind(address)?;
        let mut slave = Description::new("bank", server.address());
        slave.step_s = step_s;
        slave.measurements = measurements(slots);
        let mut served = Served::start(server, &slave, Fixed, is_paced, file)?;
        print_note(&served.note("the bank"));
        Ok(Self {
            feed: served.take_feed(),
            served,
            values: Vec::with_capacity(slave.measurements.len()),
            start_s,
            step_s,
        })
    }

    /// What the run waits for before each tick.
    pub fn gate(&self) -> Option<Arc<Gate>> {
        self.served.gate()
    }

    /// Passes the values of a tick to the server.
    pub fn record(&mut self, record: &TickRecord<'_>) {
        let time_s = self.start_s + f64::from(record.tick - 1) * self.step_s;
        let time_s = nearest_nanosecond(time_s);
        self.values.clear();
        self.values.extend([
            f64::from(record.tick),
            time_s,
            f64::from(record.clock_ticks),
            record.round_trip_ns as f64,
        ]);
        for slot in 0..record.displacements_m.len() {
            self.values.extend([
                f64::from(record.displacements_m[slot]),
                f64::from(record.target_forces_n[slot]),
                f64::from(record.host_forces_n[slot]),
                f64::from(record.target_status[slot]),
            ]);
        }
        if let Some(feed) = &self.feed {
            feed.tick(time_s, &self.values);
        }
    }

    /// Waits until the master has disconnected.
    ///
    /// # Errors
    /// The server failed.
    pub fn finish(self) -> Outcome<Summary> {
        drop(self.feed);
        self.served.finish()
    }
}

/// Signals in the order of [`ServedSlots::record`], with the names of the rows of `--output`.
fn measurements(slots: usize) -> Vec<Measurement> {
    let named = |name: String, words: String, unit: &str| Measurement {
        name,
        description: words,
        unit: unit.to_owned(),
    };
    let of_run = OF_RUN
        .iter()
        .map(|(name, words, unit)| named((*name).into(), (*words).into(), unit));
    let of_slots = (0..slots).flat_map(|slot| {
        OF_SLOT.iter().map(move |(name, words, unit)| {
            named(
                format!("{name}_{slot}"),
                format!("slot {slot}: {words}"),
                unit,
            )
        })
    });
    of_run.chain(of_slots).collect()
}
