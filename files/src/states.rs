//! Saved states of a damper bank as a readable TOML file.

use std::path::Path;

use dashpot_core::DamperState;
use serde::{Deserialize, Serialize};

use super::status_bits::{self, StatusBit};
use super::{FileError, input};

const STATE_BYTES: usize = DamperState::<f32>::BYTES;

/// States of a damper bank at one tick.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BankState {
    /// Last completed tick.
    pub tick: u32,
    /// State of each slot, starting at slot 0.
    #[serde(rename = "places")]
    pub slots: Vec<SlotState>,
}

/// State of the damper in one slot: the fields of [`DamperState::to_bytes`], in SI units.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlotState {
    /// Revision of the damper that last stepped the state.
    #[serde(with = "hexadecimal")]
    pub revision: u32,
    displacement_m: f32,
    stretch_m: f32,
    flow_potential_m2: f32,
    force_n: f32,
    status: Vec<StatusBit>,
    rejected_inputs: u16,
}

impl SlotState {
    fn from_bytes(bytes: [u8; STATE_BYTES]) -> Self {
        let [x, stretch, potential, force, revision, last] = words(bytes);
        let [s0, s1, n0, n1] = last;
        Self {
            revision: u32::from_le_bytes(revision),
            displacement_m: f32::from_le_bytes(x),
            stretch_m: f32::from_le_bytes(stretch),
            flow_potential_m2: f32::from_le_bytes(potential),
            force_n: f32::from_le_bytes(force),
            status: status_bits::from_word(u16::from_le_bytes([s0, s1])),
            rejected_inputs: u16::from_le_bytes([n0, n1]),
        }
    }

    fn to_bytes(&self) -> impl Iterator<Item = u8> {
        let reals = [
            self.displacement_m,
            self.stretch_m,
            self.flow_potential_m2,
            self.force_n,
        ];
        reals
            .into_iter()
            .flat_map(f32::to_le_bytes)
            .chain(self.revision.to_le_bytes())
            .chain(status_bits::to_word(&self.status).to_le_bytes())
            .chain(self.rejected_inputs.to_le_bytes())
    }
}

/// Splits the bytes into words of 4 bytes.
fn words(bytes: [u8; STATE_BYTES]) -> [[u8; 4]; STATE_BYTES / 4] {
    std::array::from_fn(|word| std::array::from_fn(|byte| bytes[4 * word + byte]))
}

impl BankState {
    /// Reads states from the bytes that a target saved; `None` if the last one is incomplete.
    pub fn from_bytes(tick: u32, states: &[u8]) -> Option<Self> {
        let (states, rest) = states.as_chunks::<STATE_BYTES>();
        let slots = states.iter().copied().map(SlotState::from_bytes);
        rest.is_empty().then(|| Self {
            tick,
            slots: slots.collect(),
        })
    }

    /// Returns the states as the bytes that a target restores.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.slots.iter().flat_map(SlotState::to_bytes).collect()
    }

    /// Returns the text of the file.
    ///
    /// # Errors
    /// Every state can be written as TOML, so no error is expected.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        Ok(format!(
            "# Saved states of a bank of dampers: one [[places]] table per slot, starting at slot 0.\n{}",
            toml::to_string(self)?
        ))
    }

    /// Reads the file at `path` (`-` for standard input).
    ///
    /// # Errors
    /// Returns an error if the file cannot be read or is not a valid state file.
    pub fn read(path: &Path) -> Result<Self, FileError> {
        toml::from_str(&input::read_text(path)?).map_err(|error| {
            // The parser's message ends with a line break.
            FileError::in_file(&input::name(path), error.to_string().trim_end())
        })
    }
}

/// Revisions as hexadecimal text, such as `0x0123abcd`.
mod hexadecimal {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(revision: &u32, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(&format_args!("{revision:#010x}"))
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<u32, D::Error> {
        let text = String::deserialize(from)?;
        text.strip_prefix("0x")
            .and_then(|digits| u32::from_str_radix(digits, 16).ok())
            .ok_or_else(|| D::Error::custom("a revision is 0x and 8 hexadecimal digits"))
    }
}
