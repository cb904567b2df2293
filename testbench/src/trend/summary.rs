//! Report of a fleet, as text and for programs.

use serde::Serialize;

use super::fleet::Fleet;
use super::rows::{ReadingRow, TrendRow};

/// Report of a fleet.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Number of vehicles.
    pub vehicles: usize,
    /// Number of dampers.
    pub dampers: usize,
    /// Number of recordings.
    pub recordings: usize,
    /// Number of recordings that a trend uses.
    pub recordings_used: usize,
    /// Number of recordings that cannot be read.
    pub recordings_unreadable: usize,
    /// Trends, the most urgent damper first.
    pub trends: Vec<TrendRow>,
    /// Recordings that no trend uses, with the reason.
    pub refused: Vec<ReadingRow>,
    /// Files that were written.
    pub files: Vec<String>,
    #[serde(skip)]
    table: String,
}

impl Summary {
    /// Creates the report; no file is written yet.
    pub fn new(fleet: &Fleet) -> Self {
        let mut refused = fleet.reading_rows();
        let recordings = refused.len();
        refused.retain(|row| !row.refused_because.is_empty());
        let vehicles = fleet.recorded().map(|recorded| &*recorded.listed.vehicle);
        let mut vehicles: Vec<&str> = vehicles.collect();
        vehicles.sort_unstable();
        vehicles.dedup();
        Self {
            vehicles: vehicles.len(),
            dampers: fleet.dampers.len(),
            recordings,
            recordings_used: recordings - refused.len(),
            recordings_unreadable: fleet.unreadable(),
            trends: fleet.trend_rows(),
            refused,
            files: Vec::new(),
            table: fleet.text_table(),
        }
    }

    /// Returns the report as lines of text.
    pub fn text(&self) -> String {
        let counted = |count: usize, what: &str| match count {
            1 => format!("1 {what}"),
            _ => format!("{count} {what}s"),
        };
        let mut text = format!(
            "{} of {}, {} of {} used\n\n{}",
            counted(self.dampers, "damper"),
            counted(self.vehicles, "vehicle"),
            self.recordings_used,
            counted(self.recordings, "recording"),
            self.table
        );
        for row in &self.refused {
            // Errors from reading name the file already.
            let reason = row.refused_because.strip_prefix(&row.file);
            let reason = reason.map_or(&*row.refused_because, |rest| rest.trim_start_matches(": "));
            text += &format!("note: not used: {}: {reason}\n", row.file);
        }
        for file in &self.files {
            text += &format!("wrote {file}\n");
        }
        text
    }
}
