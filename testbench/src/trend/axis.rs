//! What trends are drawn over: the date or the mileage.

use chrono::{Datelike, NaiveDate};

use super::recordings::Listed;

/// Abscissa of a trend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Date, counted in days.
    Date,
    /// Mileage of the vehicle, in km.
    Mileage,
}

impl Axis {
    /// Returns the abscissa of a recording: days or km; `None` if it is not known.
    pub fn of(self, listed: &Listed) -> Option<f64> {
        match self {
            Self::Date => listed.date.map(|date| f64::from(date.num_days_from_ce())),
            Self::Mileage => listed.mileage_km,
        }
    }

    /// Returns what a recording lacks if [`of`](Self::of) is `None`.
    pub fn missing(self) -> &'static str {
        match self {
            Self::Date => "no date: the name of the file must begin with YYYY-MM-DD",
            Self::Mileage => "no mileage_km in recordings.csv",
        }
    }

    /// Returns the unit of rates and how many days or km it has.
    pub fn rate_unit(self) -> (&'static str, f64) {
        match self {
            Self::Date => ("year", 365.25),
            Self::Mileage => ("100 000 km", 1e5),
        }
    }

    /// Returns how far after the last reading forecasts go, days or km, and in words: further on, no line of so few
    /// readings says anything.
    pub fn horizon(self) -> (f64, &'static str) {
        match self {
            Self::Date => (3652.5, "10 years"),
            Self::Mileage => (1e6, "1 000 000 km"),
        }
    }

    /// Formats an abscissa: `2026-03-14`, or `123 456 km`.
    pub fn label(self, x: f64) -> String {
        match self {
            Self::Date => match date(x) {
                Some(date) => date.format("%Y-%m-%d").to_string(),
                None => "no date".into(),
            },
            Self::Mileage => format!("{} km", grouped(x)),
        }
    }

    /// Formats an abscissa for a table: a date, or a number of km.
    pub fn cell(self, x: f64) -> String {
        match self {
            Self::Date => self.label(x),
            Self::Mileage => x.to_string(),
        }
    }

    /// Returns the abscissa for a plot: years with decimals, or thousands of km.
    pub fn plotted(self, x: f64) -> f64 {
        match self {
            Self::Date => match date(x) {
                Some(date) => {
                    let days = if date.leap_year() { 366.0 } else { 365.0 };
                    f64::from(date.year()) + f64::from(date.ordinal0()) / days
                }
                None => f64::NAN,
            },
            Self::Mileage => 1e-3 * x,
        }
    }

    /// Returns the label of the axis of a plot.
    pub fn plot_label(self) -> &'static str {
        match self {
            Self::Date => "date, year",
            Self::Mileage => "mileage, 1000 km",
        }
    }
}

fn date(x: f64) -> Option<NaiveDate> {
    let day = x.is_finite().then(|| x.round() as i32);
    day.and_then(NaiveDate::from_num_days_from_ce_opt)
}

/// Formats a number in whole units with a space before each three digits.
fn grouped(number: f64) -> String {
    let digits = format!("{:.0}", number.abs());
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    if number < 0.0 {
        format!("-{text}")
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn abscissas_are_dates_and_kilometres() {
        let day = f64::from(
            NaiveDate::from_ymd_opt(2026, 7, 2)
                .unwrap()
                .num_days_from_ce(),
        );
        assert_eq!(Axis::Date.label(day + 0.4), "2026-07-02");
        assert!((Axis::Date.plotted(day) - 2026.4986).abs() < 1e-3);
        assert_eq!(Axis::Date.label(f64::NAN), "no date");
        assert_eq!(Axis::Mileage.label(1_234_567.4), "1 234 567 km");
        assert_eq!(Axis::Mileage.label(-12.0), "-12 km");
        assert_eq!(Axis::Mileage.cell(1234.5), "1234.5");
    }
}
