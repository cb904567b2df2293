//! Reads MDF4 files in blocks of bounded size.

mod blocks;
mod chain;
mod finished;
mod number;
mod records;
mod stored;
mod unfinished;
mod view;

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use falcon_mdf::io::range::RangeSource;
use falcon_mdf::{Channel, ChannelGroup, Mf4Error, Mf4File, OpenOptions, SignalsChunks};
use self_cell::self_cell;

use super::error::RecordingError;
use super::location::RowLocation;
use super::notes::UnfinishedEnd;
use super::recording_file::RecordingFile;
use super::rows::Source;
use super::select::ChannelInfo;
use blocks::CYCLE_COUNT;
use dashpot_files::FileError;
use finished::Finished;
use number::{Reading, reading};

/// Rows read at a time.
const ROWS: usize = 1 << 14;

/// Maximum number of bytes of records that the library keeps from its scan of unsorted records.
const MAX_KEPT: usize = 4 << 20;

/// An MDF4 file with known channels.
pub(super) struct Mdf {
    path: PathBuf,
    file: Arc<Mf4File>,
    found: Vec<ChannelInfo>,
    groups: Vec<String>,
    /// Position of each channel in the file.
    paths: Vec<ChannelPath>,
    readings: Vec<Reading>,
    bytes: u64,
    unfinished: Option<UnfinishedEnd>,
}

/// Position of a channel in the file, as indices.
#[derive(Clone, Copy)]
struct ChannelPath {
    data_group: usize,
    channel_group: usize,
    channel: usize,
}

self_cell!(
    struct Chunks {
        owner: Arc<Mf4File>,
        #[not_covariant]
        dependent: SignalsChunks,
    }
);

/// Rows of the selected channels.
struct MdfRows {
    path: PathBuf,
    chunks: Chunks,
    channels: Vec<(Channel, Reading)>,
    /// Values of each channel; NaN if invalid.
    values: Vec<Vec<f64>>,
    /// Flags of invalid rows for each channel; empty if the channel has none.
    invalid: Vec<Vec<bool>>,
    next: usize,
    row: u64,
    rows: u64,
    bytes: u64,
    unfinished: Option<UnfinishedEnd>,
}

impl Mdf {
    /// Reads the list of channels.
    pub(super) fn open(path: &Path, file: File) -> Result<Self, FileError> {
        let bytes = file.metadata().map_or(0, |data| data.len());
        let failed = |error: Mf4Error| damaged(path, &error);
        let finished = Finished::new(file).map_err(|error| failed(error.into()))?;
        let Finished { view, unfinished } =
            finished.map_err(|error| FileError::in_file(path, error))?;
        let source = RangeSource::new(view.end(), move |offset, buffer: &mut [u8]| {
            Ok(view.read(offset, buffer)?)
        });
        let options = OpenOptions {
            max_alloc: MAX_KEPT,
            ..OpenOptions::default()
        };
        let file = Mf4File::from_source_with_options(Arc::new(source), options).map_err(failed)?;
        let (mut found, mut paths, mut groups) = (Vec::new(), Vec::new(), Vec::new());
        let mut readings = Vec::new();
        for group in file
            .data_groups()
            .iter()
            .flat_map(|data| &data.channel_groups)
        {
            if group.is_vlsd() {
                continue;
            }
            let number = groups.len();
            groups.push(group.acquisition_name.clone());
            for (index, channel) in group.channels.iter().enumerate() {
                paths.push(ChannelPath {
                    data_group: group.data_group_index,
                    channel_group: group.index,
                    channel: index,
                });
                let reading = reading(channel, group);
                readings.push(reading.clone().unwrap_or(Reading::Library));
                found.push(ChannelInfo {
                    name: channel.name.clone(),
                    whole: channel.name.clone(),
                    unit: Some(unit(channel)).filter(|unit| !unit.is_empty()),
                    group: number,
                    is_master: channel.is_time_channel(),
                    kind: kind(channel),
                    is_instant: false,
                    is_number: is_number(channel) && reading.is_ok(),
                    unread: reading.err().filter(|_| is_number(channel)),
                    rows: Some(group.sample_count),
                });
            }
        }
        Ok(Self {
            path: path.to_owned(),
            file: Arc::new(file),
            found,
            groups,
            paths,
            readings,
            bytes,
            unfinished,
        })
    }

    /// Returns the declared number of rows of a group. The library silently reads fewer rows if data are missing, so
    /// this compares the declared number with the number that the library finds.
    fn check_rows(&self, group: &ChannelGroup) -> Result<u64, FileError> {
        let offset = group.block_offset() + CYCLE_COUNT;
        let bytes = self.file.read_raw(offset, 8);
        let bytes = bytes.map_err(|error| damaged(&self.path, &error))?;
        let declared = bytes
            .first_chunk::<8>()
            .map_or(0, |b| u64::from_le_bytes(*b));
        if declared != group.sample_count {
            return Err(FileError::in_file(
                &self.path,
                RecordingError::CutOff {
                    declared,
                    found: group.sample_count,
                },
            ));
        }
        Ok(declared)
    }
}

impl RecordingFile for Mdf {
    fn found(&self) -> &[ChannelInfo] {
        &self.found
    }

    fn groups(&self) -> &[String] {
        &self.groups
    }

    fn rows(&mut self, indices: &[usize], _: bool) -> Result<Box<dyn Source>, FileError> {
        let groups = self.file.data_groups();
        let mut rows = 0;
        let mut channels: Vec<(Channel, Reading)> = Vec::new();
        for index in indices {
            let path = self.paths[*index];
            let group = &groups[path.data_group].channel_groups[path.channel_group];
            rows = self.check_rows(group)?;
            channels.push((group.channels[path.channel].clone(), self.readings[*index]));
        }
        let requested: Vec<Channel> = channels
            .iter()
            .map(|(channel, reading)| reading.requested(channel))
            .collect();
        let chunks = Chunks::try_new(Arc::clone(&self.file), |file| {
            file.signals_chunks(&requested, ROWS)
        })
        .map_err(|error| damaged(&self.path, &error))?;
        Ok(Box::new(MdfRows {
            path: self.path.clone(),
            chunks,
            channels,
            values: vec![Vec::new(); indices.len()],
            invalid: vec![Vec::new(); indices.len()],
            next: 0,
            row: 0,
            rows,
            bytes: self.bytes,
            unfinished: self.unfinished,
        }))
    }
}

impl MdfRows {
    /// Reads the next block of rows; returns `false` at the end.
    fn read(&mut self) -> Result<bool, FileError> {
        let path = &self.path;
        let failed = |error: Mf4Error| damaged(path, &error);
        let chunk = self.chunks.with_dependent_mut(|_, chunks| chunks.next());
        let Some(signals) = chunk.transpose().map_err(failed)? else {
            if self.row < self.rows {
                return Err(FileError::in_file(
                    &self.path,
                    RecordingError::CutOff {
                        declared: self.rows,
                        found: self.row,
                    },
                ));
            }
            return Ok(false);
        };
        for (index, signal) in signals.iter().enumerate() {
            let (channel, reading) = &self.channels[index];
            self.values[index] = reading.numbers(signal, channel, self.row).map_err(failed)?;
            self.invalid[index].clear();
            if let Some(valid) = signal.validity() {
                for (value, valid) in self.values[index].iter_mut().zip(&valid) {
                    if !valid {
                        *value = f64::NAN;
                    }
                }
                self.invalid[index] = valid.iter().map(|valid| !valid).collect();
            }
        }
        self.next = 0;
        Ok(true)
    }
}

impl Source for MdfRows {
    fn next(&mut self, values: &mut [f64]) -> Result<bool, FileError> {
        while self
            .values
            .first()
            .is_none_or(|first| self.next >= first.len())
        {
            if !self.read()? {
                return Ok(false);
            }
        }
        for (value, column) in values.iter_mut().zip(&self.values) {
            *value = column.get(self.next).copied().unwrap_or(f64::NAN);
        }
        self.next += 1;
        self.row += 1;
        Ok(true)
    }

    fn missing(&self, index: usize) -> RecordingError {
        let row = self.next.saturating_sub(1);
        if self.invalid[index].get(row) == Some(&true) {
            RecordingError::Invalid
        } else {
            RecordingError::NotFinite {
                cell: self.values[index]
                    .get(row)
                    .map_or_else(String::new, f64::to_string),
            }
        }
    }

    fn location(&self) -> RowLocation {
        RowLocation::Row(self.row)
    }

    fn unfinished(&self) -> Option<UnfinishedEnd> {
        self.unfinished
    }

    fn position(&self) -> u64 {
        (self.bytes as f64 * (self.row as f64 / self.rows.max(1) as f64)) as u64
    }
}

fn damaged(path: &Path, error: &Mf4Error) -> FileError {
    FileError::in_file(
        path,
        RecordingError::Damaged {
            kind: "MDF4",
            reason: error.to_string(),
        },
    )
}

/// Returns the unit. According to the standard, a time master without a unit is in seconds.
fn unit(channel: &Channel) -> String {
    if channel.unit.is_empty() && channel.is_time_channel() {
        "s".into()
    } else {
        channel.unit.trim_end_matches('\0').trim().to_owned()
    }
}

fn is_number(channel: &Channel) -> bool {
    channel.value_kind().is_numeric() && !channel.is_array() && channel.unreadable().is_none()
}

fn kind(channel: &Channel) -> String {
    if channel.is_array() {
        "array".into()
    } else if channel.is_float() && channel.value_kind() == channel.raw_value_kind() {
        format!("f{}", channel.bit_count)
    } else {
        channel.value_kind().name().to_owned()
    }
}
