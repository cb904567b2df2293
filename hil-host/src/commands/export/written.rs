//! Writing of an exported file and, for C source, its header.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::{ExportArguments, Language};
use crate::commands::failure::{Failure, Outcome};
use dashpot_export::ExportError;
use dashpot_files::output::{self, is_replaceable, write_bytes, write_together};

/// Names of the constant and the written files.
#[derive(Serialize)]
pub(super) struct Exported {
    /// Name of the constant; `None` for bytes only.
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    output: String,
    /// Header file, if C source is written to a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    header: Option<String>,
}

impl Exported {
    /// Writes the text that `content` returns; it receives the name of the header to include. For C source in a file,
    /// also writes the header.
    ///
    /// # Errors
    /// The constant cannot be exported or a file cannot be written. Neither file is written then.
    pub(super) fn write(
        arguments: &ExportArguments,
        name: Option<String>,
        content: impl FnOnce(Option<&str>) -> Result<Vec<u8>, ExportError>,
        header: impl FnOnce() -> Result<String, ExportError>,
    ) -> Outcome<Self> {
        let path = &arguments.output;
        let beside = (arguments.lang == Language::C && is_replaceable(path))
            .then(|| header_beside(path))
            .transpose()?;
        let included = beside.as_deref().and_then(Path::file_name);
        let included = included.map(|name| name.to_string_lossy());
        let content = content(included.as_deref())?;
        match &beside {
            Some(beside) => {
                write_together(&[(path, &content), (beside, header()?.as_bytes())])?;
            }
            None => write_bytes(path, &content)?,
        }
        Ok(Self {
            name,
            output: output::name(path).display().to_string(),
            header: beside.map(|header| header.display().to_string()),
        })
    }

    /// Prints the names at the beginning of a report.
    ///
    /// # Errors
    /// The output cannot be written.
    pub(super) fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        if let Some(name) = &self.name {
            write!(out, "{name} in ")?;
        }
        write!(out, "{}", self.output)?;
        match &self.header {
            Some(header) => write!(out, ", declared in {header}"),
            None => Ok(()),
        }
    }
}

/// Returns the path of the header: `folder/x.h` for `folder/x.c`.
fn header_beside(source: &Path) -> Outcome<PathBuf> {
    let header = source.with_extension("h");
    if header == source {
        return Err(Failure::wrong_use(format!(
            "--output {}: this is the name of the header; allowed with --lang c: another extension, such as .c",
            source.display()
        )));
    }
    Ok(header)
}
