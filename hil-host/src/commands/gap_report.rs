//! Text report on gaps and doubtful rows of a recording.

use std::io::{self, Write};

use super::counted;
use super::rounded::six_digits;
use dashpot_recording::{GAP_IN_MEDIANS, Gaps, Interpolation, RowLocation, UnfinishedEnd};

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
        writeln!(out, "{}", unended(line))?;
    }
    if let Some(end) = gaps.unfinished {
        writeln!(out, "{}", unfinished(end))?;
    }
    if let Some(interpolation) = &gaps.interpolation {
        writeln!(out, "{}", interpolated(interpolation))?;
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

/// Returns the warning for a text file whose last line has no line end.
pub(super) fn unended(line: u64) -> String {
    format!(
        "warning: the last line, line {line}, has no line end: the file may have been cut off inside its last number"
    )
}

/// Returns the warning for an MDF4 file that its logger did not finish.
pub(super) fn unfinished(end: UnfinishedEnd) -> String {
    let rest = match end.left_bytes {
        0 => String::new(),
        bytes => format!("; {} after it cannot be read", counted(bytes, "byte")),
    };
    format!(
        "warning: the logger did not finish this MDF4 file: rows are read up to the last whole one{rest}"
    )
}

/// Returns the warning for a force from another group than the displacement.
pub(super) fn interpolated(interpolation: &Interpolation) -> String {
    let Interpolation {
        displacement_group,
        force_group,
        outside,
        left_out,
        longest_interval_s,
    } = interpolation;
    let mut warning = format!(
        "warning: the force (group {force_group}) is interpolated linearly to the times of the displacement (group \
         {displacement_group})"
    );
    if let Some(interval_s) = longest_interval_s {
        warning += &format!(
            "; its samples are up to {} s apart",
            six_digits(*interval_s)
        );
    }
    if *outside > 0 {
        let rows = counted(*outside, "row");
        warning += &format!("; omitted {rows} before its first or after its last sample");
    }
    if *left_out > 0 {
        warning += &format!(
            "; omitted {} of the force that are missing",
            counted(*left_out, "sample")
        );
    }
    warning
}

fn place(place: RowLocation) -> String {
    match place {
        RowLocation::Line(line) => format!("line {line}"),
        RowLocation::Row(row) => format!("row {row}"),
    }
}
