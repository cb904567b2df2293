//! Latched status bits by name.

use dashpot_core::Status;
use serde::{Deserialize, Serialize};

/// Status bit of a damper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StatusBit {
    /// [`Status::INPUT_HELD`].
    InputHeld,
    /// [`Status::INPUT_LIMITED`].
    InputLimited,
    /// [`Status::SATURATED`].
    Saturated,
    /// [`Status::DAMPER_SWAPPED`].
    DamperSwapped,
    /// [`Status::CORRUPTED`].
    Corrupted,
    /// [`Status::RESTARTED`].
    Restarted,
}

/// Each bit with its flag in the core and its description in messages.
const ALL: [(StatusBit, Status, &str); 6] = [
    (StatusBit::InputHeld, Status::INPUT_HELD, "input held"),
    (
        StatusBit::InputLimited,
        Status::INPUT_LIMITED,
        "input limited",
    ),
    (StatusBit::Saturated, Status::SATURATED, "saturated"),
    (
        StatusBit::DamperSwapped,
        Status::DAMPER_SWAPPED,
        "damper swapped",
    ),
    (StatusBit::Corrupted, Status::CORRUPTED, "corrupted"),
    (StatusBit::Restarted, Status::RESTARTED, "restarted"),
];

/// Returns the bits that are set in a status word; unknown bits are ignored.
pub fn from_word(word: u16) -> Vec<StatusBit> {
    let status = Status::from_bits_truncate(word);
    let set = ALL.iter().filter(|(_, bit, _)| status.contains(*bit));
    set.map(|(name, ..)| *name).collect()
}

/// Returns the status word with these bits set.
pub fn to_word(names: &[StatusBit]) -> u16 {
    let set = ALL.iter().filter(|(name, ..)| names.contains(name));
    set.fold(0, |word, (_, bit, _)| word | bit.bits())
}

/// Describes the bits in words, separated by commas; `none` for an empty list.
pub fn describe(names: &[StatusBit]) -> String {
    let set = ALL.iter().filter(|(name, ..)| names.contains(name));
    let words: Vec<&str> = set.map(|(_, _, word)| *word).collect();
    if words.is_empty() {
        "none".into()
    } else {
        words.join(", ")
    }
}
