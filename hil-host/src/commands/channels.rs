//! `dashpot channels`: lists the channels of a recording.

use std::io::{self, Write};
use std::path::PathBuf;

use serde::Serialize;

use super::gap_report::{unended, unfinished};
use super::recording::ListingArguments;
use super::remedy::with_remedy;
use super::{Format, counted, nearest_nanosecond, print_answer};
use crate::commands::failure::Outcome;
use dashpot_files::input;
use dashpot_recording::{
    ChannelOverview, Channels, GAP_IN_MEDIANS, Overview, Quantity, TimeOverview, overview,
};
use dashpot_report::rounded::{six_digits, two_digits};

/// List the channels of a recording: names, units, ranges, regularity of the times, and the command that replays it.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot channels run7.mf4
  dashpot channels messung.csv --time Zeit --time-unit ms
  dashpot channels run7.parquet --format json")]
pub struct ChannelsArguments {
    /// Recording: text (CSV), MDF4 or Parquet, optionally compressed with gzip; `-` for standard input.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    recording: ListingArguments,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Report {
    #[serde(flatten)]
    overview: Overview,
    /// Command line that replays the recording.
    replay: String,
}

/// Runs the command.
///
/// # Errors
/// The file cannot be used.
pub fn run(arguments: &ChannelsArguments) -> Outcome<()> {
    let channels = arguments.recording.channels();
    let mut overview = overview(&arguments.file, &channels)?;
    for time in &mut overview.times {
        let reason = time.reason.take();
        time.reason = reason.map(|reason| with_remedy(reason, time.remedy));
    }
    let report = Report {
        replay: replay_line(arguments, &channels, &overview),
        overview,
    };
    print_answer(arguments.format, &report, |out, report| {
        print(out, report, arguments)
    })
}

/// Returns the command line that replays the file, with placeholders in capitals for choices that are still missing.
fn replay_line(arguments: &ChannelsArguments, given: &Channels, overview: &Overview) -> String {
    let file = arguments.file.display().to_string();
    let mut line = format!("dashpot replay --input {}", quoted(&file));
    line += &arguments.recording.repeated();
    let displacement = choice(overview, given, Quantity::Displacement, None);
    let group = displacement.and_then(|channel| channel.group);
    if let Some(group) = group.filter(|_| overview.times.len() > 1) {
        line.push_str(&format!(" --group {group}"));
    }
    let time = overview.times.iter().find(|time| time.group == group);
    for (quantity, channel) in [
        (
            Quantity::Time,
            choice(overview, given, Quantity::Time, group),
        ),
        (Quantity::Displacement, displacement),
    ] {
        // The time channel of an MDF4 group needs no name.
        let is_master = group.is_some() && time.is_some_and(|time| time.channel.is_some());
        if quantity == Quantity::Time && is_master && given.time.name.is_none() {
            continue;
        }
        match channel {
            Some(channel) if channel.name == quantity.column() => {}
            Some(channel) => {
                let name = match channel.name.as_str() {
                    "" => channel.number.to_string(),
                    name => quoted(name),
                };
                line.push_str(&format!(" --{quantity} {name}"));
            }
            None => line.push_str(&format!(" --{quantity} CHANNEL")),
        }
        let known_unit = channel.and_then(|channel| unit_of(channel, quantity));
        let given = given.channel(quantity).unit.map(|unit| unit.name());
        if let Some(unit) = given {
            line.push_str(&format!(" --{quantity}-unit {unit}"));
        } else if known_unit.is_none() {
            line.push_str(&format!(" --{quantity}-unit UNIT"));
        }
    }
    line.push_str(" --output force.csv");
    line
}

/// Returns the channel of a quantity: the chosen one, the one with the standard name, or the first with a matching
/// unit.
fn choice<'a>(
    overview: &'a Overview,
    given: &Channels,
    quantity: Quantity,
    group: Option<usize>,
) -> Option<&'a ChannelOverview> {
    let all = || {
        let numbers = overview.channels.iter().filter(|c| c.first.is_some());
        numbers.filter(move |channel| group.is_none() || channel.group == group)
    };
    if let Some(name) = &given.channel(quantity).name {
        return all().find(|c| c.name == *name || c.number.to_string() == *name);
    }
    let called = |c: &&ChannelOverview| c.name == quantity.column();
    let measuring = |c: &&ChannelOverview| unit_of(c, quantity).is_some();
    all().find(called).or_else(|| all().find(measuring))
}

/// Returns the unit of a channel if it is a unit of the quantity.
fn unit_of(channel: &ChannelOverview, quantity: Quantity) -> Option<&'static str> {
    let unit = match &channel.unit {
        Some(unit) => quantity.unit(unit),
        None => quantity.unit_in_name(&channel.name),
    };
    unit.map(|unit| unit.name())
}

/// Quotes a word for the shell.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_-./".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) && !word.starts_with('-') {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

fn print(out: &mut dyn Write, report: &Report, arguments: &ChannelsArguments) -> io::Result<()> {
    let overview = &report.overview;
    let width = |text: fn(&ChannelOverview) -> usize, least: usize| {
        let widths = overview.channels.iter().map(text);
        widths.max().unwrap_or(0).clamp(least, 40)
    };
    let name = width(|channel| channel.name.chars().count(), 4);
    let unit = width(
        |c| c.unit.as_ref().map_or(0, |unit| unit.chars().count()),
        4,
    );
    writeln!(out, "{}\n", input::name(&arguments.file).display())?;
    writeln!(
        out,
        "  {:>3}  {:<name$}  {:<unit$}  {:>5}  {:<9}  {:>10}  {:>8}  {:>12}  {:>12}  {:>12}  {:>12}",
        "no.", "name", "unit", "group", "type", "rows", "invalid", "first", "last", "min", "max"
    )?;
    for channel in &overview.channels {
        let number = |value: Option<f64>| value.map_or_else(String::new, six_digits);
        writeln!(
            out,
            "  {:>3}  {:<name$}  {:<unit$}  {:>5}  {:<9}  {:>10}  {:>8}  {:>12}  {:>12}  {:>12}  {:>12}",
            channel.number,
            channel.name,
            channel.unit.as_deref().unwrap_or(""),
            channel.group.map_or_else(String::new, |g| g.to_string()),
            channel.kind,
            channel.rows,
            channel.invalid,
            number(channel.first),
            number(channel.last),
            number(channel.min),
            number(channel.max)
        )?;
    }
    writeln!(out)?;
    for channel in &overview.channels {
        if let Some(unread) = &channel.unread {
            let name = match channel.name.as_str() {
                "" => channel.number.to_string(),
                name => name.to_owned(),
            };
            writeln!(out, "warning: channel {name} is not read: {unread}")?;
        }
    }
    for time in &overview.times {
        print_time(out, time)?;
    }
    if let Some(line) = overview.unended_line {
        writeln!(out, "warning: {}", unended(line))?;
    }
    if let Some(end) = overview.unfinished {
        writeln!(out, "warning: {}", unfinished(end))?;
    }
    writeln!(out, "\nto replay: {}", report.replay)
}

fn print_time(out: &mut dyn Write, time: &TimeOverview) -> io::Result<()> {
    if let Some(group) = time.group {
        let name = time.group_name.as_deref();
        let name = name.map_or_else(String::new, |name| format!(" ({name})"));
        write!(out, "group {group}{name}: ")?;
    }
    let (Some(channel), Some([from_s, to_s])) = (&time.channel, time.from_to_s) else {
        let reason = time.reason.as_deref().unwrap_or("it has no values");
        return writeln!(out, "no time: {reason}");
    };
    write!(
        out,
        "time {channel}: {} s, from {} s to {} s",
        six_digits(to_s - from_s),
        nearest_nanosecond(from_s),
        nearest_nanosecond(to_s)
    )?;
    if let (Some(rate_hz), Some(jitter_s), Some(largest_s)) =
        (time.rate_hz, time.jitter_s, time.largest_deviation_s)
    {
        write!(
            out,
            "; {} Hz, intervals deviate by {} s rms, {} s maximum",
            six_digits(rate_hz),
            two_digits(nearest_nanosecond(jitter_s)),
            two_digits(nearest_nanosecond(largest_s))
        )?;
    }
    writeln!(out)?;
    if time.not_growing > 0 {
        writeln!(
            out,
            "warning: the time does not increase at {}; `replay` rejects this",
            counted(time.not_growing, "row")
        )?;
    }
    let gaps = time.gaps.as_ref().filter(|gaps| gaps.count > 0);
    if let Some((gaps, longest)) = gaps.and_then(|gaps| Some((gaps, gaps.longest?))) {
        writeln!(
            out,
            "warning: {} (over {GAP_IN_MEDIANS} times the median interval); the longest lasts {} s and begins at {} s",
            counted(gaps.count, "gap"),
            longest.duration_s,
            nearest_nanosecond(longest.start_s)
        )?;
    }
    Ok(())
}
