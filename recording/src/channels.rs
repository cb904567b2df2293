//! Selection of the channels of a recording.

use super::text_options::TextOptions;
use super::unit::{Quantity, Unit};

/// Selection of the channels of a file, and options for reading them. By default the channels are `time_s`,
/// `displacement_m` and `force_n`, or channels whose names consist of the quantity and its unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Channels {
    /// Time. If its name is `None`, an MDF4 file uses the master channel of the group.
    pub time: Channel,
    /// Relative displacement of the damper's two ends.
    pub displacement: Channel,
    /// Force.
    pub force: Channel,
    /// Name or number (from 1) of the MDF4 group that contains the channels.
    pub group: Option<String>,
    /// If true, omits rows with a missing value: an empty cell, a null, a sample marked invalid, or a value that is not
    /// finite. Otherwise such rows are errors. Omitted rows can create gaps.
    pub skip_invalid: bool,
    /// Options for text files.
    pub text: TextOptions,
}

/// Selection of one channel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Channel {
    /// Name in the file, with or without its unit, or number from 1. If a channel has the name `2`, write the number as
    /// `#2`.
    pub name: Option<String>,
    /// Unit; replaces the unit stated in the file.
    pub unit: Option<Unit>,
    /// True if positive values in the file mean compression.
    pub reversed: bool,
}

impl Channels {
    /// Returns the channel of a quantity.
    pub fn channel(&self, quantity: Quantity) -> &Channel {
        match quantity {
            Quantity::Time => &self.time,
            Quantity::Displacement => &self.displacement,
            Quantity::Force => &self.force,
        }
    }
}
