//! The files of an export in each language.

use std::path::{Path, PathBuf};

use dashpot_export::constant_name;
use dashpot_files::output::write_together;
use pyo3::prelude::*;

use super::own_name;
use crate::damper::Damper;
use crate::error::{Outcome, refuse};
use crate::overrides::path_of_file;

/// Language of an exported constant.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Language {
    Rust,
    C,
    Bin,
}

/// Name, language and file of an exported constant.
pub struct Constant {
    pub name: String,
    pub language: Language,
    pub output: PathBuf,
    /// Header of C source.
    header: Option<PathBuf>,
}

impl Constant {
    /// The constant of a damper; its default name is the damper's in capitals, followed by `end`.
    pub fn new(
        damper: &Damper,
        output: &Bound<'_, PyAny>,
        lang: &str,
        name: Option<String>,
        end: &str,
    ) -> Outcome<Self> {
        let language = match lang {
            "rust" => Language::Rust,
            "c" => Language::C,
            "bin" => Language::Bin,
            other => return refuse(format!("lang: `{other}`, allowed: `rust`, `c` or `bin`")),
        };
        if let (Some(name), Language::Bin) = (&name, language) {
            return refuse(format!(
                "name: `{name}`, but bytes have no name; allowed with lang=\"rust\" or \"c\""
            ));
        }
        let output = path_of_file(output)?;
        let header = (language == Language::C).then(|| output.with_extension("h"));
        if header.as_ref() == Some(&output) {
            return refuse("output: the name of the header, allowed: another one, such as x.c");
        }
        Ok(Self {
            name: name.unwrap_or_else(|| constant_name(own_name(damper)) + end),
            language,
            output,
            header,
        })
    }

    /// Language as the caller wrote it.
    pub fn lang(&self) -> &'static str {
        match self.language {
            Language::Rust => "rust",
            Language::C => "c",
            Language::Bin => "bin",
        }
    }

    /// Argument `name` of a call that repeats the export, if it has one.
    pub fn name_argument(&self) -> String {
        match self.language {
            Language::Bin => String::new(),
            Language::Rust | Language::C => format!(", name=\"{}\"", self.name),
        }
    }

    /// Name of the header's file, which C source includes.
    pub fn included(&self) -> Option<String> {
        let name = self.header.as_deref().and_then(Path::file_name);
        name.map(|name| name.to_string_lossy().into_owned())
    }

    /// Writes the file and, for C, what `header` returns; returns the files.
    pub fn write(
        self,
        content: &[u8],
        header: impl FnOnce() -> Outcome<String>,
    ) -> Outcome<Vec<PathBuf>> {
        let Some(beside) = self.header else {
            write_together(&[(&self.output, content)])?;
            return Ok(vec![self.output]);
        };
        write_together(&[(&self.output, content), (&beside, header()?.as_bytes())])?;
        Ok(vec![self.output, beside])
    }
}
