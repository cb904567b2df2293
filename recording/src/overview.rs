//! Overview of a file: its channels with their ranges, and the regularity of its times.

use std::path::Path;

use serde::Serialize;

use super::channels::Channels;
use super::gaps::{Gaps, Intervals};
use super::location::LeftOut;
use super::notes::UnfinishedEnd;
use super::open::{Origin, open};
use super::recording_file::RecordingFile;
use super::rows::Source;
use super::select::{ChannelInfo, SelectedChannel, label, select_in};
use super::unit::Quantity;
use crate::remedy::Remedy;
use dashpot_files::{FileError, input};

/// Number of channels of a group that are read at a time; a group may have thousands of channels.
const CHANNELS: usize = 32;

/// Overview of a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Overview {
    /// Channels, in the order of the file.
    pub channels: Vec<ChannelOverview>,
    /// Time channels: one per group, or one in all if the file has no groups.
    pub times: Vec<TimeOverview>,
    /// Number of the last line if the text does not end with a line end. The last number of this line may be cut off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unended_line: Option<u64>,
    /// End of the rows if the file is an unfinished MDF4 file, which is read up to the last whole row.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unfinished: Option<UnfinishedEnd>,
}

/// Overview of one channel.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ChannelOverview {
    /// Number, from 1.
    pub number: usize,
    /// Name; empty if the channel has none.
    pub name: String,
    /// Unit as stated in the file.
    pub unit: Option<String>,
    /// Number of the channel's group, from 1; `None` if the file has no groups.
    pub group: Option<usize>,
    /// Type of the values in the file.
    pub kind: String,
    /// Reason why the numbers cannot be read: an unsupported width or bit position; `None` if they can be read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unread: Option<String>,
    /// Number of rows in the file or the group.
    pub rows: u64,
    /// Number of rows that are marked invalid or have no finite number.
    pub invalid: u64,
    /// First number. It is in the unit of the file, as are `last`, `min` and `max`.
    pub first: Option<f64>,
    /// Last number.
    pub last: Option<f64>,
    /// Minimum.
    pub min: Option<f64>,
    /// Maximum.
    pub max: Option<f64>,
}

/// Overview of a time channel.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TimeOverview {
    /// Number of the group, from 1; `None` if the file has no groups.
    pub group: Option<usize>,
    /// Name of the group.
    pub group_name: Option<String>,
    /// Name or number of the channel; `None` if no time channel was found.
    pub channel: Option<String>,
    /// Reason why no time channel was found.
    pub reason: Option<String>,
    /// Suggested remedy.
    #[serde(skip)]
    pub remedy: Option<Remedy>,
    /// First and last time (s), in this order.
    pub from_to_s: Option<[f64; 2]>,
    /// Sampling rate (Hz): inverse of the mean regular interval.
    pub rate_hz: Option<f64>,
    /// Standard deviation of the regular intervals (s).
    pub jitter_s: Option<f64>,
    /// Largest deviation of a regular interval from the mean (s).
    pub largest_deviation_s: Option<f64>,
    /// Number of rows whose time does not increase; such a recording cannot be replayed.
    pub not_growing: u64,
    /// Intervals much longer than the median.
    pub gaps: Option<Gaps>,
}

/// Statistics of a time channel while it is read.
struct TimeScan {
    chosen: SelectedChannel,
    first_s: Option<f64>,
    last_s: f64,
    not_growing: u64,
    intervals: Intervals,
    regular: RegularIntervals,
}

/// Mean and spread of the regular intervals (those up to [`super::GAP_IN_MEDIANS`] times the running mean), computed
/// with Welford's method.
#[derive(Default)]
struct RegularIntervals {
    count: u64,
    mean_s: f64,
    squares: f64,
    shortest_s: f64,
    longest_s: f64,
}

/// Reads the whole file at `path` (`-` for standard input) and returns its overview.
///
/// # Errors
/// Returns an error if the file is unreadable, damaged or in an unsupported format.
pub fn overview(path: &Path, channels: &Channels) -> Result<Overview, FileError> {
    let mut opened = open(Origin::Path(path), channels)?;
    let found = opened.found().to_vec();
    let groups = opened.groups().to_vec();
    let mut overview = Overview {
        channels: found.iter().enumerate().map(channel).collect(),
        times: Vec::new(),
        unended_line: None,
        unfinished: None,
    };
    for channel in &mut overview.channels {
        channel.group = channel.group.filter(|_| !groups.is_empty());
    }
    for group in 0..groups.len().max(1) {
        let time =
            select_in(&found, &groups, Some(group), channels, [Quantity::Time]).or_else(|error| {
                let channel =
                    only_time_channel(&found, group).filter(|_| channels.time.name.is_none());
                let mut channels = channels.clone();
                channels.time.name = Some(channel.ok_or(error)?);
                select_in(&found, &groups, Some(group), &channels, [Quantity::Time])
            });
        let (time, error) = match time {
            Ok([chosen]) => (Some(chosen), None),
            Err(error) => (None, Some(error)),
        };
        let mut times = time.map(TimeScan::new);
        let numeric: Vec<usize> = (0..found.len())
            .filter(|&i| found[i].group == group && found[i].is_number)
            .collect();
        let batch_size = if groups.is_empty() {
            numeric.len()
        } else {
            CHANNELS
        };
        for indices in numeric.chunks(batch_size.max(1)) {
            let source = read(&mut *opened, indices, &mut overview.channels, &mut times)?;
            overview.unended_line = overview.unended_line.or(source.unended_line());
            overview.unfinished = overview.unfinished.or(source.unfinished());
        }
        overview.times.push(TimeOverview {
            group: (!groups.is_empty()).then_some(group + 1),
            group_name: groups.get(group).filter(|name| !name.is_empty()).cloned(),
            channel: time.map(|time| label(&found, time.index)),
            reason: error.as_ref().map(ToString::to_string),
            remedy: error.and_then(|error| error.remedy()),
            ..times.map_or_else(TimeOverview::default, TimeScan::overview)
        });
    }
    for (channel, found) in overview.channels.iter_mut().zip(&found) {
        channel.kind = match (found.kind.as_str(), channel.first) {
            ("text", Some(_)) if found.is_number => "number".into(),
            (kind, _) => kind.to_owned(),
        };
    }
    if overview.channels.iter().all(|channel| channel.rows == 0) {
        let error = super::RecordingError::NoRow { left_out: 0 };
        return Err(FileError::in_file(&input::name(path), error));
    }
    Ok(overview)
}

/// Returns the number, such as `#2`, of the only channel of the group that has a unit of time; `None` if there are none
/// or several.
fn only_time_channel(found: &[ChannelInfo], group: usize) -> Option<String> {
    let is_time = |found: &ChannelInfo| match &found.unit {
        Some(unit) => Quantity::Time.unit(unit).is_some(),
        None => Quantity::Time.unit_in_name(&found.name).is_some(),
    };
    let mut times = (0..found.len()).filter(|&i| found[i].group == group && is_time(&found[i]));
    match (times.next(), times.next()) {
        (Some(index), None) => Some(format!("#{}", index + 1)),
        _ => None,
    }
}

fn channel((index, found): (usize, &ChannelInfo)) -> ChannelOverview {
    ChannelOverview {
        number: index + 1,
        name: found.name.clone(),
        unit: found.unit.clone(),
        unread: found
            .unread
            .as_ref()
            .map(|unread| format!("{}, allowed: {}", unread.held, unread.allowed)),
        group: Some(found.group + 1),
        rows: found.rows.unwrap_or(0),
        ..ChannelOverview::default()
    }
}

/// Reads all rows of some channels of one group and returns their source at its end.
fn read(
    opened: &mut dyn RecordingFile,
    indices: &[usize],
    channels: &mut [ChannelOverview],
    times: &mut Option<TimeScan>,
) -> Result<Box<dyn Source>, FileError> {
    let mut source = opened.rows(indices, true)?;
    let mut values = vec![0.0; indices.len()];
    let mut rows = 0;
    while source.next(&mut values)? {
        rows += 1;
        for (index, &value) in indices.iter().zip(&values) {
            channels[*index].record(value);
        }
        if let Some(times) = times
            && let Some(index) = indices.iter().position(|i| *i == times.chosen.index)
        {
            times.record(values[index], &*source);
        }
    }
    for index in indices {
        channels[*index].rows = rows;
    }
    Ok(source)
}

impl ChannelOverview {
    fn record(&mut self, value: f64) {
        if !value.is_finite() {
            self.invalid += 1;
            return;
        }
        self.first.get_or_insert(value);
        self.last = Some(value);
        self.min = Some(self.min.map_or(value, |min| min.min(value)));
        self.max = Some(self.max.map_or(value, |max| max.max(value)));
    }
}

impl TimeScan {
    fn new(chosen: SelectedChannel) -> Self {
        Self {
            chosen,
            first_s: None,
            last_s: 0.0,
            not_growing: 0,
            intervals: Intervals::new(),
            regular: RegularIntervals::default(),
        }
    }

    fn record(&mut self, value: f64, source: &dyn Source) {
        let time_s = self.chosen.unit.to_si(value);
        if !time_s.is_finite() {
            return;
        }
        if self.first_s.is_none() {
            self.first_s = Some(time_s);
        } else if time_s > self.last_s {
            self.intervals
                .add(self.last_s, time_s, || source.location());
            self.regular.record(time_s - self.last_s);
        } else {
            self.not_growing += 1;
            return;
        }
        self.last_s = time_s;
    }

    fn overview(self) -> TimeOverview {
        let gaps = self.intervals.gaps(LeftOut::default());
        let regular = &self.regular;
        let has_intervals = regular.count > 0;
        let spread_s = (regular.squares / regular.count.max(1) as f64).sqrt();
        let deviation_s =
            (regular.longest_s - regular.mean_s).max(regular.mean_s - regular.shortest_s);
        TimeOverview {
            from_to_s: self.first_s.map(|first_s| [first_s, self.last_s]),
            rate_hz: has_intervals.then(|| 1.0 / regular.mean_s),
            jitter_s: has_intervals.then_some(spread_s),
            largest_deviation_s: has_intervals.then_some(deviation_s),
            not_growing: self.not_growing,
            gaps: Some(gaps),
            ..TimeOverview::default()
        }
    }
}

impl RegularIntervals {
    fn record(&mut self, interval_s: f64) {
        if self.count > 0 && interval_s > super::GAP_IN_MEDIANS * self.mean_s {
            return;
        }
        self.count += 1;
        let deviation_s = interval_s - self.mean_s;
        self.mean_s += deviation_s / self.count as f64;
        self.squares += deviation_s * (interval_s - self.mean_s);
        self.longest_s = self.longest_s.max(interval_s);
        self.shortest_s = match self.count {
            1 => interval_s,
            _ => self.shortest_s.min(interval_s),
        };
    }
}
