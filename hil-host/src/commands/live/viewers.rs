//! Viewers in a report.

use std::io::{self, Write};

use dashpot_server::ViewerCount;
use serde::Serialize;

use crate::commands::counted;

/// Viewers of a run.
#[derive(Serialize)]
pub(super) struct Viewers {
    came: u64,
    most_at_once: u64,
    lost_frames: u64,
}

impl From<ViewerCount> for Viewers {
    fn from(count: ViewerCount) -> Self {
        Self {
            came: count.came,
            most_at_once: count.most,
            lost_frames: count.lost_frames,
        }
    }
}

impl Viewers {
    /// Prints them as text.
    pub fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        let Self {
            came, most_at_once, ..
        } = self;
        let lost = counted(self.lost_frames, "frame");
        writeln!(
            out,
            "viewers: {came} came, at most {most_at_once} at once; {lost} lost by slow viewers"
        )
    }
}
