//! Decimal numbers at the start of a text, with the bits that `str::parse` returns.

/// A parsed number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Decimal {
    pub(super) number: f64,
    /// Number of bytes.
    pub(super) length: usize,
    /// True if the number has a decimal mark.
    pub(super) has_mark: bool,
}

/// Largest number of digits that always fit into 64 bits.
const MAX_DIGITS: usize = 19;

/// Integers up to this one are exact in double precision.
const MAX_EXACT: u64 = 1 << 53;

/// Larger numbers are left to the caller, so that no unit makes them infinite.
const MAX_NUMBER: f64 = 1e100;

/// Powers of ten, of which each is exact in double precision.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Parses the number at the start of `text` with the decimal mark `mark`; `None` if there is no number, or an unusual
/// one. The text must continue for at least nine bytes after each digit of the number.
#[inline]
pub(super) fn parse(text: &[u8], mark: u8) -> Option<Decimal> {
    let first = *text.first()?;
    let start = usize::from(first == b'-' || first == b'+');
    let unsigned = text.get(start..)?;
    let Digits {
        value,
        count,
        before_mark,
    } = digits_with_mark(unsigned, mark)?;
    if count == 0 {
        return None;
    }
    let has_mark = before_mark.is_some();
    let decimals = before_mark.map_or(0, |before| count - before);
    let end = start + count + usize::from(has_mark);
    if *text.get(end)? | 0x20 != b'e' && count <= MAX_DIGITS && value <= MAX_EXACT {
        // Both numbers are exact, so that the quotient is rounded once.
        let magnitude = value as f64 / POWERS.get(decimals)?;
        return Some(Decimal {
            number: if first == b'-' { -magnitude } else { magnitude },
            length: end,
            has_mark,
        });
    }
    parse_other(text, end, has_mark && mark != b'.', has_mark)
}

/// Parses a number with many digits or an exponent, whose digits end at `end`.
#[inline(never)]
fn parse_other(text: &[u8], end: usize, has_comma: bool, has_mark: bool) -> Option<Decimal> {
    if has_comma {
        return None;
    }
    let mut length = end;
    if *text.get(end)? | 0x20 == b'e' {
        length += 1;
        length += usize::from(matches!(text.get(length), Some(b'-' | b'+')));
        let digits = text.get(length..)?.iter();
        length += digits.take_while(|byte| byte.is_ascii_digit()).count();
    }
    let number: f64 = std::str::from_utf8(text.get(..length)?)
        .ok()?
        .parse()
        .ok()?;
    (number.abs() <= MAX_NUMBER).then_some(Decimal {
        number,
        length,
        has_mark,
    })
}

/// Digits of a number.
struct Digits {
    /// The digits as an integer, modulo 2^64.
    value: u64,
    count: usize,
    /// Number of digits before the decimal mark; `None` without a mark.
    before_mark: Option<usize>,
}

/// Reads the digits at the start of `text` and at most one decimal mark among them.
#[inline]
fn digits_with_mark(text: &[u8], mark: u8) -> Option<Digits> {
    let word = eight_bytes(text, 0)?;
    let before = count_digits(word);
    if before == 8 {
        let whole = more_digits(text, 8, eight_digits(word), 8)?;
        if *text.get(whole.1)? != mark {
            return Some(Digits {
                value: whole.0,
                count: whole.1,
                before_mark: None,
            });
        }
        let (value, count) = more_digits(text, whole.1 + 1, whole.0, whole.1)?;
        return Some(Digits {
            value,
            count,
            before_mark: Some(whole.1),
        });
    }
    let has_mark = text[before] == mark;
    // Without the mark, the digits on both sides of it follow one another.
    let lower = (1_u64 << (8 * before)) - 1;
    let without = if has_mark {
        word & lower | eight_bytes(text, 1)? & !lower
    } else {
        word
    };
    let count = count_digits(without);
    let before_mark = has_mark.then_some(before);
    if count < 8 {
        // Zeros in front take the place of the other bytes.
        let word = without.checked_shl(64 - 8 * count as u32).unwrap_or(0);
        return Some(Digits {
            value: eight_digits(word),
            count,
            before_mark,
        });
    }
    let (value, count) = more_digits(text, 9, eight_digits(without), 8)?;
    Some(Digits {
        value,
        count,
        before_mark,
    })
}

/// Reads digits from position `at` on. They follow the `count` digits of `value`; returns the new value and count.
#[inline]
fn more_digits(
    text: &[u8],
    mut at: usize,
    mut value: u64,
    mut count: usize,
) -> Option<(u64, usize)> {
    loop {
        let digit = text.get(at)?.wrapping_sub(b'0');
        if digit > 9 {
            return Some((value, count));
        }
        value = value.wrapping_mul(10).wrapping_add(u64::from(digit));
        (at, count) = (at + 1, count + 1);
    }
}

/// Returns eight bytes, the first as the lowest, of which digits are 0 to 9 and other bytes larger.
#[inline]
fn eight_bytes(text: &[u8], at: usize) -> Option<u64> {
    let eight = text.get(at..)?.first_chunk::<8>()?;
    Some(u64::from_le_bytes(*eight) ^ 0x3030_3030_3030_3030)
}

/// Number of digits at the start of eight bytes.
#[inline]
fn count_digits(word: u64) -> usize {
    // Sets the high bit of the first byte above 9. A carry can only change the bytes after it.
    let others = (word.wrapping_add(0x7676_7676_7676_7676) | word) & 0x8080_8080_8080_8080;
    others.trailing_zeros() as usize / 8
}

/// Value of eight digits, of which the first is the lowest byte: pairs, then fours, then all (Lemire 2018).
#[inline]
fn eight_digits(word: u64) -> u64 {
    const MASK: u64 = 0x0000_00ff_0000_00ff;
    let pairs = word.wrapping_mul(10).wrapping_add(word >> 8);
    let first = (pairs & MASK).wrapping_mul(100 + (1_000_000 << 32));
    let second = (pairs >> 16 & MASK).wrapping_mul(1 + (10_000 << 32));
    first.wrapping_add(second) >> 32
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Checks a number that a cell of `text` contains, followed by any bytes.
    fn check(text: &str, rest: &str) {
        let padded = format!("{text}{rest}\n0123456789abcdef");
        let expected: Result<f64, _> = text.parse();
        for mark in [b'.', b','] {
            let cell = padded.replacen('.', if mark == b',' { "," } else { "." }, 1);
            let Some(found) = parse(cell.as_bytes(), mark) else {
                continue;
            };
            assert_eq!(found.length, text.len(), "{cell:?}");
            assert_eq!(found.has_mark, text.contains('.'), "{cell:?}");
            let expected = expected.as_ref().expect("a number");
            assert_eq!(found.number.to_bits(), expected.to_bits(), "{cell:?}");
        }
    }

    #[test]
    fn usual_numbers_are_parsed() {
        for text in [
            "0",
            "-0",
            "-0.0",
            "7",
            "12.345",
            "-0.00123456",
            "+1.5",
            "5.",
            ".5",
            "12345678",
            "1234567.8",
            "123456789.25",
            "0.12345678901234567",
            "9007199254740992",
        ] {
            let padded = format!("{text}\n0123456789");
            let found = parse(padded.as_bytes(), b'.').expect("a usual number");
            assert_eq!(found.length, text.len(), "{text}");
            let expected: f64 = text.parse().expect("a number");
            assert_eq!(found.number.to_bits(), expected.to_bits(), "{text}");
        }
        for (text, mark) in [
            ("", b'.'),
            (".", b'.'),
            ("-", b'.'),
            ("x", b'.'),
            ("1e", b'.'),
            ("1e400", b'.'),
        ] {
            assert_eq!(
                parse(format!("{text}\n0123456789").as_bytes(), mark),
                None,
                "{text}"
            );
        }
    }

    /// Numbers halfway between two doubles, and the next decimals above and below.
    fn halfway() -> impl Strategy<Value = String> {
        (any::<u64>(), -31_i32..60, -1_i128..=1).prop_map(|(bits, power, offset)| {
            // A double has 53 bits; the 54th bit of this significand is one.
            let significand = i128::from((bits >> 11 | 1 << 52) * 2 + 1);
            if power >= 0 {
                return ((significand << power) + offset).to_string();
            }
            // Dividing by 2^n is multiplying by 5^n and moving the decimal mark.
            let decimals = power.unsigned_abs() as usize;
            let digits = significand * 5_i128.pow(power.unsigned_abs()) + offset;
            let digits = format!("{digits:0width$}", width = decimals + 1);
            let (whole, fraction) = digits.split_at(digits.len() - decimals);
            format!("{whole}.{fraction}")
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(cases(4096)))]

        #[test]
        fn numbers_have_the_bits_of_the_standard_library(
            text in "[-+]?[0-9]{0,25}(\\.[0-9]{0,30})?([eE][-+]?[0-9]{0,4})?",
            rest in "[,; \t\r]?[0-9.,eE-]{0,4}",
        ) {
            if rest.chars().next().is_none_or(|first| !"0123456789.eE-,".contains(first)) {
                check(&text, &rest);
            }
        }

        #[test]
        fn short_numbers_have_the_bits_of_the_standard_library(
            text in "-?[0-9]{1,10}(\\.[0-9]{0,12})?",
        ) {
            check(&text, "");
        }

        #[test]
        fn doubles_of_17_to_30_digits_keep_their_bits(
            bits in any::<u64>(), digits in 16_usize..30, power in -25_i32..25,
        ) {
            let number = (bits >> 1) as f64 * f64::powi(10.0, power);
            check(&format!("{number:.digits$e}"), "");
            check(&format!("{number:.digits$}"), "");
        }

        #[test]
        fn numbers_between_two_doubles_are_rounded_correctly(text in halfway()) {
            check(&text, "");
        }
    }

    /// Number of random cases; `PROPTEST_CASES` sets another.
    fn cases(usual: u32) -> u32 {
        std::env::var("PROPTEST_CASES").map_or(usual, |cases| cases.parse().expect("a number"))
    }
}
