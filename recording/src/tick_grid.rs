//! Recordings on the ticks of a step.

use std::collections::VecDeque;

use crate::{GAP_IN_MEDIANS, MAX_GAP_TICKS, MOST_TICKS, Measurement, Recording, RecordingError};
use dashpot_files::FileError;

/// One tick of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Time (s), first sample plus a whole number of steps.
    pub time_s: f64,
    /// Displacement there (m), linear between samples.
    pub displacement_m: f64,
}

/// One tick of a motion with the force measured on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredTick {
    /// Time (s), first sample plus a whole number of steps.
    pub time_s: f64,
    /// Displacement there (m), linear between samples; NaN in a gap, where nothing is known.
    pub displacement_m: f64,
    /// Force there (N), linear between samples; NaN in a gap.
    pub force_n: f64,
}

/// After a gap of more ticks, rows that follow are read before any tick of the gap is given: the clock of a logger may
/// have jumped there and back again.
const LOOK_AHEAD_TICKS: f64 = 1e3;

/// How many rows are read then: a second of a logger at 1 kHz.
const LOOK_AHEAD_ROWS: usize = 1000;

/// What has rows of `N` values at times.
trait Rows<const N: usize> {
    fn next_row(&mut self) -> Result<Option<(f64, [f64; N])>, FileError>;
    fn in_text(&self, error: RecordingError) -> FileError;
    fn in_time(&self, error: RecordingError) -> FileError;
}

impl Rows<1> for Recording {
    fn next_row(&mut self) -> Result<Option<(f64, [f64; 1])>, FileError> {
        let sample = self.next_sample()?;
        Ok(sample.map(|sample| (sample.time_s, [sample.displacement_m])))
    }

    fn in_text(&self, error: RecordingError) -> FileError {
        Recording::in_text(self, error)
    }

    fn in_time(&self, error: RecordingError) -> FileError {
        Recording::in_time(self, error)
    }
}

impl Rows<2> for Measurement {
    fn next_row(&mut self) -> Result<Option<(f64, [f64; 2])>, FileError> {
        let sample = self.next_sample()?;
        Ok(sample.map(|sample| (sample.time_s, [sample.displacement_m, sample.force_n])))
    }

    fn in_text(&self, error: RecordingError) -> FileError {
        Measurement::in_text(self, error)
    }

    fn in_time(&self, error: RecordingError) -> FileError {
        Measurement::in_time(self, error)
    }
}

/// How far a sample meant for the tick at `time_s` (s) of steps of `step_s` (s) may lie from it by
/// rounding (s).
pub fn rounding_s(time_s: f64, step_s: f64) -> f64 {
    1e-9 * step_s + 4.0 * f64::EPSILON * time_s.abs()
}

/// Rows on ticks: from the first row to within the last, linear between rows.
struct Grid<R, const N: usize> {
    rows: R,
    step_s: f64,
    start_s: f64,
    number: u64,
    before: (f64, [f64; N]),
    after: (f64, [f64; N]),
    /// Rows after them that were read already.
    ahead: VecDeque<(f64, [f64; N])>,
    /// Time of the row read last (s).
    read_s: f64,
}

impl<R: Rows<N>, const N: usize> Grid<R, N> {
    fn new(mut rows: R, step_s: f64) -> Result<Self, FileError> {
        let first = rows
            .next_row()?
            .ok_or_else(|| rows.in_text(RecordingError::NoRow { left_out: 0 }))?;
        Ok(Self {
            rows,
            step_s,
            start_s: first.0,
            number: 0,
            before: first,
            after: first,
            ahead: VecDeque::new(),
            read_s: first.0,
        })
    }

    /// Reads rows that follow, so that what is wrong with them is an error before a gap is filled.
    fn look_ahead(&mut self) -> Result<(), FileError> {
        while self.ahead.len() < LOOK_AHEAD_ROWS {
            let Some(row) = self.read_row()? else {
                break;
            };
            self.ahead.push_back(row);
        }
        Ok(())
    }

    /// The row after the one read last, where it is not too far from that one and from the first.
    fn read_row(&mut self) -> Result<Option<(f64, [f64; N])>, FileError> {
        let Some(next) = self.rows.next_row()? else {
            return Ok(None);
        };
        let (before_s, time_s) = (self.read_s, next.0);
        let ticks = (time_s - before_s) / self.step_s;
        if time_s - self.start_s > MOST_TICKS * self.step_s {
            return Err(self.rows.in_time(RecordingError::TooLong { time_s }));
        }
        if ticks > MAX_GAP_TICKS {
            return Err(self.rows.in_time(RecordingError::Jump {
                time_s,
                before_s,
                ticks,
            }));
        }
        self.read_s = time_s;
        Ok(Some(next))
    }

    /// Time, values, and the interval between the rows around them, 0 at a row.
    fn next_tick(&mut self) -> Result<Option<(f64, [f64; N], f64)>, FileError> {
        let offset_s = self.number as f64 * self.step_s;
        let time_s = self.start_s + offset_s;
        // A sample meant for a tick may lie a rounding before it.
        let slack_s = rounding_s(time_s, self.step_s);
        while self.after.0 + slack_s < time_s {
            let next = match self.ahead.pop_front() {
                Some(next) => Some(next),
                None => self.read_row()?,
            };
            let Some(next) = next else {
                return Ok(None);
            };
            if next.0 - self.after.0 > LOOK_AHEAD_TICKS * self.step_s {
                self.look_ahead()?;
            }
            self.before = self.after;
            self.after = next;
        }
        self.number += 1;
        let ((before_s, before), (after_s, after)) = (self.before, self.after);
        if time_s + slack_s >= after_s {
            return Ok(Some((time_s, after, 0.0)));
        }
        let interval_s = after_s - before_s;
        let fraction = (time_s - before_s) / interval_s;
        let between = |value: usize| before[value] + fraction * (after[value] - before[value]);
        Ok(Some((time_s, std::array::from_fn(between), interval_s)))
    }
}

/// A recorded motion on ticks: from its first sample to within its last.
pub struct TickGrid(Grid<Recording, 1>);

impl TickGrid {
    /// The grid of `step_s` (s) over `recording`.
    ///
    /// # Errors
    /// No readable row.
    pub fn new(recording: Recording, step_s: f64) -> Result<Self, FileError> {
        Grid::new(recording, step_s).map(Self)
    }

    /// The next tick; `None` past the last sample.
    ///
    /// # Errors
    /// A row that cannot be read, or a recording over 24 hours of 10 kHz ticks long.
    pub fn next_tick(&mut self) -> Result<Option<Tick>, FileError> {
        let tick = self.0.next_tick()?;
        Ok(tick.map(|(time_s, [displacement_m], _)| Tick {
            time_s,
            displacement_m,
        }))
    }

    /// All ticks left.
    ///
    /// # Errors
    /// As [`TickGrid::next_tick`].
    pub fn read_all(mut self) -> Result<Vec<Tick>, FileError> {
        let mut ticks = Vec::new();
        while let Some(tick) = self.next_tick()? {
            ticks.push(tick);
        }
        Ok(ticks)
    }

    /// Displacements (m) at all ticks left.
    ///
    /// # Errors
    /// As [`TickGrid::next_tick`].
    pub fn displacements_m(self) -> Result<Vec<f64>, FileError> {
        let ticks = self.read_all()?;
        Ok(ticks.iter().map(|tick| tick.displacement_m).collect())
    }

    /// Time of the first tick (s).
    pub fn start_s(&self) -> f64 {
        self.0.start_s
    }

    /// The recording, read up to the last tick.
    pub fn recording(&self) -> &Recording {
        &self.0.rows
    }
}

/// A motion and the force measured on it, on ticks: from the first sample to within the last.
pub struct MeasuredGrid(Grid<Measurement, 2>);

impl MeasuredGrid {
    /// The grid of `step_s` (s) over `measurement`.
    ///
    /// # Errors
    /// No readable row.
    pub fn new(measurement: Measurement, step_s: f64) -> Result<Self, FileError> {
        Grid::new(measurement, step_s).map(Self)
    }

    /// The next tick; `None` past the last sample.
    ///
    /// # Errors
    /// As [`TickGrid::next_tick`].
    pub fn next_tick(&mut self) -> Result<Option<MeasuredTick>, FileError> {
        let Some((time_s, [displacement_m, force_n], interval_s)) = self.0.next_tick()? else {
            return Ok(None);
        };
        let known = |value: f64| {
            if self.is_gap(interval_s) {
                f64::NAN
            } else {
                value
            }
        };
        Ok(Some(MeasuredTick {
            time_s,
            displacement_m: known(displacement_m),
            force_n: known(force_n),
        }))
    }

    /// Whether samples are further apart than a logger's own interval and jitter explain.
    fn is_gap(&self, interval_s: f64) -> bool {
        // The median is asked for where it matters.
        interval_s > GAP_IN_MEDIANS * self.0.step_s
            && self
                .measurement()
                .gaps()
                .median_interval_s
                .is_some_and(|median_s| interval_s > GAP_IN_MEDIANS * median_s)
    }

    /// Time of the first tick (s).
    pub fn start_s(&self) -> f64 {
        self.0.start_s
    }

    /// The measurement, read up to the last tick.
    pub fn measurement(&self) -> &Measurement {
        &self.0.rows
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::Channels;

    fn ticks(rows: &str, step_s: f64) -> Vec<(f64, f64)> {
        let text = format!("time_s,displacement_m,force_n\n{rows}");
        let source = Box::new(std::io::Cursor::new(text.into_bytes()));
        let channels = Channels::default();
        let measurement = Measurement::read(Path::new("x.csv"), source, &channels).unwrap();
        let mut ticks = MeasuredGrid::new(measurement, step_s).unwrap();
        let next = || ticks.next_tick().unwrap();
        let pair = |tick: MeasuredTick| (tick.displacement_m, tick.force_n);
        std::iter::from_fn(next).map(pair).collect()
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
