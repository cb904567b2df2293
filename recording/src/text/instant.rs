//! Times of day with a date (ISO 8601), as `2026-11-28T21:52:03.123456Z`.

/// Number of nanoseconds in a second.
const NS_PER_S: i128 = 1_000_000_000;

/// Maximum number of digits of a fraction of a second.
const FRACTION_DIGITS: usize = 9;

/// A time with its date.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Instant {
    /// Nanoseconds since the beginning of 1970, in UTC if the time states its offset from UTC.
    ns: i128,
    has_offset: bool,
}

/// Times of one column, counted from the first.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Instants {
    first: Option<Instant>,
}

impl Instants {
    /// Returns the seconds from the first time of the column to the time in a cell, exact to the nanosecond; NaN for an
    /// empty cell. `None` if the cell is no such time, or if only one of it and the first time states an offset from
    /// UTC.
    pub(super) fn parse(&mut self, cell: &[u8]) -> Option<f64> {
        if cell.is_empty() {
            return Some(f64::NAN);
        }
        let instant = Instant::parse(cell)?;
        let first = *self.first.get_or_insert(instant);
        // The difference is an integer: a double has too few digits for a date with nanoseconds.
        (first.has_offset == instant.has_offset)
            .then(|| (instant.ns - first.ns) as f64 / NS_PER_S as f64)
    }
}

impl Instant {
    /// Parses a date, `T` or a space, hours, minutes, and optionally seconds, a fraction with a point or comma, and an
    /// offset from UTC.
    pub(super) fn parse(cell: &[u8]) -> Option<Self> {
        let mut text = Text(cell);
        let year = text.digits(4)?;
        text.one_of(b"-")?;
        let month = text.digits(2).filter(|month| (1..=12).contains(month))?;
        text.one_of(b"-")?;
        let day = text.digits(2)?;
        if !(1..=days_of(year, month)).contains(&day) {
            return None;
        }
        text.one_of(b"Tt ")?;
        let hour = text.digits(2).filter(|hour| *hour < 24)?;
        text.one_of(b":")?;
        let minute = text.digits(2).filter(|minute| *minute < 60)?;
        let (mut second, mut fraction_ns) = (0, 0);
        if text.one_of(b":").is_some() {
            second = text.digits(2).filter(|second| *second < 60)?;
            if text.one_of(b".,").is_some() {
                fraction_ns = text.fraction_ns()?;
            }
        }
        let offset_s = text.offset_s()?;
        if !text.0.is_empty() {
            return None;
        }
        let seconds = ((days_since_1970(year, month, day) * 24 + hour) * 60 + minute) * 60 + second;
        let utc_s = i128::from(seconds - offset_s.unwrap_or(0));
        Some(Self {
            ns: utc_s * NS_PER_S + i128::from(fraction_ns),
            has_offset: offset_s.is_some(),
        })
    }
}

/// Rest of a text.
struct Text<'a>(&'a [u8]);

impl Text<'_> {
    /// Takes one of these characters.
    fn one_of(&mut self, characters: &[u8]) -> Option<u8> {
        let (first, rest) = self.0.split_first()?;
        characters.contains(first).then(|| {
            self.0 = rest;
            *first
        })
    }

    /// Takes a number of `count` digits.
    fn digits(&mut self, count: usize) -> Option<i64> {
        let (digits, rest) = self.0.split_at_checked(count)?;
        if !digits.iter().all(u8::is_ascii_digit) {
            return None;
        }
        self.0 = rest;
        Some(
            digits
                .iter()
                .fold(0, |number, digit| number * 10 + i64::from(digit - b'0')),
        )
    }

    /// Takes the digits of a fraction. Digits below a nanosecond must be zero.
    fn fraction_ns(&mut self) -> Option<i64> {
        let count = self
            .0
            .iter()
            .take_while(|byte| byte.is_ascii_digit())
            .count();
        let kept = count.min(FRACTION_DIGITS);
        let fraction = self.digits(kept)?;
        let (below, rest) = self.0.split_at_checked(count - kept)?;
        self.0 = rest;
        let is_whole = count > 0 && below.iter().all(|digit| *digit == b'0');
        is_whole.then(|| fraction * 10_i64.pow((FRACTION_DIGITS - kept) as u32))
    }

    /// Takes an offset from UTC: `Z`, `+01`, `+0100` or `+01:00`. The inner value is `None` if there is none.
    fn offset_s(&mut self) -> Option<Option<i64>> {
        let sign = match self.one_of(b"Zz+-") {
            None => return Some(None),
            Some(b'+') => 1,
            Some(b'-') => -1,
            Some(_) => return Some(Some(0)),
        };
        let hours = self.digits(2).filter(|hours| *hours < 24)?;
        let has_minutes = self.one_of(b":").is_some() || !self.0.is_empty();
        let minutes = match has_minutes {
            true => self.digits(2).filter(|minutes| *minutes < 60)?,
            false => 0,
        };
        Some(Some(sign * (hours * 60 + minutes) * 60))
    }
}

fn is_leap(year: i64) -> bool {
    year % 4 == 0 && year % 100 != 0 || year % 400 == 0
}

fn days_of(year: i64, month: i64) -> i64 {
    match month {
        2 => 28 + i64::from(is_leap(year)),
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

/// Days from 1 January 1970 in the Gregorian calendar.
fn days_since_1970(year: i64, month: i64, day: i64) -> i64 {
    let before = year - 1;
    let leap_days = before / 4 - before / 100 + before / 400;
    // 719162 days precede 1970 from the year 1 on.
    let years = year * 365 - 365 + leap_days - 719_162;
    let months: i64 = (1..month).map(|month| days_of(year, month)).sum();
    years + months + day - 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ns(text: &str) -> Option<i128> {
        Instant::parse(text.as_bytes()).map(|instant| instant.ns)
    }

    /// Values of GNU date.
    #[test]
    fn times_are_those_of_the_gregorian_calendar() {
        for (text, s) in [
            ("1970-01-01T00:00:00Z", 0),
            ("2000-02-29T23:59:59Z", 951_868_799),
            ("2026-11-28T21:52:03Z", 1_795_902_723),
            ("1969-12-31T23:59:59Z", -1),
            ("2100-03-01T00:00Z", 4_107_542_400),
        ] {
            assert_eq!(ns(text), Some(s * NS_PER_S), "{text}");
        }
    }

    #[test]
    fn offsets_and_fractions_have_several_spellings() {
        let expected = ns("2026-11-28T21:52:03.250000000Z");
        assert!(expected.is_some());
        for text in [
            "2026-11-28 21:52:03.25Z",
            "2026-11-28t21:52:03,25z",
            "2026-11-28T21:52:03.250000000000Z",
            "2026-11-28T22:52:03.25+01:00",
            "2026-11-28T22:52:03.25+01",
            "2026-11-28T16:22:03.25-0530",
            "2026-11-29T00:22:03.25+02:30",
            "2026-11-28T21:52:03.25",
        ] {
            assert_eq!(ns(text), expected, "{text}");
        }
    }

    #[test]
    fn other_texts_are_no_times() {
        for text in [
            "",
            "2026-11-28",
            "2026-02-29T00:00:00",
            "2026-13-01T00:00:00",
            "2026-11-31T00:00:00",
            "2026-11-28T24:00:00",
            "2026-11-28T21:60:00",
            "2026-11-28T21:52:60",
            "2026-11-28T21:52:03.",
            "2026-11-28T21:52:03.0000000001",
            "2026-11-28T21:52:03 Z",
            "2026-11-28T21:52:03+1",
            "2026-11-28T21:52:03+01:",
            "2026-11-28T21:52:03Zx",
            "28.11.2026 21:52:03",
            "21:52:03",
        ] {
            assert_eq!(ns(text), None, "{text}");
        }
    }

    #[test]
    fn seconds_from_the_first_time_are_exact() {
        let mut column = Instants::default();
        assert_eq!(column.parse(b"2026-11-28T23:59:59.999999999Z"), Some(0.0));
        assert_eq!(column.parse(b"2026-11-29T00:00:00.000000001Z"), Some(2e-9));
        assert_eq!(
            column.parse(b"2026-11-29T01:00:00.000000001+01:00"),
            Some(2e-9)
        );
        assert!(column.parse(b"").is_some_and(f64::is_nan));
        assert_eq!(column.parse(b"2026-11-29T00:00:01"), None);
    }
}
