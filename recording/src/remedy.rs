//! What a user can do about an error, as data: an error of the library names no option of the command and no argument
//! of Python. Each front end says the remedy in its own words (`commands::remedy`, `remedy.rs` of the package for
//! Python).

use std::error::Error;

use dashpot_files::FileError;

use crate::{Quantity, RecordingError};

/// What a user can do about an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// Name the channel of the quantity, by its name or its number.
    NameChannel(Quantity),
    /// Choose the channel of the quantity by its number and give its unit: the channels have no names.
    NumberChannel {
        /// What the channel measures.
        quantity: Quantity,
        /// How many channels there are.
        count: usize,
    },
    /// Give the unit of the quantity.
    GiveUnit(Quantity),
    /// Give the unit of the quantity, in place of the one that the file names.
    OverrideUnit(Quantity),
    /// Name the group of the channels, by its name or its number.
    NameGroup,
    /// Say whether the first row has the names of the columns.
    SayWhetherHeader,
    /// Give the decimal mark of the numbers.
    GiveDecimalMark,
    /// Leave out rows that lack a value.
    SkipInvalid,
}

/// What the user can do about the error of a recording, beyond what its text says.
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
