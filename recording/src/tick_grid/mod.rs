//! Recordings resampled to the ticks of a fixed step.

mod rows;

use std::collections::VecDeque;

use self::rows::{Row, Rows};
use crate::{GAP_IN_MEDIANS, MAX_GAP_TICKS, MAX_TICKS, Measurement, Recording, RecordingError};
use dashpot_files::FileError;

/// One tick of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Time (s): the time of the first sample plus a whole number of steps.
    pub time_s: f64,
    /// Displacement (m), linear between samples.
    pub displacement_m: f64,
}

/// One tick of a motion with the measured force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredTick {
    /// Time (s): the time of the first sample plus a whole number of steps.
    pub time_s: f64,
    /// Displacement (m), linear between samples; NaN in a gap.
    pub displacement_m: f64,
    /// Force (N), linear between samples; NaN in a gap.
    pub force_n: f64,
}

/// Longest gap (ticks) that is filled without first checking the rows after it. At a longer gap, the clock of the
/// logger may have jumped forward and back.
const LOOK_AHEAD_TICKS: f64 = 1e3;

/// Number of rows to check after a long gap: one second of a logger at 1 kHz.
const LOOK_AHEAD_ROWS: usize = 1000;

/// One tick: values interpolated between two rows.
struct GridTick<const N: usize> {
    time_s: f64,
    values: [f64; N],
    /// Interval between the surrounding rows (s); 0 if the tick is at a row.
    interval_s: f64,
}

/// Returns the maximum rounding error (s) between a tick at `time_s` (s) with step `step_s` (s) and a sample recorded
/// for that tick.
pub fn rounding_s(time_s: f64, step_s: f64) -> f64 {
    1e-9 * step_s + 4.0 * f64::EPSILON * time_s.abs()
}

/// Resamples rows to ticks from the first row up to the last row, linear between rows.
struct Grid<R, const N: usize> {
    rows: R,
    step_s: f64,
    start_s: f64,
    number: u64,
    before: Row<N>,
    after: Row<N>,
    /// Later rows that have already been read.
    ahead: VecDeque<Row<N>>,
    /// Time of the last row read (s).
    read_s: f64,
}

impl<R: Rows<N>, const N: usize> Grid<R, N> {
    fn new(mut rows: R, step_s: f64) -> Result<Self, FileError> {
        let first = rows
            .next_row()?
            .ok_or_else(|| rows.in_file(RecordingError::NoRow { left_out: 0 }))?;
        Ok(Self {
            rows,
            step_s,
            start_s: first.time_s,
            number: 0,
            before: first,
            after: first,
            ahead: VecDeque::new(),
            read_s: first.time_s,
        })
    }

    /// Reads the following rows, so that their errors are reported before a gap is filled.
    fn look_ahead(&mut self) -> Result<(), FileError> {
        while self.ahead.len() < LOOK_AHEAD_ROWS {
            let Some(row) = self.read_row()? else {
                break;
            };
            self.ahead.push_back(row);
        }
        Ok(())
    }

    /// Reads the next row and checks that its time is not too long after that of the previous row, or of the first row.
    fn read_row(&mut self) -> Result<Option<Row<N>>, FileError> {
        let Some(next) = self.rows.next_row()? else {
            return Ok(None);
        };
        let (before_s, time_s) = (self.read_s, next.time_s);
        let ticks = (time_s - before_s) / self.step_s;
        if time_s - self.start_s > MAX_TICKS * self.step_s {
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

    fn next_tick(&mut self) -> Result<Option<GridTick<N>>, FileError> {
        let offset_s = self.number as f64 * self.step_s;
        let time_s = self.start_s + offset_s;
        // Rounding may place the sample of a tick slightly before the tick.
        let slack_s = rounding_s(time_s, self.step_s);
        while self.after.time_s + slack_s < time_s {
            let next = match self.ahead.pop_front() {
                Some(next) => Some(next),
                None => self.read_row()?,
            };
            let Some(next) = next else {
                return Ok(None);
            };
            if next.time_s - self.after.time_s > LOOK_AHEAD_TICKS * self.step_s {
                self.look_ahead()?;
            }
            self.before = self.after;
            self.after = next;
        }
        self.number += 1;
        let (before, after) = (self.before, self.after);
        if time_s + slack_s >= after.time_s {
            return Ok(Some(GridTick {
                time_s,
                values: after.values,
                interval_s: 0.0,
            }));
        }
        let interval_s = after.time_s - before.time_s;
        let fraction = (time_s - before.time_s) / interval_s;
        let (from, to) = (before.values, after.values);
        let between = |index: usize| from[index] + fraction * (to[index] - from[index]);
        Ok(Some(GridTick {
            time_s,
            values: std::array::from_fn(between),
            interval_s,
        }))
    }
}

/// A recorded motion resampled to ticks, from its first sample up to its last.
pub struct TickGrid(Grid<Recording, 1>);

impl TickGrid {
    /// Resamples `recording` to ticks of `step_s` (s).
    ///
    /// # Errors
    /// Returns an error if the first row is missing or invalid.
    pub fn new(recording: Recording, step_s: f64) -> Result<Self, FileError> {
        Grid::new(recording, step_s).map(Self)
    }

    /// Returns the next tick; `None` after the last sample.
    ///
    /// # Errors
    /// Returns an error if a row is invalid, or if the recording has more ticks than 24 hours at 10 kHz.
    pub fn next_tick(&mut self) -> Result<Option<Tick>, FileError> {
        let tick = self.0.next_tick()?;
        Ok(tick.map(|tick| Tick {
            time_s: tick.time_s,
            displacement_m: tick.values[0],
        }))
    }

    /// Returns all remaining ticks.
    ///
    /// # Errors
    /// Same errors as [`TickGrid::next_tick`].
    pub fn read_all(mut self) -> Result<Vec<Tick>, FileError> {
        let mut ticks = Vec::new();
        while let Some(tick) = self.next_tick()? {
            ticks.push(tick);
        }
        Ok(ticks)
    }

    /// Returns the displacements (m) at all remaining ticks.
    ///
    /// # Errors
    /// Same errors as [`TickGrid::next_tick`].
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

/// A recorded motion and force resampled to ticks, from the first sample up to the last.
pub struct MeasuredGrid(Grid<Measurement, 2>);

impl MeasuredGrid {
    /// Resamples `measurement` to ticks of `step_s` (s).
    ///
    /// # Errors
    /// Returns an error if the first row is missing or invalid.
    pub fn new(measurement: Measurement, step_s: f64) -> Result<Self, FileError> {
        Grid::new(measurement, step_s).map(Self)
    }

    /// Returns the next tick; `None` after the last sample.
    ///
    /// # Errors
    /// Same errors as [`TickGrid::next_tick`].
    pub fn next_tick(&mut self) -> Result<Option<MeasuredTick>, FileError> {
        let Some(tick) = self.0.next_tick()? else {
            return Ok(None);
        };
        let [displacement_m, force_n] = tick.values;
        let known = |value: f64| {
            if self.is_gap(tick.interval_s) {
                f64::NAN
            } else {
                value
            }
        };
        Ok(Some(MeasuredTick {
            time_s: tick.time_s,
            displacement_m: known(displacement_m),
            force_n: known(force_n),
        }))
    }

    /// True if an interval between samples is longer than jitter of the logger can explain.
    fn is_gap(&self, interval_s: f64) -> bool {
        // Compute the median only for intervals that may be gaps.
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
        // If the ticks coincide with the rows, the values are bit-identical to the file.
        assert_eq!(
            ticks("0,0.1,7\n0.001,0.3,8\n0.002,0.7,9\n", 1e-3)[1],
            (0.3, 8.0)
        );
    }

    #[test]
    fn ticks_in_a_gap_are_nan() {
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
        // Regular intervals longer than a tick are not gaps.
        let slow: String = (0..20)
            .map(|row| format!("{},0.5,100\n", 0.01 * f64::from(row)))
            .collect();
        assert!(ticks(&slow, 1e-3).iter().all(|(x, _)| *x == 0.5));
    }
}
