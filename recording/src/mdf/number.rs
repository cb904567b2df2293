//! Decoding of numbers in MDF4 channels. The library decodes most formats, but reads 16-bit floats as zeros, and
//! restarts the row numbers of virtual channels in each block of rows.

use falcon_mdf::blocks::DataType;
use falcon_mdf::{Channel, ChannelGroup, Conversion, Mf4Error, Signal, SignalValues};

use crate::select::Unread;

/// Decoding method for the numbers of a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reading {
    /// The library decodes the numbers.
    Library,
    /// 16-bit floats: the library reads the bits as integers, because it would read the floats as zeros.
    Half,
    /// Row numbers from 0, because the library restarts counting in each block of rows.
    RowNumber,
}

/// Returns the decoding method for `channel` of `group`.
///
/// # Errors
/// Returns an error if the library would read wrong numbers.
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
            "numbers up to byte {end} of records of {} bytes",
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
    /// Returns the channel to request from the library.
    pub(super) fn requested(self, channel: &Channel) -> Channel {
        let mut requested = channel.clone();
        if self == Self::Half {
            requested.data_type = match channel.is_little_endian() {
                true => DataType::UIntLe,
                false => DataType::UIntBe,
            };
            requested.conversion = Conversion::None;
        }
        requested
    }

    /// Decodes the numbers of `channel` in a block of rows that starts at row `first` (from 0). `signal` contains the
    /// values of the [`Self::requested`] channel.
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
                _ => Err(Mf4Error::parse_error(
                    "a float of 16 bits does not have 2 bytes",
                )),
            },
            Self::RowNumber => Ok((first..first + signal.len() as u64)
                .map(|row| channel.convert(row as f64))
                .collect()),
        }
    }
}

/// Converts an IEEE 754 half-precision float: a sign bit, 5 exponent bits with bias 15, and 10 fraction bits.
fn from_half(bits: u16) -> f64 {
    let exponent = i32::from(bits >> 10 & 0x1f);
    let fraction = f64::from(bits & 0x3ff) / 1024.0;
    let magnitude = match exponent {
        0 => fraction * 2.0_f64.powi(-14),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1.0 + fraction) * 2.0_f64.powi(exponent - 15),
    };
    if bits >> 15 == 1 {
        -magnitude
    } else {
        magnitude
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of IEEE 754.
    #[test]
    fn halves_have_their_value() {
        for (bits, value) in [
            (0x0000, 0.0),
            (0x0001, 2.0_f64.powi(-24)),
            (0x03ff, 1023.0 * 2.0_f64.powi(-24)),
            (0x0400, 2.0_f64.powi(-14)),
            (0x3555, 1365.0 / 4096.0),
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x7bff, 65504.0),
            (0x7c00, f64::INFINITY),
            (0xfc00, f64::NEG_INFINITY),
        ] {
            assert_eq!(from_half(bits), value, "{bits:#x}");
        }
        for bits in [0x7c01, 0x7e00, 0x7fff, 0xfe00] {
            assert!(from_half(bits).is_nan(), "{bits:#x}");
        }
    }
}
