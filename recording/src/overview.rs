//! What a file has: its channels with their ranges, and how even its times are.

use std::path::Path;

use serde::Serialize;

use super::channels::Channels;
use super::gaps::{Gaps, Intervals};
use super::open::{Origin, open};
use super::opened::Opened;
use super::place::LeftOut;
use super::rows::Source;
use super::select::{Chosen, Found, label, select_in};
use super::unit::Quantity;
use crate::remedy::Remedy;
use dashpot_files::{FileError, input};

/// Channels of a group read at a time: a group may have thousands.
const CHANNELS: usize = 32;

/// What a file has.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Overview {
    /// Its channels, in order.
    pub channels: Vec<ChannelOverview>,
    /// Its times: one, or one for each group.
    pub times: Vec<TimeOverview>,
    /// The last line of a text, where it has no line end and may be cut inside its last number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unended_line: Option<u64>,
}

/// A channel.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ChannelOverview {
    /// Its number, from 1.
    pub number: usize,
    /// Its name, empty where it has none.
    pub name: String,
    /// Its unit as the file tells it.
    pub unit: Option<String>,
    /// Number of its group, from 1, where the file has groups.
    pub group: Option<usize>,
    /// What its values are in the file.
    pub kind: String,
    /// Why they are not read, where they are numbers of another width or at another place than is read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unread: Option<String>,
    /// Rows of the file or of its group.
    pub rows: u64,
    /// Rows without a finite number, or marked invalid.
    pub invalid: u64,
    /// First number, in the unit of the file as the others.
    pub first: Option<f64>,
    /// Last number.
    pub last: Option<f64>,
    /// Smallest number.
    pub min: Option<f64>,
    /// Largest number.
    pub max: Option<f64>,
}

/// A time.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TimeOverview {
    /// Number of the group, from 1, where the file has groups.
    pub group: Option<usize>,
    /// Name of the group.
    pub group_name: Option<String>,
    /// The channel's name or number; `None` where there is none that can be told.
    pub channel: Option<String>,
    /// Why there is none.
    pub reason: Option<String>,
    /// What the user can do about it.
    #[serde(skip)]
    pub remedy: Option<Remedy>,
    /// First and last time (s).
    pub from_to_s: Option<[f64; 2]>,
    /// Intervals over their sum (Hz).
    pub rate_hz: Option<f64>,
    /// Standard deviation of the intervals that are no gaps (s).
    pub jitter_s: Option<f64>,
    /// Greatest deviation of these intervals from their mean (s).
    pub largest_deviation_s: Option<f64>,
    /// Rows whose time does not grow, which `replay` refuses.
    pub not_growing: u64,
    /// Intervals far over the median.
    pub gaps: Option<Gaps>,
}

/// What is found of a time while it is read.
struct Times {
    chosen: Chosen,
    first_s: Option<f64>,
    last_s: f64,
    not_growing: u64,
    intervals: Intervals,
    regular: Regular,
}

/// Mean and spread of the intervals up to [`super::GAP_IN_MEDIANS`] times the mean so far, by Welford's recurrence.
#[derive(Default)]
struct Regular {
    count: u64,
    mean_s: f64,
    squares: f64,
    shortest_s: f64,
    longest_s: f64,
}

/// Reads all of the file at `path`, `-` being standard input.
///
/// # Errors
/// It cannot be read, is damaged or of another kind.
pub fn overview(path: &Path, channels: &Channels) -> Result<Overview, FileError> {
    let mut opened = open(Origin::Path(path), channels)?;
    let found = opened.found().to_vec();
    let groups = opened.groups().to_vec();
    let mut overview = Overview {
        channels: found.iter().enumerate().map(channel).collect(),
        times: Vec::new(),
        unended_line: None,
    };
    for channel in &mut overview.channels {
        channel.group = channel.group.filter(|_| !groups.is_empty());
    }
    for group in 0..groups.len().max(1) {
        let time =
            select_in(&found, &groups, Some(group), channels, [Quantity::Time]).or_else(|error| {
                let named = the_time(&found, group).filter(|_| channels.time.name.is_none());
                let mut channels = channels.clone();
                channels.time.name = Some(named.ok_or(error)?);
                select_in(&found, &groups, Some(group), &channels, [Quantity::Time])
            });
        let (time, error) = match time {
            Ok([chosen]) => (Some(chosen), None),
            Err(error) => (None, Some(error)),
        };
        let mut times = time.map(Times::new);
        let all = || (0..found.len()).filter(|&i| found[i].group == group && found[i].is_number);
        let all: Vec<usize> = all().collect();
        let most = if groups.is_empty() {
            all.len()
        } else {
            CHANNELS
        };
        for indices in all.chunks(most.max(1)) {
            let unended = read(&mut *opened, indices, &mut overview.channels, &mut times)?;
            overview.unended_line = overview.unended_line.or(unended);
        }
        overview.times.push(TimeOverview {
            group: (!groups.is_empty()).then_some(group + 1),
            group_name: groups.get(group).filter(|name| !name.is_empty()).cloned(),
            channel: time.map(|time| label(&found, time.index)),
            reason: error.as_ref().map(ToString::to_string),
            remedy: error.and_then(|error| error.remedy()),
            ..times.map_or_else(TimeOverview::default, Times::overview)
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

/// The number of the one channel of a group that has a unit of time.
fn the_time(found: &[Found], group: usize) -> Option<String> {
    let is_time = |found: &Found| match &found.unit {
        Some(unit) => Quantity::Time.unit(unit).is_some(),
        None => Quantity::Time.unit_in_name(&found.name).is_some(),
    };
    let mut times = (0..found.len()).filter(|&i| found[i].group == group && is_time(&found[i]));
    match (times.next(), times.next()) {
        (Some(index), None) => Some(format!("#{}", index + 1)),
        _ => None,
    }
}

fn channel((index, found): (usize, &Found)) -> ChannelOverview {
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

/// Reads all rows of some channels of one group; the last line, where it has no line end.
fn read(
    opened: &mut dyn Opened,
    indices: &[usize],
    channels: &mut [ChannelOverview],
    times: &mut Option<Times>,
) -> Result<Option<u64>, FileError> {
    let mut source = opened.rows(indices, true)?;
    let mut values = vec![0.0; indices.len()];
    let mut rows = 0;
    while source.next(&mut values)? {
        rows += 1;
        for (index, &value) in indices.iter().zip(&values) {
            channels[*index].take(value);
        }
        if let Some(times) = times
            && let Some(place) = indices.iter().position(|i| *i == times.chosen.index)
        {
            times.take(values[place], &*source);
        }
    }
    for index in indices {
        channels[*index].rows = rows;
    }
    Ok(source.unended_line())
}

impl ChannelOverview {
    fn take(&mut self, value: f64) {
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

impl Times {
    fn new(chosen: Chosen) -> Self {
        Self {
            chosen,
            first_s: None,
            last_s: 0.0,
            not_growing: 0,
            intervals: Intervals::new(),
            regular: Regular::default(),
        }
    }

    fn take(&mut self, value: f64, source: &dyn Source) {
        let time_s = self.chosen.unit.to_si(value);
        if !time_s.is_finite() {
            return;
        }
        if self.first_s.is_none() {
            self.first_s = Some(time_s);
        } else if time_s > self.last_s {
            self.intervals.add(self.last_s, time_s, || source.place());
            self.regular.take(time_s - self.last_s);
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

impl Regular {
    fn take(&mut self, interval_s: f64) {
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
