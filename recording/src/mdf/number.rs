//! How the numbers of a channel are read: by the library, but for what it reads as zeros or counts from the wrong row.

use falcon_mdf::blocks::DataType;
use falcon_mdf::{Channel, ChannelGroup, Conversion, Mf4Error, Signal, SignalValues};

use super::super::select::Unread;

/// How the numbers of a channel are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reading {
    /// By the library.
    Library,
    /// As floats of 16 bits, which the library reads as zeros: it reads their bits as whole numbers.
    Half,
    /// As the number of the row, from 0: the library counts from the start of each part of the rows.
    RowNumber,
}

/// How the numbers of `channel`, which is in `group`, are read.
///
/// # Errors
/// The library would read other numbers than the file has.
pub(super) fn reading(channel: &Channel, group: &ChannelGroup) -> Result<Reading, Unread> {
    if channel.channel_type.is_virtual() {
        return Ok(Reading::RowNumber);
    }
    let (bits, bit_offset) = (channel.bit_count, channel.bit_offset);
    let unread = |held: String, allowed| Err(Unread { held, allowed });
    if channel.is_float() && ![16, 32, 64].contains(&bits) {
        return unread(format!("floats of {bits} bits"), "16, 32 or 64 bits");
    }
    if channel.is_float() && bit_offset > 0 {
        let held = format!("floats that start at bit {bit_offset} of a byte");
        return unread(held, "bit 0");
    }
    if !(1..=64).contains(&bits) {
        return unread(format!("whole numbers of {bits} bits"), "1 to 64 bits");
    }
    if bit_offset > 7 {
        let held = format!("whole numbers that start at bit {bit_offset} of a byte");
        return unread(held, "bits 0 to 7");
    }
    let bytes = (u64::from(bit_offset) + u64::from(bits)).div_ceil(8);
    let end = u64::from(channel.byte_offset) + bytes;
    if end > group.data_bytes_len() as u64 {
        let held = format!(
            "numbers up to byte {end} of records that have {}",
            group.data_bytes_len()
        );
        return unread(held, "numbers within their record");
    }
    match channel.is_float() && bits == 16 {
        true => Ok(Reading::Half),
        false => Ok(Reading::Library),
    }
}

impl Reading {
    /// The channel that the library is asked for.
    pub(super) fn asked(self, channel: &Channel) -> Channel {
        let mut asked = channel.clone();
        if self == Self::Half {
            asked.data_type = match channel.is_little_endian() {
                true => DataType::UIntLe,
                false => DataType::UIntBe,
            };
            asked.conversion = Conversion::None;
        }
        asked
    }

    /// The numbers of `channel` in a part of the rows, the first of which is row `first`, from 0; `signal` is what the
    /// library has read of the channel that it was [`Self::asked`] for.
    pub(super) fn numbers(
        self,
        signal: &Signal,
        channel: &Channel,
        first: u64,
    ) -> Result<Vec<f64>, Mf4Error> {
        match self {
            Self::Library => signal.values_f64(),
            Self::Half => match signal.values()? {
                SignalValues::U16(halves) => Ok(halves
                    .iter()
                    .map(|bits| channel.convert(from_half(*bits)))
                    .collect()),
                _ => Err(Mf4Error::parse_error("floats of 16 bits are not 2 bytes")),
            },
            Self::RowNumber => Ok((first..first + signal.len() as u64)
                .map(|row| channel.convert(row as f64))
                .collect()),
        }
    }
}

/// A float of 16 bits by IEEE 754: a sign, 5 bits of an exponent that is 15 too high, 10 bits of a fraction.
fn from_half(bits: u16) -> f64 {
    let exponent = i32::from(bits >> 10 & 0x1f);
    let fraction = f64::from(bits & 0x3ff) / 1024.0;
    let size = match exponent {
        0 => fraction * 2.0_f64.powi(-14),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1.0 + fraction) * 2.0_f64.powi(exponent - 15),
    };
    if bits >> 15 == 1 { -size } else { size }
}
