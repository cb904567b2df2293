//! An exported file, and the header beside a source in C.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::{ExportArguments, Language};
use crate::commands::failure::{Failure, Outcome};
use dashpot_export::ExportError;
use dashpot_files::output::{self, is_replaceable, write_bytes, write_together};

/// What was written.
#[derive(Serialize)]
pub(super) struct Exported {
    /// Of the constant; `None` for bytes alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    output: String,
    /// Beside a C source that is a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    header: Option<String>,
}

impl Exported {
    /// Writes what `content` gives, for the name of a header to include, and where it is C in a file, the header beside it.
    ///
    /// # Errors
    /// A constant that cannot be exported, or files that cannot be written; then neither is.
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

    /// Where what is: the first words of a report.
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

/// `folder/x.h` for `folder/x.c`.
fn header_beside(source: &Path) -> Outcome<PathBuf> {
    let header = source.with_extension("h");
    if header == source {
        return Err(Failure::wrong_use(format!(
            "--output {}: the header of the source takes this name, allowed with --lang c: another end, such as .c",
            source.display()
        )));
    }
    Ok(header)
}
