//! Data selected by name: built in, or from a file.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use super::overrides::did_you_mean;
use super::{FileError, input};

/// A name that is neither built in nor a file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "{kind} `{name}`: no such {built_in} or file; give a TOML file or a {built_in}: {known}{hint}"
)]
pub struct UnknownName {
    /// Kind of data, such as `damper`.
    pub kind: &'static str,
    /// Word for a built-in item, such as `preset`.
    pub built_in: &'static str,
    /// The unknown name.
    pub name: String,
    /// Built-in names, separated by commas.
    pub known: String,
    /// Suggestion of a similar name; empty if none is similar.
    pub hint: String,
}

/// Built-in items of one kind.
pub(crate) struct Shipped {
    /// Kind of data, such as `damper`.
    pub kind: &'static str,
    /// Word for one item, such as `preset`.
    pub built_in: &'static str,
    /// Name and text of each item.
    pub texts: &'static [(&'static str, &'static str)],
}

/// Text found for a name.
pub(crate) struct Found {
    /// Name in error messages.
    pub name: String,
    /// The text.
    pub text: Cow<'static, str>,
    /// Directory to which file names in the text are relative.
    pub folder: PathBuf,
}

impl Shipped {
    /// Finds the text called `name`: a built-in one, or the file at that path (`-` for standard input).
    pub fn find<E: From<UnknownName> + From<FileError>>(&self, name: &str) -> Result<Found, E> {
        if let Some((_, text)) = self.texts.iter().find(|(shipped, _)| *shipped == name) {
            return Ok(Found {
                name: name.to_owned(),
                text: Cow::Borrowed(text),
                folder: PathBuf::new(),
            });
        }
        let path = Path::new(name);
        if !input::is_file_name(path) && !path.exists() {
            let names = || self.texts.iter().map(|(shipped, _)| *shipped);
            return Err(E::from(UnknownName {
                kind: self.kind,
                built_in: self.built_in,
                name: name.to_owned(),
                known: names().collect::<Vec<_>>().join(", "),
                hint: did_you_mean(name, names()),
            }));
        }
        Ok(Found {
            name: input::name(path).to_string_lossy().into_owned(),
            text: Cow::Owned(input::read_text(path)?),
            folder: path.parent().unwrap_or(Path::new("")).to_owned(),
        })
    }
}

/// Resolves a name that a file in `folder` contains: file names are relative to that directory, other names are built
/// in.
pub(crate) fn resolve_name(folder: &Path, name: &str) -> String {
    let path = Path::new(name);
    if input::is_standard_stream(path) {
        // Inside a file, `-` is a file name, not standard input.
        return folder.join("./-").to_string_lossy().into_owned();
    }
    if input::is_file_name(path) {
        return folder.join(path).to_string_lossy().into_owned();
    }
    name.to_owned()
}
