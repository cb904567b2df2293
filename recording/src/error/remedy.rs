//! What the user can do about an error.

use super::RecordingError;
use crate::remedy::Remedy;

impl RecordingError {
    /// What the user can do about it, beyond what the text says.
    pub fn remedy(&self) -> Option<Remedy> {
        match self {
            Self::MissingChannel {
                quantity,
                numbered: true,
                found,
                ..
            } => Some(Remedy::NumberChannel {
                quantity: *quantity,
                count: found.len(),
            }),
            Self::MissingChannel { quantity, .. }
            | Self::SeveralChannels { quantity, .. }
            | Self::NoNumbers { quantity, .. }
            | Self::Width { quantity, .. }
            | Self::SameChannel {
                quantities: [_, quantity],
                ..
            }
            | Self::OtherGroup { quantity, .. } => Some(Remedy::NameChannel(*quantity)),
            Self::Group { .. } | Self::SeveralGroups { .. } => Some(Remedy::NameGroup),
            Self::NoUnit { quantity, .. } | Self::TwoUnits { quantity, .. } => {
                Some(Remedy::GiveUnit(*quantity))
            }
            Self::UnknownUnit { quantity, .. } => Some(Remedy::OverrideUnit(*quantity)),
            Self::HeaderOrRow { .. } => Some(Remedy::SayWhetherHeader),
            Self::Mark { .. } => Some(Remedy::GiveDecimalMark),
            Self::NotFinite { .. } | Self::Invalid => Some(Remedy::SkipInvalid),
            _ => None,
        }
    }
}
