//! A file whose channels are known.

use dashpot_files::FileError;

use super::rows::Source;
use super::select::Found;

/// A file whose channels are known.
pub(super) trait Opened {
    /// The channels.
    fn found(&self) -> &[Found];

    /// Names of the groups that they are in; none where the file has no groups.
    fn groups(&self) -> &[String];

    /// Rows of the channels of these indices, which are of one group; text has its rows once. What is no number is an error
    /// unless `lenient`, where it counts as missing.
    fn rows(&mut self, indices: &[usize], lenient: bool) -> Result<Box<dyn Source>, FileError>;
}
