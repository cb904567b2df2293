//! Printing of command reports.

use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use anstream::stream::{AsLockedWrite, RawStream};
use anstream::{AutoStream, ColorChoice};
use serde::Serialize;

use super::arguments::Format;
use super::failure::{Failure, Outcome};
use dashpot_files::input;
pub(super) use dashpot_files::nearest_nanosecond;
use dashpot_files::output::{cannot_write, write_whole};
pub(super) use dashpot_report::rounded::counted;
use dashpot_report::verdict;

/// True if the user asked for no reports (`--quiet`).
static IS_QUIET: AtomicBool = AtomicBool::new(false);

/// Leaves out text reports, notes and progress from now on.
pub fn be_quiet() {
    IS_QUIET.store(true, Ordering::Relaxed);
}

/// True after [`be_quiet`].
pub(super) fn is_quiet() -> bool {
    IS_QUIET.load(Ordering::Relaxed)
}

/// Prints `report` to standard output: as text, using `text`, or as one JSON object. A quiet command prints no text.
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
    match format {
        Format::Text if is_quiet() => Ok(()),
        _ => print_answer(format, report, text),
    }
}

/// Like [`print_report`], but prints what the user asked for, such as a list, even if the command is quiet.
///
/// # Errors
/// Standard output cannot be written.
pub fn print_answer<R: Serialize>(
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
    if !input::is_standard_stream(data) {
        print_report(format, report, text)
    } else if is_quiet() && format == Format::Text {
        Ok(())
    } else {
        print_to(io::stderr().lock(), "standard error", format, report, text)
    }
}

/// Prints a note or warning to standard error, unless the command is quiet.
pub(super) fn print_note(text: &str) {
    if !is_quiet() {
        print_line(text);
    }
}

/// Prints the error that ends the command to standard error.
pub fn print_error(failure: &Failure) {
    print_line(&format!("error: {failure}"));
}

/// If standard error is closed, there is nothing left to do.
fn print_line(text: &str) {
    let stream = io::stderr().lock();
    let colours = has_colours(&stream);
    let _ = verdict::print(stream, colours, |out| writeln!(out, "{text}"));
}

/// True for a terminal with colours, according to `NO_COLOR`, `CLICOLOR`, `CLICOLOR_FORCE` and `TERM`.
fn has_colours(stream: &impl RawStream) -> bool {
    AutoStream::choice(stream) != ColorChoice::Never
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
    stream: impl RawStream + AsLockedWrite,
    name: &str,
    format: Format,
    report: &R,
    text: impl FnOnce(&mut dyn Write, &R) -> io::Result<()>,
) -> Outcome<()> {
    let printed = match format {
        Format::Text if has_colours(&stream) => {
            let out = BufWriter::new(AutoStream::always(stream));
            verdict::print(out, true, |out| text(out, report))
        }
        Format::Text => {
            let out = BufWriter::new(stream);
            verdict::print(out, false, |out| text(out, report))
        }
        Format::Json => {
            let mut out = BufWriter::new(stream);
            serde_json::to_writer_pretty(&mut out, report)
                .map_err(io::Error::from)
                .and_then(|()| writeln!(out))
                .and_then(|()| out.flush())
        }
    };
    match printed {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::new(format!("{name}: {error}")))
        }
        _ => Ok(()),
    }
}
