//! Errors in recordings. The texts name no options or arguments: [`RecordingError::remedy`] returns the remedy as data,
//! and each front end puts it into words.

mod remedy;
mod words;

use std::ops::RangeInclusive;

pub use remedy::remedy;

use super::text_options::{DecimalMark, Separator};
use super::unit::Quantity;
use words::{apart, decimal_comma, listed, mark_name, missing, no_row, numbered_list};

/// Maximum length of a recording in ticks: 24 hours at 10 kHz. Without a limit, one mistyped time would fill a disk.
pub(crate) const MAX_TICKS: f64 = 864e6;

/// Maximum number of ticks between two samples, 1000 s at 10 kHz. A longer interval is a jump of the logger's clock,
/// and interpolating across it would fill a disk.
pub(crate) const MAX_GAP_TICKS: f64 = 1e7;

/// Errors in recordings. The enclosing [`FileError`](dashpot_files::FileError) states the file and, if known, the line
/// or row and the column.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// The file is empty.
    #[error(
        "the file is empty; it needs a header such as `time_s,displacement_m` or `time_s,force_n` and at least one row"
    )]
    Empty,
    /// The format of the file is not supported.
    #[error(
        "the file is {kind}; supported: text (CSV), MDF4 and Parquet, optionally compressed with gzip"
    )]
    Kind {
        /// Format of the file.
        kind: &'static str,
    },
    /// This build does not support the format of the file.
    #[error(
        "the file is {kind}; this build cannot read it because it lacks the feature `{feature}`"
    )]
    Feature {
        /// Format of the file.
        kind: &'static str,
        /// Cargo feature that adds the format.
        feature: &'static str,
    },
    /// Several channels have the name.
    #[error(
        "column {column} appears {times} times in the header; choose one by its number, such as 2"
    )]
    RepeatedColumn {
        /// Name of the column.
        column: String,
        /// Number of columns with this name.
        times: usize,
    },
    /// A required channel is missing.
    #[error("{}", missing(*quantity, name, *numbered, found))]
    MissingChannel {
        /// Quantity that the channel measures.
        quantity: Quantity,
        /// Name of the channel.
        name: String,
        /// True if the channels of the file have no names.
        numbered: bool,
        /// Names of the channels in the file.
        found: Vec<String>,
    },
    /// Several channels match.
    #[error("{quantity}: several channels match: {}", listed(channels))]
    SeveralChannels {
        /// Quantity to find.
        quantity: Quantity,
        /// Names of the matching channels.
        channels: Vec<String>,
    },
    /// The name of a column is the number of another column.
    #[error(
        "{quantity}: `{text}` is the name of column #{named} and the number of another; write #{named} or #{text}"
    )]
    NameOrNumber {
        /// Quantity that the column measures.
        quantity: Quantity,
        /// Name of one column and number of another.
        text: String,
        /// Number of the column with this name.
        named: usize,
    },
    /// The channel does not contain numbers.
    #[error("{quantity}: channel {channel} contains {kind}, not numbers in a supported format")]
    NoNumbers {
        /// Quantity that the channel should measure.
        quantity: Quantity,
        /// Name of the channel.
        channel: String,
        /// Type of its values.
        kind: String,
    },
    /// The width or bit position of the channel's numbers is not supported.
    #[error("{quantity}: channel {channel} contains {held}, allowed: {allowed}")]
    Width {
        /// Quantity that the channel should measure.
        quantity: Quantity,
        /// Name of the channel.
        channel: String,
        /// Format of its numbers.
        held: String,
        /// Supported formats.
        allowed: &'static str,
    },
    /// The same channel is chosen for two quantities.
    #[error("{first} and {second}: both are column {channel}")]
    SameChannel {
        /// Name of the channel.
        channel: String,
        /// First quantity.
        first: Quantity,
        /// Second quantity.
        second: Quantity,
    },
    /// The group is missing, or several groups have its name.
    #[error(
        "group `{group}` is missing or ambiguous; groups (by number or name): {}",
        numbered_list(groups)
    )]
    Group {
        /// Name or number of the group.
        group: String,
        /// Names of the groups in the file.
        groups: Vec<String>,
    },
    /// Several groups have a channel with this name.
    #[error("channel {channel} is in several groups: {}", groups.join(", "))]
    SeveralGroups {
        /// Name of the channel.
        channel: String,
        /// Labels of the groups.
        groups: Vec<String>,
    },
    /// The chosen channels are in different groups, so they have different times.
    #[error(
        "{quantity}: channel {channel} is in group {group}, not in group {expected}; each group has its own times, and \
         only a force may come from another group than the displacement"
    )]
    OtherGroup {
        /// Quantity that the channel measures.
        quantity: Quantity,
        /// Name of the channel.
        channel: String,
        /// Label of its group.
        group: String,
        /// Label of the group of the other channels.
        expected: String,
    },
    /// Displacement and force are in different groups without common times.
    #[error("{}", apart(displacement, displacement_s.as_ref(), force, force_s.as_ref()))]
    Apart {
        /// Label of the group of the displacement.
        displacement: String,
        /// First and last time of the displacement (s).
        displacement_s: Option<RangeInclusive<f64>>,
        /// Label of the group of the force.
        force: String,
        /// First and last time of the force (s); `None` if it has no samples.
        force_s: Option<RangeInclusive<f64>>,
    },
    /// The file does not state the unit.
    #[error("the file does not state the unit of {channel}")]
    NoUnit {
        /// Quantity that the channel measures.
        quantity: Quantity,
        /// Name of the channel.
        channel: String,
    },
    /// The unit stated in the file is unknown.
    #[error(
        "the file states the unknown unit `{unit}` for {channel}; known units of {quantity}: {}",
        quantity.unit_names()
    )]
    UnknownUnit {
        /// Quantity that the channel should measure.
        quantity: Quantity,
        /// Name of the channel.
        channel: String,
        /// Stated unit.
        unit: String,
    },
    /// The stated unit differs from the unit in the name.
    #[error("column {channel} has the unit `{unit}`, but its name ends with another unit")]
    TwoUnits {
        /// Quantity that the channel measures.
        quantity: Quantity,
        /// Name of the channel.
        channel: String,
        /// Stated unit.
        unit: String,
    },
    /// The first row could be a header or a row of numbers.
    #[error("`{cells}` could be the header or the first row")]
    HeaderOrRow {
        /// Cells of the first row.
        cells: String,
    },
    /// Other lines precede the table.
    #[error("the file begins with a title, `{}`; its table starts at line {}", first.escape_debug(), lines + 1)]
    Title {
        /// Number of lines before the table.
        lines: u64,
        /// Start of the first line.
        first: String,
    },
    /// The file has no usable rows.
    #[error("{}", no_row(*left_out))]
    NoRow {
        /// Number of omitted rows.
        left_out: u64,
    },
    /// The text reader failed.
    #[error("cannot read: {0}")]
    Text(String),
    /// A row has more or fewer cells than the header.
    #[error(
        "line {line}: {cells} cells, but the header has {expected}{}",
        decimal_comma(*cells, *expected, *separator)
    )]
    Cells {
        /// Line of the file, from 1.
        line: u64,
        /// Number of cells in the row.
        cells: u64,
        /// Number of cells in the header.
        expected: u64,
        /// Separator of the cells.
        separator: Separator,
    },
    /// A cell does not contain a number.
    #[error("`{cell}` is not a finite number")]
    Number {
        /// Text of the cell, cut to 40 bytes.
        cell: String,
    },
    /// A cell does not contain a time with its date, unlike the first row.
    #[error(
        "`{cell}` is not a time such as 2026-11-28T21:52:03.125Z, or only one of it and the first time states an \
         offset from UTC"
    )]
    Instant {
        /// Text of the cell, cut to 40 bytes.
        cell: String,
    },
    /// The decimal mark of a number differs from the chosen one or from that of earlier numbers.
    #[error(
        "`{cell}` has a decimal {}, unlike the numbers before it or the chosen decimal mark",
        mark_name(*mark)
    )]
    Mark {
        /// Text of the cell.
        cell: String,
        /// Decimal mark of the cell.
        mark: DecimalMark,
    },
    /// A value is missing, marked invalid or infinite.
    #[error("`{cell}` is not a finite number")]
    NotFinite {
        /// Text of the cell, or the value of the sample.
        cell: String,
    },
    /// A sample is marked invalid.
    #[error("the sample is marked invalid")]
    Invalid,
    /// The file is damaged or uses an unsupported feature of its format.
    #[error("cannot read the {kind}: {reason}")]
    Damaged {
        /// Format of the file.
        kind: &'static str,
        /// Message of the library that reads the format.
        reason: String,
    },
    /// The logger did not finish the MDF4 file, and the rows that it has are not certain.
    #[error("the MDF4 file is unfinished and cannot be read up to its last whole row: {reason}")]
    Unfinished {
        /// What makes the rows uncertain.
        reason: String,
    },
    /// The file has fewer rows than it declares.
    #[error("the file declares {declared} rows but has {found}: it is cut off or damaged")]
    CutOff {
        /// Declared number of rows.
        declared: u64,
        /// Actual number of rows.
        found: u64,
    },
    /// The numbers of a column differ from those that Dashpot wrote.
    #[error(
        "column {column}: the SHA-256 of its numbers differs from the one in the metadata: the file is damaged, or \
         another program changed the column without removing the metadata key {key}"
    )]
    Sum {
        /// Name of the column.
        column: String,
        /// Metadata key of the checksums.
        key: &'static str,
    },
    /// Time does not increase.
    #[error("time {time_s} s does not increase; the previous row has {before_s} s")]
    Time {
        /// Time of the row (s).
        time_s: f64,
        /// Time of the previous row (s).
        before_s: f64,
    },
    /// The recording does not cover the required period.
    #[error(
        "the recording covers {} s to {} s, but the run needs a force from {} s to {} s",
        recorded_s.start(),
        recorded_s.end(),
        needed_s.start(),
        needed_s.end()
    )]
    Short {
        /// Times of the first and last row (s).
        recorded_s: RangeInclusive<f64>,
        /// Period in which a force is required (s).
        needed_s: RangeInclusive<f64>,
    },
    /// Time jumps by more than the longest allowed gap.
    #[error(
        "time jumps from {before_s} s to {time_s} s: {ticks:.0} ticks without a sample, allowed: {MAX_GAP_TICKS}; \
         if the clock of the logger is right, split the recording there or use a larger step"
    )]
    Jump {
        /// Time of the row (s).
        time_s: f64,
        /// Time of the previous row (s).
        before_s: f64,
        /// Number of ticks between the rows.
        ticks: f64,
    },
    /// The recording is too long for the step.
    #[error(
        "{time_s} s is more than {MAX_TICKS} ticks after the first sample; split the recording or use a larger step"
    )]
    TooLong {
        /// Time of the row (s).
        time_s: f64,
    },
    /// None of the wanted signals is in the recording.
    #[error(
        "the recording has none of the signals wanted, such as {example}; it has {}",
        listed(found)
    )]
    NoSignal {
        /// Name of a wanted signal.
        example: String,
        /// Names of the channels in the file.
        found: Vec<String>,
    },
    /// A signal has another unit than its name says.
    #[error("signal {channel} has the unit `{unit}`, allowed: {allowed}")]
    SignalUnit {
        /// Name of the channel.
        channel: String,
        /// Stated unit.
        unit: String,
        /// Unit that it must have.
        allowed: String,
    },
    /// The recording does not fit into memory.
    #[error(
        "the recording is too long: {rows} rows of {signals} signals fit into memory; use a part of it"
    )]
    TooManyRows {
        /// Rows that fit.
        rows: usize,
        /// Signals that were found.
        signals: usize,
    },
}
