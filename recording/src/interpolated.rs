//! A force that was sampled at other times than the displacement, interpolated linearly to the times of the
//! displacement.

use std::path::{Path, PathBuf};

use super::error::RecordingError;
use super::location::RowLocation;
use super::notes::{Interpolation, UnfinishedEnd};
use super::rows::Source;
use super::select::SelectedChannel;
use dashpot_files::FileError;

/// A channel of the force's group, with its name in errors.
pub(super) struct NamedChannel {
    pub(super) name: String,
    pub(super) chosen: SelectedChannel,
}

/// The samples of the force.
pub(super) struct Force {
    pub(super) source: Box<dyn Source>,
    pub(super) time: NamedChannel,
    pub(super) force: NamedChannel,
    /// True if missing samples are omitted; otherwise they are errors.
    pub(super) skip_invalid: bool,
    /// Position of the force in a row.
    pub(super) position: usize,
}

/// Rows of a group and, in each of them, a force from another group.
pub(super) struct Interpolated {
    path: PathBuf,
    /// Labels of the groups of the displacement and the force.
    groups: [String; 2],
    main: Box<dyn Source>,
    time: SelectedChannel,
    row: Vec<f64>,
    force: Force,
    /// First and last time of the rows of the main group (s).
    main_s: Option<[f64; 2]>,
    /// First time of the force (s).
    first_s: Option<f64>,
    before: Option<Load>,
    after: Option<Load>,
    given: u64,
    interpolation: Interpolation,
}

/// A sample of the force, in the unit of the file.
#[derive(Clone, Copy)]
struct Load {
    time_s: f64,
    force: f64,
}

impl Interpolated {
    /// `main` has the rows without the force, beginning with the time; `groups` are the numbers (from 0) and labels of
    /// the groups of the displacement and the force.
    pub(super) fn new(
        path: &Path,
        main: Box<dyn Source>,
        time: SelectedChannel,
        columns: usize,
        force: Force,
        groups: [(usize, String); 2],
    ) -> Self {
        let [(displacement_group, displacement), (force_group, load)] = groups;
        Self {
            path: path.to_owned(),
            groups: [displacement, load],
            main,
            time,
            row: vec![0.0; columns - 1],
            force,
            main_s: None,
            first_s: None,
            before: None,
            after: None,
            given: 0,
            interpolation: Interpolation {
                displacement_group: displacement_group + 1,
                force_group: force_group + 1,
                outside: 0,
                left_out: 0,
                longest_interval_s: None,
            },
        }
    }

    /// Moves on to the next sample of the force; `after` is `None` at the end.
    fn advance(&mut self) -> Result<(), FileError> {
        self.before = self.after.take().or(self.before);
        let mut numbers = [0.0; 2];
        while self.force.source.next(&mut numbers)? {
            let channels = [&self.force.time, &self.force.force];
            let time_s = self.force.time.chosen.in_si(numbers[0]);
            let missing = [time_s, numbers[1]]
                .iter()
                .position(|value| !value.is_finite());
            let failed = |index: usize, error| {
                let location = self.force.source.location();
                Err(location.error(&self.path, &channels[index].name, error))
            };
            match missing {
                Some(_) if self.force.skip_invalid => {
                    self.interpolation.left_out += 1;
                    continue;
                }
                Some(index) => return failed(index, self.force.source.missing(index)),
                None => {}
            }
            if let Some(Load {
                time_s: before_s, ..
            }) = self.before
                && time_s <= before_s
            {
                return failed(0, RecordingError::Time { time_s, before_s });
            }
            self.first_s.get_or_insert(time_s);
            self.after = Some(Load {
                time_s,
                force: numbers[1],
            });
            break;
        }
        Ok(())
    }

    /// Returns the force at a time; `None` before its first and after its last sample.
    fn force_at(&mut self, time_s: f64) -> Result<Option<f64>, FileError> {
        if self.first_s.is_none() {
            self.advance()?;
        }
        while self.after.is_some_and(|after| after.time_s < time_s) {
            self.advance()?;
        }
        Ok(match (self.before, self.after) {
            (_, Some(after)) if after.time_s == time_s => Some(after.force),
            (Some(before), Some(after)) if before.time_s <= time_s => {
                let interval_s = after.time_s - before.time_s;
                let longest_s = &mut self.interpolation.longest_interval_s;
                *longest_s = Some(longest_s.map_or(interval_s, |longest| longest.max(interval_s)));
                let share = (time_s - before.time_s) / interval_s;
                Some(before.force + (after.force - before.force) * share)
            }
            // The time of the displacement went back, which is an error of its own.
            (Some(before), _) if time_s <= before.time_s => Some(before.force),
            _ => None,
        })
    }

    /// Returns the error for groups without common times.
    fn apart(&mut self) -> Result<RecordingError, FileError> {
        while self.after.is_some() {
            self.advance()?;
        }
        let [displacement, force] = self.groups.clone();
        let last_s = self.before.map(|before| before.time_s);
        Ok(RecordingError::Apart {
            displacement,
            displacement_s: self.main_s.map(|[first, last]| first..=last),
            force,
            force_s: self.first_s.zip(last_s).map(|(first, last)| first..=last),
        })
    }
}

impl Source for Interpolated {
    fn next(&mut self, values: &mut [f64]) -> Result<bool, FileError> {
        let force = loop {
            if !self.main.next(&mut self.row)? {
                if self.given == 0 && self.main_s.is_some() {
                    let error = self.apart()?;
                    return Err(FileError::in_file(&self.path, error));
                }
                return Ok(false);
            }
            let time_s = self.time.in_si(self.row[0]);
            if !time_s.is_finite() {
                // The row is rejected for its time, whatever the force.
                break 0.0;
            }
            let [first_s, _] = self.main_s.unwrap_or([time_s; 2]);
            self.main_s = Some([first_s, time_s]);
            match self.force_at(time_s)? {
                Some(force) => {
                    self.given += 1;
                    break force;
                }
                None => self.interpolation.outside += 1,
            }
        };
        let mut own = self.row.iter();
        for (position, value) in values.iter_mut().enumerate() {
            *value = match position == self.force.position {
                true => force,
                false => own.next().copied().unwrap_or(f64::NAN),
            };
        }
        Ok(true)
    }

    fn missing(&self, index: usize) -> RecordingError {
        self.main
            .missing(index - usize::from(index > self.force.position))
    }

    fn location(&self) -> RowLocation {
        self.main.location()
    }

    fn position(&self) -> u64 {
        self.main.position()
    }

    fn unfinished(&self) -> Option<UnfinishedEnd> {
        self.main.unfinished()
    }

    fn interpolation(&self) -> Option<Interpolation> {
        Some(self.interpolation)
    }
}
