//! `watch`: prints the samples of a free-running target as they arrive.

use std::io::{self, Write};
use std::path::Path;
use std::time::Duration;

use dashpot_core::link::{MAX_SAMPLES, Sample};

use super::LinkArguments;
use super::places::Places;
use super::target::Target;
use super::telemetry::{PlaceSample, take};
use crate::commands::arguments::Format;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::print::counted;
use crate::commands::print::print_note;
use dashpot_files::input::STANDARD_STREAM;
use dashpot_files::output::cannot_write;

/// Longest time between requests.
const LONGEST_PAUSE: Duration = Duration::from_millis(100);

/// Print a line for each new sample of a free-running target, until interrupted.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot link --link serial:/dev/ttyACM0 watch --place 0 --place 3
  dashpot link --link serial:/dev/ttyACM0 --format json watch --samples 1000 > samples.jsonl

With --format json, every line is a separate object. A warning on standard error reports samples that the target
overwrote because the link is too slow for this number of slots.")]
pub(super) struct WatchArguments {
    #[command(flatten)]
    places: Places,
    /// Stop after this number of samples.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    samples: Option<u64>,
}

/// A watched slot.
struct Watched {
    place: u8,
    /// Number of samples overwritten so far; `None` before the first response.
    overwritten: Option<u32>,
}

impl Watched {
    /// Fetches new samples and warns about samples lost since the last call.
    fn take(&mut self, target: &mut Target) -> Outcome<Vec<Sample>> {
        let taken = take(target, self.place)?;
        let before = self.overwritten.replace(taken.overwritten);
        let lost = taken
            .overwritten
            .saturating_sub(before.unwrap_or(taken.overwritten));
        if lost > 0 {
            let lost = counted(lost.into(), "sample");
            print_note(&format!(
                "warning: slot {}: {lost} overwritten before they were fetched",
                self.place
            ));
        }
        Ok(taken.samples)
    }
}

/// Runs `watch`.
pub(super) fn run(watch: &WatchArguments, link: &LinkArguments) -> Outcome<()> {
    let mut target = Target::open(&link.line)?;
    let places = watch.places.of(&target)?.into_iter();
    let mut watched: Vec<Watched> = places
        .map(|place| Watched {
            place,
            overwritten: None,
        })
        .collect();
    let pause = pause(target.greeting.step_s);
    let mut out = io::stdout().lock();
    let written = |done: io::Result<()>| {
        done.map_err(|error| cannot_write(Path::new(STANDARD_STREAM), error))
    };
    if link.format == Format::Text {
        written(PlaceSample::print_header(&mut out))?;
    }
    let mut left = watch.samples.unwrap_or(u64::MAX);
    loop {
        let mut new = false;
        for place in &mut watched {
            for sample in place.take(&mut target)? {
                written(print(&mut out, link.format, place.place, &sample))?;
                new = true;
                left -= 1;
                if left == 0 {
                    return Ok(());
                }
            }
        }
        if !new && !target.greeting.running {
            return Err(Failure::new(
                "the target is not free-running, so no more samples will arrive; start it with `run`",
            ));
        }
        if !new {
            std::thread::sleep(pause);
        }
    }
}

fn print(out: &mut dyn Write, format: Format, place: u8, sample: &Sample) -> io::Result<()> {
    let sample = PlaceSample::new(place, sample);
    match format {
        Format::Text => sample.print(out),
        Format::Json => writeln!(out, "{}", serde_json::to_string(&sample)?),
    }
}

/// Returns the time in which the samples for one response accumulate, but at most [`LONGEST_PAUSE`].
fn pause(step_s: f32) -> Duration {
    Duration::try_from_secs_f32(step_s * MAX_SAMPLES as f32)
        .map_or(LONGEST_PAUSE, |pause| pause.min(LONGEST_PAUSE))
}
