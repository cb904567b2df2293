//! CSV output of a run, one row per tick.

use std::io::Write;
use std::path::Path;

use crate::commands::print::nearest_nanosecond;
use dashpot_files::FileError;
use dashpot_files::output::cannot_write_rows;
use dashpot_host_link::{Event, TickRecord};

/// Writer of the rows of a run.
pub(super) struct Rows<'a> {
    path: &'a Path,
    rows: csv::Writer<&'a mut dyn Write>,
    start_s: f64,
    step_s: f64,
}

impl<'a> Rows<'a> {
    /// Writes the header for `places` slots to `file` at `path`; tick 1 is at `start_s` (s).
    pub(super) fn new(
        path: &'a Path,
        file: &'a mut dyn Write,
        places: usize,
        start_s: f64,
        step_s: f64,
    ) -> Result<Self, FileError> {
        let mut rows = csv::Writer::from_writer(file);
        let of_slots = (0..places).flat_map(|slot| {
            ["displacement_m", "target_force_n", "host_force_n", "status"]
                .map(|name| format!("{name}_{slot}"))
        });
        let before = ["tick", "time_s"].map(String::from);
        let after = ["clock_ticks", "round_trip_ns", "event"].map(String::from);
        rows.write_record(before.into_iter().chain(of_slots).chain(after))
            .map_err(|error| cannot_write_rows(path, error))?;
        Ok(Self {
            path,
            rows,
            start_s,
            step_s,
        })
    }

    pub(super) fn write(&mut self, record: &TickRecord<'_>) -> Result<(), FileError> {
        let time_s = self.start_s + f64::from(record.tick - 1) * self.step_s;
        let places: Vec<(f32, f32, f32, u16)> = (0..record.displacements_m.len())
            .map(|place| {
                (
                    record.displacements_m[place],
                    record.target_forces_n[place],
                    record.host_forces_n[place],
                    record.target_status[place],
                )
            })
            .collect();
        let events: Vec<String> = record.events.iter().map(Event::to_string).collect();
        self.rows
            .serialize((
                record.tick,
                nearest_nanosecond(time_s),
                places,
                record.clock_ticks,
                record.round_trip_ns,
                events.join(" "),
            ))
            .map_err(|error| cannot_write_rows(self.path, error))
    }

    /// Flushes all rows.
    pub(super) fn finish(mut self) -> Result<(), FileError> {
        self.rows
            .flush()
            .map_err(|error| cannot_write_rows(self.path, error.into()))
    }
}
