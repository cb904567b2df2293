//! Named signals of a recording, all rows in memory.

use std::io;
use std::path::Path;

use super::RecordingError;
use super::channels::Channels;
use super::open::{Origin, open};
use super::select::{ChannelInfo, label, select_in};
use super::unit::Quantity;
use dashpot_files::{FileError, input};

/// Most numbers that a recording may have, 2 GB: half an hour of a locomotive's signals at 1 ms.
const MAX_NUMBERS: usize = 500_000_000;

/// Signals of a recording that were asked for by their names, in single precision.
///
/// A missing value is NaN, and so is every value of a signal that the recording does not have.
#[derive(Clone, Debug, PartialEq)]
pub struct Signals {
    times_s: Vec<f64>,
    /// Values of the signals found, row by row.
    values: Vec<f32>,
    /// For each signal asked for, its place in a row.
    places: Vec<Option<usize>>,
    found: usize,
}

impl Signals {
    /// Reads a recording; `wanted` are names and units of signals. The time is the master channel or `time_s`.
    ///
    /// # Errors
    /// The file cannot be read, has none of the signals, states another unit for one, has a time that does not
    /// increase, or does not fit into memory.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("run.csv");
    /// std::fs::write(&path, "time_s,b_m,a_n\n0,1,2\n0.001,3,\n")?;
    /// let wanted = [("a_n", "N"), ("missing_n", "N"), ("b_m", "m")];
    /// let signals = dashpot_recording::Signals::read(&path, &wanted)?;
    /// let mut row = Vec::new();
    /// signals.row(0, &mut row);
    /// assert_eq!((signals.times_s(), row[0], row[2]), (&[0.0, 0.001][..], 2.0, 1.0));
    /// assert!(row[1].is_nan());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn read(path: &Path, wanted: &[(&str, &str)]) -> Result<Self, FileError> {
        let channels = Channels::default();
        let mut file = open(Origin::Path(path), &channels)?;
        let name = input::name(path).into_owned();
        let failed = |error: RecordingError| FileError::in_file(&name, error);
        let (indices, places) = find(file.found(), wanted).map_err(failed)?;
        let group = indices.first().map(|index| file.found()[*index].group);
        let [time] = select_in(
            file.found(),
            file.groups(),
            group,
            &channels,
            [Quantity::Time],
        )
        .map_err(failed)?;
        let time_name = label(file.found(), time.index);
        let mut all = vec![time.index];
        all.extend(&indices);
        let mut rows = file.rows(&all, true)?;
        let mut signals = Self {
            times_s: Vec::new(),
            values: Vec::new(),
            places,
            found: indices.len(),
        };
        let mut row = vec![0.0; all.len()];
        while rows.next(&mut row)? {
            let time_s = time.in_si(row[0]);
            let in_time = |error| rows.location().error(&name, &time_name, error);
            if !time_s.is_finite() {
                return Err(in_time(rows.missing(0)));
            }
            if let Some(&before_s) = signals.times_s.last()
                && time_s <= before_s
            {
                return Err(in_time(RecordingError::Time { time_s, before_s }));
            }
            if signals.values.len() + signals.found > MAX_NUMBERS {
                return Err(failed(RecordingError::TooManyRows {
                    rows: signals.times_s.len(),
                    signals: signals.found,
                }));
            }
            signals
                .add(time_s, &row[1..])
                .map_err(|_| FileError::read(&name, io::ErrorKind::OutOfMemory.into()))?;
        }
        match signals.times_s.is_empty() {
            true => Err(failed(RecordingError::NoRow { left_out: 0 })),
            false => Ok(signals),
        }
    }

    fn add(
        &mut self,
        time_s: f64,
        values: &[f64],
    ) -> Result<(), std::collections::TryReserveError> {
        self.times_s.try_reserve(1)?;
        self.values.try_reserve(values.len())?;
        self.times_s.push(time_s);
        let single = values.iter().map(|value| *value as f32);
        // Numbers beyond the range of single precision are missing, like all others that are not finite.
        self.values
            .extend(single.map(|value| if value.is_finite() { value } else { f32::NAN }));
        Ok(())
    }

    /// Time of each row, s; it increases.
    pub fn times_s(&self) -> &[f64] {
        &self.times_s
    }

    /// True for each signal asked for that the recording has.
    pub fn has(&self) -> impl ExactSizeIterator<Item = bool> + '_ {
        self.places.iter().map(Option::is_some)
    }

    /// Puts the values of a row into `values`, in the order in which they were asked for; NaN behind the last row.
    pub fn row(&self, row: usize, values: &mut Vec<f32>) {
        let start = row.saturating_mul(self.found);
        let found = self.values.get(start..start.saturating_add(self.found));
        let value = |place: &Option<usize>| Some(*found?.get((*place)?)?);
        values.clear();
        values.extend(
            self.places
                .iter()
                .map(|place| value(place).unwrap_or(f32::NAN)),
        );
    }
}

/// Unit without the marks of exponents, so that m/s2, m/s^2 and m/s² are the same.
fn plain(unit: &str) -> String {
    unit.replace('^', "").replace('\u{b2}', "2")
}

/// Returns the channels of the signals that the file has, and for each signal wanted the place of its channel among
/// them. All are in the group of the first.
fn find(
    found: &[ChannelInfo],
    wanted: &[(&str, &str)],
) -> Result<(Vec<usize>, Vec<Option<usize>>), RecordingError> {
    let mut indices: Vec<usize> = Vec::new();
    let mut places = Vec::new();
    for (name, unit) in wanted {
        let group = indices.first().map(|index| found[*index].group);
        let is_it = |channel: &ChannelInfo| {
            (channel.name == *name || channel.whole == *name)
                && group.is_none_or(|group| channel.group == group)
                && channel.is_number
                && channel.unread.is_none()
        };
        let Some(index) = found.iter().position(is_it) else {
            places.push(None);
            continue;
        };
        if let Some(stated) = &found[index].unit
            && plain(stated) != plain(unit)
        {
            return Err(RecordingError::SignalUnit {
                channel: label(found, index),
                unit: stated.clone(),
                allowed: (*unit).to_owned(),
            });
        }
        places.push(Some(indices.len()));
        indices.push(index);
    }
    match indices.is_empty() {
        true => Err(RecordingError::NoSignal {
            example: wanted.first().map_or("", |(name, _)| name).to_owned(),
            found: (0..found.len()).map(|index| label(found, index)).collect(),
        }),
        false => Ok((indices, places)),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::Signals;

    fn error_of(text: &str, wanted: &[(&str, &str)]) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        fs::write(&path, text).unwrap();
        let error = Signals::read(&path, wanted).unwrap_err();
        let mut words = error.to_string();
        let mut source = std::error::Error::source(&error);
        while let Some(inner) = source {
            words += &format!(": {inner}");
            source = inner.source();
        }
        words
    }

    #[test]
    fn wrong_files_are_refused_with_the_reason() {
        let force = [("force_n", "N")];
        let error = error_of("time_s,other\n0,1\n", &force);
        assert!(
            error.contains("none of the signals") && error.contains("force_n"),
            "{error}"
        );
        let error = error_of("time_s,force_n\n0,1\n0,2\n", &force);
        assert!(error.contains("does not increase"), "{error}");
        let error = error_of("time_s,force_n\n,1\n", &force);
        assert!(error.contains("time_s"), "{error}");
        let error = error_of("time_s,force_n\n", &force);
        assert!(error.contains("row"), "{error}");
        let error = error_of("time_s,force_n [kN]\n0,1\n", &force);
        assert!(error.contains("kN"), "{error}");
    }

    #[test]
    fn a_row_behind_the_last_is_missing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.csv");
        fs::write(&path, "time_s,force_n\n0,1e300\n1,2\n").unwrap();
        let signals = Signals::read(&path, &[("force_n", "N")]).unwrap();
        let mut row = Vec::new();
        for (number, is_there) in [(0, false), (1, true), (2, false), (usize::MAX, false)] {
            signals.row(number, &mut row);
            assert_eq!((row.len(), row[0].is_finite()), (1, is_there), "{number}");
        }
    }
}
