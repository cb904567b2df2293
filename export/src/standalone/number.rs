//! Exact numbers in C.

use std::fmt::Write;

use crate::Word;
use dashpot_files::Scalar;

/// Fraction bits of a double.
const FRACTION_BITS: u32 = f64::MANTISSA_DIGITS - 1;
/// Exponent bias of a double.
const BIAS: i32 = f64::MAX_EXP - 1;

/// Formats a finite number as a hexadecimal C99 constant, which no compiler rounds: `0x1.8p-3f` is 0.1875 in `f32`.
pub(super) fn hexadecimal<T: Word>(value: T) -> String {
    let end = match Scalar::of::<T>() {
        Scalar::F32 => "f",
        Scalar::F64 => "",
    };
    let bits = value.to_f64().to_bits();
    let sign = if bits >> 63 == 1 { "-" } else { "" };
    let fraction = bits & ((1 << FRACTION_BITS) - 1);
    let exponent = (bits >> FRACTION_BITS & 0x7ff) as i32;
    let (first, power) = match (exponent, fraction) {
        (0, 0) => (0, 0),
        (0, _) => (0, 1 - BIAS),
        _ => (1, exponent - BIAS),
    };
    let mut text = format!("{sign}0x{first}");
    if fraction != 0 {
        let digits = format!("{fraction:013x}");
        // Writing to a String does not fail.
        let _ = write!(text, ".{}", digits.trim_end_matches('0'));
    }
    format!("{text}p{power}{end}")
}

#[cfg(test)]
mod tests {
    use super::hexadecimal;

    #[test]
    fn constants_have_the_exact_value() {
        assert_eq!(hexadecimal(0.1875_f32), "0x1.8p-3f");
        assert_eq!(hexadecimal(0.1_f32), "0x1.99999ap-4f");
        assert_eq!(hexadecimal(0.1_f64), "0x1.999999999999ap-4");
        assert_eq!(hexadecimal(-0.0_f64), "-0x0p0");
        assert_eq!(hexadecimal(f32::MAX), "0x1.fffffep127f");
        assert_eq!(hexadecimal(f32::from_bits(1)), "0x1p-149f");
        assert_eq!(hexadecimal(f64::from_bits(1)), "0x0.0000000000001p-1022");
        assert_eq!(hexadecimal(-1024.5_f64), "-0x1.002p10");
    }
}
