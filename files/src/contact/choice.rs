//! A profile by name, with the options for reading its file.

use std::str::FromStr;

use dashpot_rail::profile::Body;
use dashpot_rail::profile::measured::{Format, Mirror, Options};

use super::SharedProfile;
use super::error::ContactError;
use crate::profile;

/// Keys of a profile and of its options, for error messages.
#[derive(Debug, Clone, Copy)]
pub(super) struct ChoiceKeys {
    pub profile: &'static str,
    pub format: &'static str,
    pub mirror: &'static str,
    pub smoothing_m: &'static str,
}

/// A profile by name, with the options for reading its file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Choice<'a> {
    pub keys: ChoiceKeys,
    /// Name or file; `None` for the built-in profile.
    pub name: Option<&'a str>,
    pub format: Option<&'a str>,
    pub mirror: Option<&'a str>,
    pub smoothing_m: Option<f64>,
}

impl Choice<'_> {
    /// Loads the profile of `body`; `None` if no name is given.
    ///
    /// # Errors
    /// An option without a profile, an unknown word, or an unknown or invalid profile.
    pub fn load(&self, body: Body) -> Result<Option<SharedProfile>, ContactError> {
        let Some(name) = self.name else {
            let given = [
                (self.keys.format, self.format.is_some()),
                (self.keys.mirror, self.mirror.is_some()),
                (self.keys.smoothing_m, self.smoothing_m.is_some()),
            ];
            return match given.iter().find(|(_, is_given)| *is_given) {
                Some((key, _)) => {
                    let reason = format!(
                        "there is no profile to read, allowed: with {}",
                        self.keys.profile
                    );
                    Err(ContactError::other(key, reason))
                }
                None => Ok(None),
            };
        };
        let mut options = Options::new()
            .with_format(word::<Format>(self.keys.format, self.format)?)
            .with_mirror(word::<Mirror>(self.keys.mirror, self.mirror)?);
        if let Some(smoothing_m) = self.smoothing_m {
            options = options.with_smoothing_m(smoothing_m);
        }
        let is_built_in = |known: &str| name.eq_ignore_ascii_case(known);
        let is_plain = self.format.is_none() && self.mirror.is_none() && self.smoothing_m.is_none();
        let shared = match body {
            Body::Wheel if is_plain && is_built_in("s1002") => SharedProfile::s1002(),
            Body::Rail if is_plain && is_built_in("uic60") => SharedProfile::uic60(),
            _ => {
                let loaded = profile::load(name, body, &options);
                let (profile, _) =
                    loaded.map_err(|error| ContactError::new(self.keys.profile, error))?;
                SharedProfile::new(profile)
            }
        };
        Ok(Some(shared))
    }
}

/// Parses an optional word.
fn word<T: FromStr<Err: ToString>>(
    key: &'static str,
    word: Option<&str>,
) -> Result<Option<T>, ContactError> {
    let parsed = word.map(T::from_str).transpose();
    parsed.map_err(|error| ContactError::other(key, error.to_string()))
}
