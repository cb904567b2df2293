//! Which channels of a file are read, and as what.

use super::text::TextOptions;
use super::unit::{Quantity, Unit};

/// Which channels of a file make a recording, and how they are understood. By default time, displacement and force are called
/// `time_s`, `displacement_m` and `force_n`, or by other names that tell the quantity and its unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Channels {
    /// Time; of an MDF4 file the master of the group, where none is named.
    pub time: Channel,
    /// Relative displacement of the seats.
    pub displacement: Channel,
    /// Force.
    pub force: Channel,
    /// Name or number, from 1, of the group of an MDF4 file that the channels are in.
    pub group: Option<String>,
    /// Leaves out rows that lack a value (an empty cell, a null, a sample marked invalid, no finite number), which a recording is else
    /// refused for; what is left out counts as a gap does.
    pub skip_invalid: bool,
    /// How text is read.
    pub text: TextOptions,
}

/// One channel.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Channel {
    /// Its name in the file, with or without the unit behind it, or its number from 1, as `2` or, where a channel is called so, `#2`.
    pub name: Option<String>,
    /// Its unit, whatever the file tells.
    pub unit: Option<Unit>,
    /// Whether positive in the file is compression.
    pub reversed: bool,
}

impl Channels {
    /// That of a quantity.
    pub fn of(&self, quantity: Quantity) -> &Channel {
        match quantity {
            Quantity::Time => &self.time,
            Quantity::Displacement => &self.displacement,
            Quantity::Force => &self.force,
        }
    }
}
