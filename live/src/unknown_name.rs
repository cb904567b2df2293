//! A name that does not exist, with the nearest one.

use dashpot_files::did_you_mean;

/// A name that does not exist.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no {kind} `{name}`{near}; allowed: {allowed}")]
pub struct UnknownName {
    /// What is named.
    pub kind: &'static str,
    /// Name that was given.
    pub name: String,
    /// Suggestion with the nearest name, or empty.
    pub near: String,
    /// All names.
    pub allowed: String,
}

impl UnknownName {
    pub(crate) fn new<'a>(
        kind: &'static str,
        name: &str,
        names: impl Iterator<Item = &'a str> + Clone,
    ) -> Self {
        Self {
            kind,
            name: name.to_owned(),
            near: did_you_mean(name, names.clone()),
            allowed: names.collect::<Vec<_>>().join(", "),
        }
    }
}
