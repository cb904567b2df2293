//! `dashpot hybrid export`: the transfer system in portable C.

use std::path::PathBuf;

use serde::Serialize;

use crate::commands::failure::{Failure, Outcome};
use crate::commands::{Format, print_report_beside};
use dashpot_export::{transfer_header, transfer_source};
use dashpot_files::output::{self, is_replaceable, write_bytes, write_together};

/// Write the transfer system as C99 without a library, for toolchains without Rust: adaptive compensator, tracking,
/// energy, guard and motion filter.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Example:
  dashpot hybrid export --output transfer.c

Use in C (docs/hybrid.md): #include \"transfer.h\" ... transfer_tick(&system, &motion, &measured)")]
pub struct ExportArguments {
    /// Name in capitals with which all names in the source begin.
    #[arg(long, default_value = "TRANSFER")]
    name: String,
    /// File to write, with its header next to it; `-` for one source on standard output.
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Report<'a> {
    name: &'a str,
    output: String,
    /// Header, if the source is written to a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    header: Option<String>,
}

/// Writes the source and its header.
///
/// # Errors
/// The name is invalid, or a file cannot be written.
pub fn run(arguments: &ExportArguments) -> Outcome<()> {
    let (path, name) = (&arguments.output, &arguments.name);
    let command = format!(
        "dashpot hybrid export --name {name} --output '{}'",
        path.display()
    );
    let header = is_replaceable(path).then(|| path.with_extension("h"));
    if header.as_ref() == Some(path) {
        return Err(Failure::wrong_use(format!(
            "--output {}: this is the name of the header; allowed: another extension, such as .c",
            path.display()
        )));
    }
    let included = header.as_ref().and_then(|header| header.file_name());
    let included = included.map(|name| name.to_string_lossy());
    let source = transfer_source(name, &command, included.as_deref())?;
    match &header {
        Some(header) => {
            let declared = transfer_header(name, &command)?;
            write_together(&[(path, source.as_bytes()), (header, declared.as_bytes())])?;
        }
        None => write_bytes(path, source.as_bytes())?,
    }
    let report = Report {
        name,
        output: output::name(path).display().to_string(),
        header: header.map(|header| header.display().to_string()),
    };
    print_report_beside(path, arguments.format, &report, |out, report| {
        let header = report.header.as_deref();
        let declared = header.map_or(String::new(), |header| format!(", declared in {header}"));
        writeln!(out, "{} in {}{declared}", report.name, report.output)
    })
}
