//! A profile that several wheels or rails share.

use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use dashpot_rail::profile::{Profile, s1002, uic60};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A profile of a wheel or rail. Copies share its points.
///
/// ```
/// use dashpot_files::contact::SharedProfile;
/// let wheel = SharedProfile::s1002();
/// assert_eq!(wheel, wheel.clone());
/// assert_ne!(wheel, SharedProfile::uic60());
/// ```
#[derive(Debug, Clone)]
pub struct SharedProfile(Arc<Profile>);

impl SharedProfile {
    /// Shares a profile.
    pub fn new(profile: Profile) -> Self {
        Self(Arc::new(profile))
    }

    /// The wheel profile S1002, built once per process.
    pub fn s1002() -> Self {
        static PROFILE: OnceLock<SharedProfile> = OnceLock::new();
        PROFILE.get_or_init(|| Self::new(s1002::profile())).clone()
    }

    /// The rail profile UIC 60, built once per process.
    pub fn uic60() -> Self {
        static PROFILE: OnceLock<SharedProfile> = OnceLock::new();
        PROFILE.get_or_init(|| Self::new(uic60::profile())).clone()
    }
}

impl Deref for SharedProfile {
    type Target = Profile;

    fn deref(&self) -> &Profile {
        &self.0
    }
}

impl PartialEq for SharedProfile {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

impl Serialize for SharedProfile {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for SharedProfile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Profile::deserialize(deserializer).map(Self::new)
    }
}
