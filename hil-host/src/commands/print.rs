//! Printing of a command's report.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use serde::Serialize;

use super::arguments::Format;
use super::failure::{Failure, Outcome};
use dashpot_files::input;
pub(super) use dashpot_files::nearest_nanosecond;

/// `1 tick`, `2 ticks`.
pub(super) fn counted(count: u64, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Prints `report` on standard output in `format`: what `text` writes, or one JSON object.
/// A reader that has left, such as `head`, is no failure.
///
/// # Errors
/// Standard output cannot be written.
pub fn print_report<R: Serialize>(
    format: Format,
    report: &R,
    text: impl FnOnce(&mut dyn Write, &R) -> io::Result<()>,
) -> Outcome<()> {
    print_to(io::stdout().lock(), "standard output", format, report, text)
}

/// As [`print_report`], on standard error when the data itself went to standard output as `data`.
///
/// # Errors
/// The stream cannot be written.
pub fn print_report_beside<R: Serialize>(
    data: &Path,
    format: Format,
    report: &R,
    text: impl FnOnce(&mut dyn Write, &R) -> io::Result<()>,
) -> Outcome<()> {
    if input::is_standard_stream(data) {
        print_to(io::stderr().lock(), "standard error", format, report, text)
    } else {
        print_report(format, report, text)
    }
}

fn print_to<R: Serialize>(
    stream: impl Write,
    name: &str,
    format: Format,
    report: &R,
    text: impl FnOnce(&mut dyn Write, &R) -> io::Result<()>,
) -> Outcome<()> {
    let mut out = BufWriter::new(stream);
    let printed = match format {
        Format::Text => text(&mut out, report),
        Format::Json => serde_json::to_writer_pretty(&mut out, report)
            .map_err(io::Error::from)
            .and_then(|()| writeln!(out)),
    };
    match printed.and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::new(format!("{name}: {error}")))
        }
        _ => Ok(()),
    }
}
