//! Remedies for errors, as data. The library does not know the options of a command or the arguments of Python, so each
//! front end puts the remedy into its own words.

use crate::Quantity;

/// Action with which the user can resolve an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// Choose the channel of the quantity by name or number.
    NameChannel(Quantity),
    /// Choose the channel of the quantity by number and give its unit, because the channels have no names.
    NumberChannel {
        /// Quantity that the channel measures.
        quantity: Quantity,
        /// Number of channels in the file.
        count: usize,
    },
    /// Give the unit of the quantity.
    GiveUnit(Quantity),
    /// Give a unit that replaces the one stated in the file.
    OverrideUnit(Quantity),
    /// Choose the channel group by name or number.
    NameGroup,
    /// Say whether the first row contains column names.
    SayWhetherHeader,
    /// Give the decimal mark.
    GiveDecimalMark,
    /// Skip rows with missing values.
    SkipInvalid,
    /// Skip the lines of a title before the header.
    SkipLines,
    /// Skip this number of lines before the header.
    SkipTitle {
        /// Number of lines before the header.
        lines: u64,
    },
}
