//! Text report on gaps and doubtful rows of a recording.

use std::io::{self, Write};

use super::counted;
use dashpot_recording::{GAP_IN_MEDIANS, Gaps, RowLocation};

/// Prints warnings about omitted rows, a missing line end and gaps, if there are any.
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
        writeln!(out, "{}", unended(line))?;
    }
    let (Some(longest), Some(median_s)) = (gaps.longest, gaps.median_interval_s) else {
        return Ok(());
    };
    writeln!(
        out,
        "warning: {} in the recording (intervals over {GAP_IN_MEDIANS} times the median of {median_s} s); the longest \
         lasts {} s from {} s (before {}); the motion is interpolated linearly",
        counted(gaps.count, "gap"),
        longest.duration_s,
        longest.start_s,
        place(longest.location)
    )
}

/// Returns the warning for a text file whose last line has no line end.
pub(super) fn unended(line: u64) -> String {
    format!(
        "warning: the last line, line {line}, has no line end: the file may have been cut off inside its last number"
    )
}

fn place(place: RowLocation) -> String {
    match place {
        RowLocation::Line(line) => format!("line {line}"),
        RowLocation::Row(row) => format!("row {row}"),
    }
}
