//! Text report on gaps and doubtful rows of a recording.

use std::io::{self, Write};

use super::counted;
use dashpot_recording::{GAP_IN_MEDIANS, Gaps, RowLocation};
pub(super) use dashpot_report::doubts::{interpolated, unended, unfinished};

/// Prints warnings about omitted rows, an uncertain end of the file and gaps, if there are any.
pub(super) fn write_gaps(out: &mut dyn Write, gaps: &Gaps) -> io::Result<()> {
    if let Some(first) = gaps.left_out.first {
        writeln!(
            out,
            "warning: omitted {} with a missing value, the first at {}; the motion is interpolated linearly",
            counted(gaps.left_out.rows, "row"),
            place(first)
        )?;
    }
    if let Some(line) = gaps.unended_line {
        writeln!(out, "warning: {}", unended(line))?;
    }
    if let Some(end) = gaps.unfinished {
        writeln!(out, "warning: {}", unfinished(end))?;
    }
    if let Some(interpolation) = &gaps.interpolation {
        writeln!(out, "warning: {}", interpolated(interpolation))?;
    }
    let (Some(longest), Some(median_s)) = (gaps.longest, gaps.median_interval_s) else {
        return Ok(());
    };
    writeln!(
        out,
        "warning: {} in the recording (intervals over {GAP_IN_MEDIANS} times the median of {median_s} s); the longest \
         lasts {} s and begins at {} s (before {}); the motion is interpolated linearly",
        counted(gaps.count, "gap"),
        longest.duration_s,
        longest.start_s,
        place(longest.location)
    )
}

fn place(place: RowLocation) -> String {
    match place {
        RowLocation::Line(line) => format!("line {line}"),
        RowLocation::Row(row) => format!("row {row}"),
    }
}
