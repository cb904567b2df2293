//! Trends in words, for tables that people read.

use super::axis::Axis;
use super::fit::Interval;
use super::fleet::{DamperTrends, Trend};
use super::forecast::Forecast;
use super::parameter::Parameter;

impl Trend {
    /// Returns the parameter (SI) at the last reading, according to the line.
    pub fn now(&self) -> Option<Interval> {
        let fitted = self.line?.at(self.last()?);
        Some(fitted.map(|value| self.parameter.shown(value)))
    }

    /// Returns the rate of the parameter (SI) per unit of the axis at the last reading: a year or 100 000 km.
    pub fn rate(&self, axis: Axis) -> Option<Interval> {
        let line = self.line?;
        let (_, unit) = axis.rate_unit();
        let rate = line.rate().map(|rate| rate * unit);
        Some(self.parameter.shown_rate(line.at(self.last()?).value, rate))
    }

    /// Describes the parameter at the last reading: `1.85 mm (1.80 to 1.90)`.
    pub fn now_in_words(&self) -> String {
        self.now()
            .map_or_else(String::new, |now| in_words(self.parameter, now, false))
    }

    /// Describes the rate: `+0.82 mm (+0.70 to +0.94) a year`, or that there is none.
    pub fn rate_in_words(&self, axis: Axis) -> String {
        let (Some(rate), Some(line)) = (self.rate(axis), self.line) else {
            return String::new();
        };
        let (unit, _) = axis.rate_unit();
        let per = match axis {
            Axis::Date => format!("a {unit}"),
            Axis::Mileage => format!("per {unit}"),
        };
        let words = format!("{} {per}", in_words(self.parameter, rate, true));
        match line.has_changed() {
            true => words,
            false => format!("no change seen (p = {:.2}): {words}", line.p_value()),
        }
    }

    /// Describes the limit: `2.9 mm`.
    pub fn limit_in_words(&self) -> String {
        let (unit, scale) = self.parameter.display_unit();
        self.limit.map_or_else(
            || "none".into(),
            |limit| with_unit(&trimmed(scale * self.parameter.shown(limit.value)), unit),
        )
    }

    /// Describes when the limit is reached, with the confidence interval.
    pub fn when_in_words(&self, axis: Axis) -> String {
        let (Some(forecast), Some(last)) = (self.forecast, self.last()) else {
            return match (&self.line, self.limit) {
                (None, _) => format!("too few readings: {}", self.points.len()),
                _ => "no limit".into(),
            };
        };
        let (reach, in_words) = axis.horizon();
        let horizon = last + reach;
        let from = |x: Option<f64>| match x {
            Some(x) if x <= last => "may be reached already".to_owned(),
            Some(x) if x <= horizon => format!("{} at the earliest", axis.label(x)),
            _ => format!("not within {in_words}"),
        };
        match forecast {
            Forecast::Beyond { since, is_sure } => {
                let probably = if is_sure { "" } else { "probably " };
                let since =
                    since.map_or_else(String::new, |since| format!(" since {}", axis.label(since)));
                format!("{probably}beyond the limit{since}")
            }
            Forecast::Reached {
                at,
                earliest,
                latest,
            } if at <= horizon => {
                let latest = match latest <= horizon {
                    true => axis.label(latest),
                    false => format!("more than {in_words} on"),
                };
                format!("{} ({} to {latest})", axis.label(at), axis.label(earliest))
            }
            Forecast::Reached { earliest, .. } if earliest <= horizon => {
                format!("not within {in_words}; {}", from(Some(earliest)))
            }
            Forecast::Reached { .. } => from(None),
            Forecast::NotInSight { earliest } => format!("no wear seen; {}", from(earliest)),
        }
    }
}

impl DamperTrends {
    /// Lists what to look at besides the trends, one sentence without a full stop each.
    pub fn notes(&self, axis: Axis) -> Vec<String> {
        let mut notes = Vec::new();
        if self.doubtful_at_the_end > 0 {
            let count = self.doubtful_at_the_end;
            notes.push(match count {
                1 => "the last reading is in doubt and not used".into(),
                _ => format!("the last {count} readings are in doubt and not used"),
            });
        }
        let mut jumps: Vec<f64> = self
            .trends
            .iter()
            .filter_map(|trend| trend.exchange)
            .collect();
        jumps.sort_by(f64::total_cmp);
        if let Some(first) = jumps.first() {
            notes.push(format!(
                "from {} on it looks like another damper: if it was exchanged, give serial_number in recordings.csv",
                axis.label(*first)
            ));
        }
        if !self.is_installed {
            notes.push("exchanged".into());
        }
        notes
    }
}

/// Formats an interval of a parameter (SI) in its display unit, with a sign if it is a rate.
fn in_words(parameter: Parameter, interval: Interval, is_rate: bool) -> String {
    let (unit, scale) = parameter.display_unit();
    let Interval { value, low, high } = interval.map(|value| scale * value);
    let half = 0.5 * (high - low);
    let decimals = match half.is_finite() && half > 0.0 {
        true => (-(half / 3.0).log10().floor()).clamp(0.0, 6.0) as usize,
        false => 2,
    };
    let number = |value: f64| match (value.is_finite(), is_rate) {
        (false, _) => "rigid".to_owned(),
        (true, true) => format!("{value:+.decimals$}"),
        (true, false) => format!("{value:.decimals$}"),
    };
    let range = format!("({} to {})", number(low), number(high));
    format!("{} {range}", with_unit(&number(value), unit))
}

fn with_unit(number: &str, unit: &str) -> String {
    match unit {
        "" => number.to_owned(),
        unit => format!("{number} {unit}"),
    }
}

/// Formats a number with at most three digits after the point, without trailing zeros.
fn trimmed(number: f64) -> String {
    let text = format!("{number:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
