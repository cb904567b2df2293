//! A recording file of any format, after its channels have been found.

use dashpot_files::FileError;

use super::rows::Source;
use super::select::ChannelInfo;

/// A recording file of any format, after its channels have been found.
pub(super) trait RecordingFile {
    /// Channels of the file.
    fn found(&self) -> &[ChannelInfo];

    /// Names of the channel groups; empty if the format has no groups.
    fn groups(&self) -> &[String];

    /// Returns the rows of the channels with these indices, which must be in one group. Text can be read only once.
    /// With `lenient`, cells that are not numbers count as missing; otherwise they are errors.
    fn rows(&mut self, indices: &[usize], lenient: bool) -> Result<Box<dyn Source>, FileError>;
}
