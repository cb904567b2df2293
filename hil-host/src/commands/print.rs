//! Printing of command reports.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use serde::Serialize;

use super::arguments::Format;
use super::failure::{Failure, Outcome};
use dashpot_files::input;
pub(super) use dashpot_files::nearest_nanosecond;
use dashpot_files::output::{cannot_write, write_whole};

/// Formats a count with its noun: `1 tick`, `2 ticks`.
pub(super) fn counted(count: u64, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Prints `report` to standard output: as text, using `text`, or as one JSON object.
///
/// A closed pipe (for example `head`) is not an error.
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

/// Like [`print_report`], but prints to standard error if `data` is standard output.
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

/// Prints a text that is data, such as a file, to standard output.
///
/// # Errors
/// Standard output cannot be written.
pub(super) fn print_data(text: &[u8]) -> Outcome<()> {
    let out = Path::new("-");
    write_whole(out, |file| {
        let written = file.write_all(text);
        Ok(written.map_err(|error| cannot_write(out, error))?)
    })
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
