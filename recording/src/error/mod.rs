//! What can be wrong with a recording. The texts name no option or argument: [`RecordingError::remedy`] says what the
//! user can do, and each front end says it in its own words.

mod remedy;
mod words;

use super::text::{DecimalMark, Separator};
use super::unit::Quantity;
use words::{decimal_comma, listed, missing, numbered_list};

/// Most ticks that a recording may span: 24 hours at 10 kHz, so that one mistyped time does not fill a disk.
pub(crate) const MOST_TICKS: f64 = 864e6;

/// Most ticks between two samples, 1000 s at 10 kHz: more is a jump of the clock, which would fill a disk with ticks on
/// a straight line.
pub(crate) const MAX_GAP_TICKS: f64 = 1e7;

/// What is wrong with a recording; the file, and the line and column where there is one, are
/// in [`FileError`](dashpot_files::FileError).
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// The file holds nothing.
    #[error(
        "empty; a header such as `time_s,displacement_m` or `time_s,force_n`, and at least one row, are needed"
    )]
    Empty,
    /// The file is of a kind that is not read.
    #[error("it is {kind}; read are text (CSV), MDF4 and Parquet, compressed with gzip or not")]
    Kind {
        /// Its kind.
        kind: &'static str,
    },
    /// The file is of a kind that this build does not read.
    #[error("it is {kind}, which this build does not read: build it with the feature `{feature}`")]
    Feature {
        /// Its kind.
        kind: &'static str,
        /// The feature of the crate.
        feature: &'static str,
    },
    /// Several channels have the name.
    #[error("column {column} is in the header {times} times; choose one by its number, such as 2")]
    RepeatedColumn {
        /// Name of the column.
        column: String,
        /// How many there are.
        times: usize,
    },
    /// A channel that is needed is not there.
    #[error("{}", missing(*quantity, name, *numbered, found))]
    MissingChannel {
        /// What it measures.
        quantity: Quantity,
        /// Its name.
        name: String,
        /// Whether the channels of the file have no names.
        numbered: bool,
        /// Names that there are.
        found: Vec<String>,
    },
    /// Several channels may be meant.
    #[error("{quantity}: {} may be meant", listed(channels))]
    SeveralChannels {
        /// What they measure.
        quantity: Quantity,
        /// Their names.
        channels: Vec<String>,
    },
    /// A column is called by a number that another one has.
    #[error(
        "{quantity}: `{text}` is the name of column #{named} and the number of another; write #{named} or #{text}"
    )]
    NameOrNumber {
        /// What it measures.
        quantity: Quantity,
        /// The number.
        text: String,
        /// Number of the column that is called so.
        named: usize,
    },
    /// The channel holds something else than numbers.
    #[error("{quantity}: channel {channel} holds {kind}, not numbers that are read here")]
    NoNumbers {
        /// What it is to measure.
        quantity: Quantity,
        /// The channel.
        channel: String,
        /// What it holds.
        kind: String,
    },
    /// The channel's numbers are of a width or at a place that is not read.
    #[error("{quantity}: channel {channel} holds {held}, allowed: {allowed}")]
    Width {
        /// What it is to measure.
        quantity: Quantity,
        /// The channel.
        channel: String,
        /// What it holds.
        held: String,
        /// What is read instead.
        allowed: &'static str,
    },
    /// One channel is chosen twice.
    #[error("{} and {}: both are column {channel}", quantities[0], quantities[1])]
    SameChannel {
        /// The channel.
        channel: String,
        /// What it is to measure.
        quantities: [Quantity; 2],
    },
    /// There is no such group.
    #[error(
        "no group `{group}`, or several; there are {} (by number or name)",
        numbered_list(groups)
    )]
    Group {
        /// The name or number.
        group: String,
        /// Names of those there are.
        groups: Vec<String>,
    },
    /// Channels of one name are in several groups.
    #[error("channel {channel} is in the groups {}", groups.join(", "))]
    SeveralGroups {
        /// The channel.
        channel: String,
        /// The groups.
        groups: Vec<String>,
    },
    /// The channels have times of their own.
    #[error("{quantity}: channel {channel} is in group {}, not in group {}; a recording is of one group, whose channels have the same times", groups[0], groups[1])]
    OtherGroup {
        /// What the channel measures.
        quantity: Quantity,
        /// The channel.
        channel: String,
        /// Its group and that of the recording.
        groups: [String; 2],
    },
    /// The file does not tell the unit.
    #[error("the file does not tell the unit of {channel}")]
    NoUnit {
        /// What it measures.
        quantity: Quantity,
        /// The channel.
        channel: String,
    },
    /// The unit is not known.
    #[error("`{unit}`, which the file says is the unit of {channel}, is not one of {quantity} known here: {}", quantity.unit_names())]
    UnknownUnit {
        /// What it should measure.
        quantity: Quantity,
        /// The channel.
        channel: String,
        /// The unit.
        unit: String,
    },
    /// The name tells another unit.
    #[error("column {channel} has the unit `{unit}`, which is not that of its name")]
    TwoUnits {
        /// What it measures.
        quantity: Quantity,
        /// The channel.
        channel: String,
        /// The unit.
        unit: String,
    },
    /// The first row may be a header.
    #[error("`{cells}` may be names of columns or a row")]
    HeaderOrRow {
        /// Its cells.
        cells: String,
    },
    /// The header is all there is.
    #[error("no row after the header{}", if *left_out > 0 { format!(" that has all values: {left_out} were left out") } else { String::new() })]
    NoRow {
        /// Rows that were left out.
        left_out: u64,
    },
    /// The text cannot be read.
    #[error("cannot read: {0}")]
    Text(String),
    /// A row has more or fewer cells than the header.
    #[error("line {line}: {cells} cells where the header has {expected}{}", decimal_comma(*cells, *expected, *separator))]
    Cells {
        /// Line of the file, from 1.
        line: u64,
        /// Cells of the row.
        cells: u64,
        /// Cells of the header.
        expected: u64,
        /// What separates them.
        separator: Separator,
    },
    /// A cell holds no number.
    #[error("`{cell}` is not a finite number")]
    Number {
        /// The cell's text, at most 40 bytes of it.
        cell: String,
    },
    /// A number has another decimal mark than those before it.
    #[error("`{cell}` has a decimal {}, the numbers before it have another mark or another one was asked for", match mark { DecimalMark::Point => "point", DecimalMark::Comma => "comma" })]
    Mark {
        /// The cell's text.
        cell: String,
        /// Its mark.
        mark: DecimalMark,
    },
    /// A value is missing, marked invalid or infinite.
    #[error("`{cell}` is not a finite number")]
    NotFinite {
        /// The cell's text, or what is said of the sample.
        cell: String,
    },
    /// A sample is marked invalid.
    #[error("the sample is marked invalid")]
    Invalid,
    /// The file is damaged, or has what is not read.
    #[error("cannot read the {kind}: {reason}")]
    Damaged {
        /// Its kind.
        kind: &'static str,
        /// What the library says.
        reason: String,
    },
    /// The file has less rows than it says.
    #[error("it says that it has {declared} rows and has {found}: it is cut off or damaged")]
    CutOff {
        /// Rows that it says.
        declared: u64,
        /// Rows that there are.
        found: u64,
    },
    /// A column is not the one that Dashpot wrote.
    #[error(
        "column {column}: the SHA-256 of its numbers is not the one in the file's metadata: the file was damaged, or another program \
         changed the column and kept the metadata, whose key {key} must then be removed"
    )]
    Sum {
        /// The column.
        column: String,
        /// Key of the metadata with the sums.
        key: &'static str,
    },
    /// Time stands still or goes back.
    #[error("time {time_s} s does not grow; the row before has {before_s} s")]
    Time {
        /// Time of the row (s).
        time_s: f64,
        /// Time of the row before (s).
        before_s: f64,
    },
    /// The recording does not last as long as it is needed.
    #[error("it lasts from {} s to {} s, the run takes a force from {} s to {} s", lasts_s[0], lasts_s[1], needed_s[0], needed_s[1])]
    Short {
        /// Times of its first and last row (s).
        lasts_s: [f64; 2],
        /// Times between which there must be a force (s).
        needed_s: [f64; 2],
    },
    /// Time jumps farther than a gap that is filled.
    #[error(
        "time jumps from {before_s} s to {time_s} s: {ticks:.0} ticks without a sample, allowed: {MAX_GAP_TICKS}; is the clock wrong? Else \
         split the recording there or take a larger step"
    )]
    Jump {
        /// Time of the row (s).
        time_s: f64,
        /// Time of the row before (s).
        before_s: f64,
        /// Ticks between them.
        ticks: f64,
    },
    /// The recording is too long for the step.
    #[error(
        "{time_s} s is more than {MOST_TICKS} ticks after the first sample; split the recording or take a larger step"
    )]
    TooLong {
        /// Time of the row (s).
        time_s: f64,
    },
}
