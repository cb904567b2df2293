//! What ships with the program by its name, or a file in its place.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use super::overrides::nearest;
use super::{FileError, input};

/// A name that is neither one of the program's own nor a file's.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{what} `{name}`: no such {one} or file; give a TOML file or a {one}: {known}{hint}")]
pub struct UnknownName {
    /// What was looked for.
    pub what: &'static str,
    /// What one of the program's own is called.
    pub one: &'static str,
    /// The name.
    pub name: String,
    /// Those there are.
    pub known: String,
    /// The nearest one, where one is near.
    pub hint: String,
}

/// What of a kind ships with the program.
pub(crate) struct Shipped {
    /// What they are.
    pub what: &'static str,
    /// What one of them is called.
    pub one: &'static str,
    /// Names and texts.
    pub texts: &'static [(&'static str, &'static str)],
}

/// A text found by a name.
pub(crate) struct Found {
    /// What stands for it in errors.
    pub name: String,
    pub text: Cow<'static, str>,
    /// From where the names of files in it count.
    pub folder: PathBuf,
}

impl Shipped {
    /// The text called `name`: a shipped one, or the file at that path, `-` being standard input.
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
                what: self.what,
                one: self.one,
                name: name.to_owned(),
                known: names().collect::<Vec<_>>().join(", "),
                hint: nearest(name, names()),
            }));
        }
        Ok(Found {
            name: input::name(path).to_string_lossy().into_owned(),
            text: Cow::Owned(input::read_text(path)?),
            folder: path.parent().unwrap_or(Path::new("")).to_owned(),
        })
    }
}

/// `name` as it stands in a file of `folder`: a file's name counts from there, any other is one of the program's own.
pub(crate) fn named_in(folder: &Path, name: &str) -> String {
    let path = Path::new(name);
    if input::is_standard_stream(path) {
        // Only a command line can mean standard input.
        return folder.join("./-").to_string_lossy().into_owned();
    }
    if input::is_file_name(path) {
        return folder.join(path).to_string_lossy().into_owned();
    }
    name.to_owned()
}
