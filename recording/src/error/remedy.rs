//! Remedies of the errors.

use std::error::Error;

use dashpot_files::FileError;

use super::RecordingError;
use crate::remedy::Remedy;

/// Maximum number of lines of a title before the header.
const MAX_TITLE_LINES: u64 = 30;

impl RecordingError {
    /// Returns the remedy for the error; the error text does not include it.
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
                second: quantity, ..
            }
            | Self::OtherGroup { quantity, .. } => Some(Remedy::NameChannel(*quantity)),
            Self::Group { .. } | Self::SeveralGroups { .. } => Some(Remedy::NameGroup),
            Self::NoUnit { quantity, .. } | Self::TwoUnits { quantity, .. } => {
                Some(Remedy::GiveUnit(*quantity))
            }
            Self::UnknownUnit { quantity, .. } => Some(Remedy::OverrideUnit(*quantity)),
            Self::Title { lines, .. } => Some(Remedy::SkipTitle { lines: *lines }),
            Self::HeaderOrRow { .. } => Some(Remedy::SayWhetherHeader),
            Self::Mark { .. } => Some(Remedy::GiveDecimalMark),
            // A title was taken for the header. Further down, a longer line is damage.
            Self::Cells {
                line,
                cells,
                expected,
                ..
            } if cells > expected && *line <= MAX_TITLE_LINES => Some(Remedy::SkipLines),
            Self::NotFinite { .. } | Self::Invalid => Some(Remedy::SkipInvalid),
            _ => None,
        }
    }
}

/// Returns the remedy if `error` contains a [`RecordingError`] that has one.
pub fn remedy(error: &FileError) -> Option<Remedy> {
    let source: &(dyn Error + Send + Sync) = match error {
        FileError::Content { source, .. }
        | FileError::Line { source, .. }
        | FileError::Cell { source, .. }
        | FileError::Row { source, .. } => source.as_ref(),
        _ => return None,
    };
    source.downcast_ref::<RecordingError>()?.remedy()
}

#[cfg(test)]
mod tests {
    use super::{MAX_TITLE_LINES, RecordingError, Remedy};
    use crate::Separator;

    #[test]
    fn only_longer_lines_near_the_top_follow_a_title() {
        let remedy = |line, cells| {
            let error = RecordingError::Cells {
                line,
                cells,
                expected: 2,
                separator: Separator::Semicolon,
            };
            error.remedy()
        };
        assert_eq!(remedy(3, 3), Some(Remedy::SkipLines));
        assert_eq!(remedy(3, 1), None);
        assert_eq!(remedy(MAX_TITLE_LINES + 1, 3), None);
    }
}
