//! `telemetry`: fetches the samples buffered by a target.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use dashpot_core::link::{KEPT_TICKS, MAX_SAMPLES, Request, Response, Sample};
use serde::Serialize;

use super::LinkArguments;
use super::places::Places;
use super::target::Target;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::print::{counted, print_report_beside};
use dashpot_files::output::{self, cannot_write_rows, write_whole_if};
use dashpot_files::status_bits::{self, StatusBit};

/// Maximum number of responses that the buffered ticks fill; samples in later responses are newer than the request.
const MAX_RESPONSES: usize = KEPT_TICKS / MAX_SAMPLES;

/// Fetch the buffered samples: up to 64 ticks per damper. Each sample is sent only once.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot link --link serial:/dev/ttyACM0 telemetry --place 3
  dashpot link --link serial:/dev/ttyACM0 telemetry --output samples.csv

--output writes the columns place, tick, displacement_m, force_n and status, which is the sum of 1 input held, 2 input
limited, 4 saturated, 8 damper swapped, 16 corrupted and 32 restarted.")]
pub(super) struct TelemetryArguments {
    #[command(flatten)]
    places: Places,
    /// Write the samples as CSV, `-` for standard output; default: print them.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// A sample of the damper in one slot.
#[derive(Serialize)]
pub(super) struct PlaceSample {
    place: u8,
    tick: u32,
    displacement_m: f32,
    force_n: f32,
    status: Vec<StatusBit>,
}

impl PlaceSample {
    pub(super) fn new(place: u8, sample: &Sample) -> Self {
        Self {
            place,
            tick: sample.tick,
            displacement_m: sample.displacement_m,
            force_n: sample.force_n,
            status: status_bits::from_word(sample.status),
        }
    }

    /// Prints the header for the lines of [`Self::print`].
    pub(super) fn print_header(out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, " slot        tick  displacement_m     force_n  status")
    }

    /// Prints the sample as one line.
    pub(super) fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        let status = status_bits::describe(&self.status);
        writeln!(
            out,
            "{:>5}  {:>10}  {:>14.6}  {:>10.1}  {status}",
            self.place, self.tick, self.displacement_m, self.force_n
        )
    }
}

/// Samples fetched from one slot.
pub(in crate::commands) struct Taken {
    /// Number of samples of this damper overwritten by newer ones since power-on.
    pub(in crate::commands) overwritten: u32,
    pub(in crate::commands) samples: Vec<Sample>,
}

/// Fetches the oldest buffered samples of the damper in one slot.
pub(in crate::commands) fn take(target: &mut Target, place: u8) -> Outcome<Taken> {
    target.ask(
        &Request::Telemetry { damper: place },
        |response| match response {
            Response::Telemetry {
                overwritten,
                samples,
            } => Some(Taken {
                overwritten,
                samples: samples.to_vec(),
            }),
            _ => None,
        },
    )
}

/// Fetches all buffered samples of the damper in one slot.
fn take_all(target: &mut Target, place: u8) -> Outcome<Taken> {
    let mut all = Taken {
        overwritten: 0,
        samples: Vec::new(),
    };
    for _ in 0..MAX_RESPONSES {
        let taken = take(target, place)?;
        all.overwritten = taken.overwritten;
        all.samples.extend(&taken.samples);
        if taken.samples.len() < MAX_SAMPLES {
            break;
        }
    }
    Ok(all)
}

/// Telemetry fetched from one slot.
#[derive(Serialize)]
struct PlaceReport {
    place: u8,
    taken: usize,
    /// Number of samples overwritten since power-on.
    overwritten: u32,
}

#[derive(Serialize)]
struct Report {
    places: Vec<PlaceReport>,
    /// `None` if the samples were written to a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<Vec<PlaceSample>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    output: Option<String>,
}

/// Runs `telemetry`.
pub(super) fn run(telemetry: &TelemetryArguments, link: &LinkArguments) -> Outcome<()> {
    let path = telemetry.output.as_deref();
    let mut report = Report {
        places: Vec::new(),
        samples: path.is_none().then(Vec::new),
        output: path.map(|path| output::name(path).display().to_string()),
    };
    // Open the file first: samples can be fetched from a target only once.
    write_whole_if::<_, Failure>(path, |file| {
        let mut rows = file.map(|(path, file)| (path, csv::Writer::from_writer(file)));
        if let Some((path, rows)) = &mut rows {
            rows.write_record(["place", "tick", "displacement_m", "force_n", "status"])
                .map_err(|error| cannot_write_rows(path, error))?;
        }
        let mut target = Target::open(&link.line)?;
        for place in telemetry.places.of(&target)? {
            let taken = take_all(&mut target, place)?;
            report.places.push(PlaceReport {
                place,
                taken: taken.samples.len(),
                overwritten: taken.overwritten,
            });
            if let Some((path, rows)) = &mut rows {
                taken
                    .samples
                    .iter()
                    .try_for_each(|s| {
                        rows.serialize((place, s.tick, s.displacement_m, s.force_n, s.status))
                    })
                    .map_err(|error| cannot_write_rows(path, error))?;
            }
            if let Some(samples) = &mut report.samples {
                let all = taken.samples.iter();
                samples.extend(all.map(|sample| PlaceSample::new(place, sample)));
            }
        }
        if let Some((path, mut rows)) = rows {
            rows.flush()
                .map_err(|error| cannot_write_rows(path, error.into()))?;
        }
        Ok(())
    })?;
    print_report_beside(path.unwrap_or(Path::new("")), link.format, &report, print)
}

fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    if let Some(samples) = &report.samples {
        PlaceSample::print_header(out)?;
        samples.iter().try_for_each(|sample| sample.print(out))?;
    }
    for slot in &report.places {
        writeln!(
            out,
            "slot {}: {} fetched; {} overwritten before they were fetched, since power-on",
            slot.place,
            counted(slot.taken as u64, "sample"),
            slot.overwritten
        )?;
    }
    report
        .output
        .iter()
        .try_for_each(|path| writeln!(out, "wrote {path}"))
}
