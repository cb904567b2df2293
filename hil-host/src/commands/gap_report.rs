//! Gaps of a recording in a report for people, and what else is doubtful of its rows.

use std::io::{self, Write};

use super::counted;
use dashpot_recording::{GAP_IN_MEDIANS, Gaps, RowLocation};

/// Writes how many gaps the recording has and where the longest is; nothing where there are none; the same of rows that were left out.
pub(super) fn write_gaps(out: &mut dyn Write, gaps: &Gaps) -> io::Result<()> {
    if let Some(first) = gaps.left_out.first {
        writeln!(
            out,
            "warning: {} left out that lacked a value, the first at {}; the motion is straight across",
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
        "warning: {} in the recording, over {GAP_IN_MEDIANS} times the median interval of {median_s} s; the longest \
         lasts {} s from {} s (before {}); the motion is straight across",
        counted(gaps.count, "gap"),
        longest.duration_s,
        longest.start_s,
        place(longest.location)
    )
}

/// The warning for a text whose last line has no line end.
pub(super) fn unended(line: u64) -> String {
    format!(
        "warning: line {line}, the last, has no line end: the file may have been cut inside the last number of that line"
    )
}

fn place(place: RowLocation) -> String {
    match place {
        RowLocation::Line(line) => format!("line {line}"),
        RowLocation::Row(row) => format!("row {row}"),
    }
}
