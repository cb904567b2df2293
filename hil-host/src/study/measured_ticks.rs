//! A measurement on the grid of ticks that an estimator of health takes: one sample of displacement and force a step.

use crate::files::FileError;
use crate::files::recording::{
    GAP_IN_MEDIANS, MOST_TICKS, MeasuredSample, Measurement, RecordingError,
};
use crate::study::tick_grid::rounding_s;

/// The samples of a measurement at its first time and each whole step (s) after it, linear between rows. Nothing is known
/// in a gap: its samples are NaN, which the estimator leaves out.
pub struct MeasuredTicks {
    measurement: Measurement,
    step_s: f64,
    start_s: f64,
    number: u64,
    before: MeasuredSample,
    after: MeasuredSample,
    in_gap: bool,
}

impl MeasuredTicks {
    /// The grid of `step_s` (s) over a measurement.
    ///
    /// # Errors
    /// No readable row.
    pub fn new(mut measurement: Measurement, step_s: f64) -> Result<Self, FileError> {
        let first = measurement
            .next_sample()?
            .ok_or_else(|| measurement.in_text(RecordingError::NoRow { left_out: 0 }))?;
        Ok(Self {
            measurement,
            step_s,
            start_s: first.time_s,
            number: 0,
            before: first,
            after: first,
            in_gap: false,
        })
    }

    /// Displacement (m) and force (N) of the next tick; `None` past the last row.
    ///
    /// # Errors
    /// A row that cannot be read, or a measurement over 24 hours of 10 kHz ticks long.
    pub fn next_sample(&mut self) -> Result<Option<(f64, f64)>, FileError> {
        let time_s = self.start_s + self.number as f64 * self.step_s;
        // A row meant for a tick may lie a rounding before it.
        let slack_s = rounding_s(time_s, self.step_s);
        while self.after.time_s + slack_s < time_s {
            let Some(next) = self.measurement.next_sample()? else {
                return Ok(None);
            };
            if (next.time_s - self.start_s) / self.step_s > MOST_TICKS {
                let time_s = next.time_s;
                let error = RecordingError::TooLong { time_s };
                return Err(self.measurement.in_time(error));
            }
            self.before = std::mem::replace(&mut self.after, next);
            self.in_gap = self.is_gap(self.after.time_s - self.before.time_s);
        }
        self.number += 1;
        let (before, after) = (self.before, self.after);
        if time_s + slack_s >= after.time_s {
            return Ok(Some((after.displacement_m, after.force_n)));
        }
        if self.in_gap {
            return Ok(Some((f64::NAN, f64::NAN)));
        }
        let share = (time_s - before.time_s) / (after.time_s - before.time_s);
        let between = |before: f64, after: f64| before + share * (after - before);
        Ok(Some((
            between(before.displacement_m, after.displacement_m),
            between(before.force_n, after.force_n),
        )))
    }

    /// Whether rows are further apart than a logger's own interval and jitter explain.
    fn is_gap(&self, interval_s: f64) -> bool {
        let longest_s = |interval_s: f64| GAP_IN_MEDIANS * interval_s;
        // The median is asked for where it matters.
        interval_s > longest_s(self.step_s)
            && self
                .measurement
                .gaps()
                .median_interval_s
                .is_some_and(|median_s| interval_s > longest_s(median_s))
    }

    /// Time of the first sample (s).
    pub fn start_s(&self) -> f64 {
        self.start_s
    }

    /// The measurement, read up to the last tick.
    pub fn measurement(&self) -> &Measurement {
        &self.measurement
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::files::recording::Channels;

    fn ticks(rows: &str, step_s: f64) -> Vec<(f64, f64)> {
        let text = format!("time_s,displacement_m,force_n\n{rows}");
        let source = Box::new(std::io::Cursor::new(text.into_bytes()));
        let channels = Channels::default();
        let measurement = Measurement::read(Path::new("x.csv"), source, &channels).unwrap();
        let mut ticks = MeasuredTicks::new(measurement, step_s).unwrap();
        std::iter::from_fn(|| ticks.next_sample().unwrap()).collect()
    }

    #[test]
    fn rows_on_ticks_are_kept_and_others_interpolated() {
        let found = ticks("1,0.1,10\n1.001,0.2,20\n1.003,0.4,60\n", 1e-3);
        let expected = [(0.1, 10.0), (0.2, 20.0), (0.3, 40.0), (0.4, 60.0)];
        assert_eq!(found.len(), expected.len());
        for ((x, force), (expected_x, expected_force)) in found.into_iter().zip(expected) {
            assert!((x - expected_x).abs() < 1e-9 && (force - expected_force).abs() < 1e-6);
        }
        // At the rate of the rows they are those of the file, to the bit.
        assert_eq!(
            ticks("0,0.1,7\n0.001,0.3,8\n0.002,0.7,9\n", 1e-3)[1],
            (0.3, 8.0)
        );
    }

    #[test]
    fn nothing_is_made_up_in_a_gap() {
        let rows: String = (0..10)
            .map(|row| {
                format!(
                    "{},0.5,100\n",
                    0.001 * f64::from(row + 40 * i32::from(row > 4))
                )
            })
            .collect();
        let found = ticks(&rows, 1e-3);
        assert_eq!(found.len(), 50);
        let unknown = found.iter().filter(|(x, _)| x.is_nan()).count();
        assert_eq!(unknown, 40);
        // A logger of a lower rate has no gaps for that.
        let slow: String = (0..20)
            .map(|row| format!("{},0.5,100\n", 0.01 * f64::from(row)))
            .collect();
        assert!(ticks(&slow, 1e-3).iter().all(|(x, _)| *x == 0.5));
    }
}
