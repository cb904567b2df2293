//! Reasons to doubt a recording, in words.

use dashpot_recording::{Gaps, Interpolation, UnfinishedEnd};

use super::rounded::{counted, six_digits};

/// Returns the reasons to doubt a recording, a sentence each without a full stop. Gaps do not, because they separate
/// motions.
pub fn doubts(gaps: &Gaps) -> Vec<String> {
    let left_out = (gaps.left_out.rows > 0).then(|| {
        let rows = counted(gaps.left_out.rows, "row");
        format!("omitted {rows} with a missing value")
    });
    let doubts = [
        left_out,
        gaps.unended_line.map(unended),
        gaps.unfinished.map(unfinished),
        gaps.interpolation.as_ref().map(interpolated),
    ];
    doubts.into_iter().flatten().collect()
}

/// Returns the warning for a text file whose last line has no line end.
pub fn unended(line: u64) -> String {
    format!(
        "the last line, line {line}, has no line end: the file may have been cut off inside its last number"
    )
}

/// Returns the warning for an MDF4 file that its logger did not finish.
pub fn unfinished(end: UnfinishedEnd) -> String {
    let rest = match end.left_bytes {
        0 => String::new(),
        bytes => format!("; {} after it cannot be read", counted(bytes, "byte")),
    };
    format!(
        "the logger did not finish this MDF4 file: rows are read up to the last whole one{rest}"
    )
}

/// Returns the warning for a force from another group than the displacement.
pub fn interpolated(interpolation: &Interpolation) -> String {
    let Interpolation {
        displacement_group,
        force_group,
        outside,
        left_out,
        longest_interval_s,
    } = interpolation;
    let mut warning = format!(
        "the force (group {force_group}) is interpolated linearly to the times of the displacement (group \
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
