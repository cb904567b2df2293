//! Gaps of a recording in a report for people.

use std::io::{self, Write};

use super::counted;
use crate::files::recording::{GAP_IN_MEDIANS, Gaps};

/// Writes how many gaps the recording has and where the longest is; nothing where there are no gaps.
pub(super) fn write_gaps(out: &mut dyn Write, gaps: &Gaps) -> io::Result<()> {
    let (Some(longest), Some(median_s)) = (gaps.longest, gaps.median_interval_s) else {
        return Ok(());
    };
    writeln!(
        out,
        "warning: {} in the recording, over {GAP_IN_MEDIANS} times the median interval of {median_s} s; the longest \
         lasts {} s from {} s (before line {}); the motion is straight across",
        counted(gaps.count, "gap"),
        longest.duration_s,
        longest.start_s,
        longest.line
    )
}
