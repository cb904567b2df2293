//! Numbers of text, with a decimal point or a decimal comma.

use super::options::DecimalMark;

/// What is wrong with a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NotNumber {
    /// No number at all.
    Text,
    /// A number with the other decimal mark than those before it, or than the one that was asked for.
    OtherMark(DecimalMark),
}

/// Reads numbers that all have the same decimal mark.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Numbers {
    /// The mark; `None` while no number had one.
    mark: Option<DecimalMark>,
}

impl Numbers {
    pub(super) fn new(mark: Option<DecimalMark>) -> Self {
        Self { mark }
    }

    /// The number in a cell; not a number (NaN) where it is empty.
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
                self.fix(DecimalMark::Point)?;
            }
            return Ok(number);
        }
        let number = with_point(text).ok_or(NotNumber::Text)?;
        self.fix(DecimalMark::Comma)?;
        Ok(number)
    }

    fn fix(&mut self, mark: DecimalMark) -> Result<(), NotNumber> {
        if *self.mark.get_or_insert(mark) == mark {
            Ok(())
        } else {
            Err(NotNumber::OtherMark(mark))
        }
    }
}

/// A number with one decimal comma.
fn with_point(text: &str) -> Option<f64> {
    if text.len() > 64 || text.contains('.') || !text.contains(',') {
        return None;
    }
    text.replacen(',', ".", 1).parse().ok()
}

/// Whether a cell is a number with either decimal mark.
pub(super) fn is_number(cell: &[u8]) -> bool {
    let text = std::str::from_utf8(cell.trim_ascii());
    text.is_ok_and(|text| text.parse::<f64>().is_ok() || with_point(text).is_some())
}
