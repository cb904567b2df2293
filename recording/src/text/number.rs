//! Numbers in text, with a decimal point or a decimal comma.

use super::instant::Instant;
use crate::text_options::DecimalMark;

/// Errors in a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NotNumber {
    /// The cell is not a number.
    Text,
    /// The decimal mark differs from that of earlier numbers or from the chosen one.
    OtherMark(DecimalMark),
}

/// Parser of numbers that all have the same decimal mark.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Numbers {
    /// Decimal mark; `None` until a number contains one.
    mark: Option<DecimalMark>,
}

impl Numbers {
    pub(super) fn new(mark: Option<DecimalMark>) -> Self {
        Self { mark }
    }

    /// Decimal mark of the numbers so far.
    pub(super) fn mark(self) -> Option<DecimalMark> {
        self.mark
    }

    /// Sets the decimal mark after a number that was parsed with the mark so far, which by default is the point.
    pub(super) fn keep_mark(&mut self) {
        self.mark.get_or_insert(DecimalMark::Point);
    }

    /// Parses the number in a cell; an empty cell is NaN.
    pub(super) fn parse(&mut self, cell: &[u8]) -> Result<f64, NotNumber> {
        if cell.is_empty() {
            return Ok(f64::NAN);
        }
        let text = std::str::from_utf8(cell).map_err(|_| NotNumber::Text)?;
        if let Ok(number) = text.parse::<f64>() {
            if self.mark == Some(DecimalMark::Point) {
                return Ok(number);
            }
            if cell.contains(&b'.') {
                self.set_mark(DecimalMark::Point)?;
            }
            return Ok(number);
        }
        let number = parse_decimal_comma(text).ok_or(NotNumber::Text)?;
        self.set_mark(DecimalMark::Comma)?;
        Ok(number)
    }

    fn set_mark(&mut self, mark: DecimalMark) -> Result<(), NotNumber> {
        if *self.mark.get_or_insert(mark) == mark {
            Ok(())
        } else {
            Err(NotNumber::OtherMark(mark))
        }
    }
}

/// Parses a number with one decimal comma.
fn parse_decimal_comma(text: &str) -> Option<f64> {
    if text.len() > 64 {
        return None;
    }
    text.replacen(',', ".", 1).parse().ok()
}

/// True if a cell is a number with either decimal mark, or a time with its date.
pub(super) fn is_number(cell: &[u8]) -> bool {
    let cell = cell.trim_ascii();
    let text = std::str::from_utf8(cell);
    Instant::parse(cell).is_some()
        || text.is_ok_and(|text| text.parse::<f64>().is_ok() || parse_decimal_comma(text).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_one_decimal_mark() {
        for (cell, expected) in [
            ("-0,25", Ok(-0.25)),
            ("1,5e3", Ok(1500.0)),
            ("0.25", Ok(0.25)),
            ("1.234,5", Err(NotNumber::Text)),
            ("1,234.5", Err(NotNumber::Text)),
            ("1,234,5", Err(NotNumber::Text)),
            ("1,5 mm", Err(NotNumber::Text)),
        ] {
            assert_eq!(
                Numbers::new(None).parse(cell.as_bytes()),
                expected,
                "{cell}"
            );
            assert_eq!(is_number(cell.as_bytes()), expected.is_ok(), "{cell}");
        }
    }

    /// A number with a decimal comma is copied, so its length is limited: a cell may be as long as a file.
    #[test]
    fn numbers_with_a_decimal_comma_have_at_most_64_characters() {
        for (length, is_allowed) in [(63, true), (64, true), (65, false), (66, false)] {
            let cell = format!("0,{}", "5".repeat(length - 2));
            assert_eq!(is_number(cell.as_bytes()), is_allowed, "{length}");
        }
    }
}
