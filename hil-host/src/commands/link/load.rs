//! `load`: loads a damper into slots of a target, built here for its step or taken from an image.

use std::path::{Path, PathBuf};

use dashpot_core::link::Request;
use dashpot_core::{CheckedParameters, Damper};
use serde::Serialize;

use super::LinkArguments;
use super::places::{Places, named};
use super::target::{Target, step_in_words};
use crate::commands::arguments::damper_help;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::step_size::StepSize;
use dashpot_files::FileError;
use dashpot_files::damper;
use dashpot_files::input;

/// Load a damper into slots of the bank; forces stay continuous. A slot that already holds it is skipped.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot link --link serial:/dev/ttyACM0 load --damper in-service
  dashpot link --link serial:/dev/ttyACM0 load --damper my.toml --set mount.clearance_m=2e-3 --place 0 --place 3
  dashpot export --damper my.toml --lang bin --output my.bin
  dashpot link --link serial:/dev/ttyACM0 load --image my.bin --place 3")]
pub(super) struct LoadArguments {
    /// Preset or file.
    #[arg(
        help = damper_help("; built for the target's step"),
        long,
        value_name = "NAME|FILE",
        required_unless_present = "image",
        conflicts_with = "image"
    )]
    damper: Option<String>,
    /// Override a key of the damper: table.key=value, such as mount.clearance_m=1e-3.
    #[arg(long = "set", value_name = "KEY=VALUE", conflicts_with = "image")]
    overrides: Vec<String>,
    /// Damper image written by `dashpot export --lang bin`, `-` for standard input.
    #[arg(long, value_name = "FILE")]
    image: Option<PathBuf>,
    #[command(flatten)]
    places: Places,
}

/// Source of the damper, read and checked.
enum Source {
    Parameters(Box<CheckedParameters>),
    Image(Box<Damper<f32>>),
}

impl LoadArguments {
    /// Reads the damper and returns it with its name.
    fn read(&self) -> Outcome<(String, Source)> {
        if let Some(path) = &self.image {
            let name = input::name(path);
            let damper = Damper::<f32>::from_image(&input::read(path)?).map_err(|error| {
                let allowed = "allowed: a file written by `dashpot export --lang bin` in f32";
                FileError::in_file(&name, format!("{error}; {allowed}"))
            })?;
            return Ok((name.display().to_string(), Source::Image(Box::new(damper))));
        }
        let name = self.damper.as_deref().unwrap_or_default();
        let parameters = Box::new(damper::load(name, &self.overrides)?);
        let name = input::name(Path::new(name)).display().to_string();
        Ok((name, Source::Parameters(parameters)))
    }
}

/// Builds the damper for a step of `step_s` (s).
fn build(name: &str, source: &Source, step_s: f32) -> Outcome<Damper<f32>> {
    match source {
        Source::Parameters(parameters) => {
            let step = StepSize::of_target(step_s)?;
            Ok(parameters.build(step.step_s())?)
        }
        Source::Image(damper) if damper.step_s() == step_s => Ok(**damper),
        Source::Image(damper) => Err(Failure::new(format!(
            "{name}: built for a step of {}, but the target's step is {}; export it for that step \
             (`--step-us`)",
            step_in_words(damper.step_s()),
            step_in_words(step_s),
        ))),
    }
}

#[derive(Serialize)]
struct Report {
    damper: String,
    revision: u32,
    /// Slots into which the damper was loaded.
    loaded: Vec<u8>,
    /// Slots that already held the damper.
    skipped: Vec<u8>,
}

/// Runs `load`.
pub(super) fn run(load: &LoadArguments, link: &LinkArguments) -> Outcome<()> {
    let (name, source) = load.read()?;
    let mut target = Target::open(&link.line)?;
    let places = load.places.of(&target)?;
    let damper = build(&name, &source, target.greeting.step_s)?;
    let revisions = &target.greeting.revisions;
    let (skipped, others): (Vec<u8>, Vec<u8>) = places
        .into_iter()
        .partition(|place| revisions.get(usize::from(*place)) == Some(&damper.revision()));
    let image = &damper.to_image();
    for (count, place) in others.iter().enumerate() {
        let request = Request::Load {
            damper: *place,
            image,
        };
        target.order(&request).map_err(|failure| {
            let loaded = match &others[..count] {
                [] => "nothing was loaded".into(),
                loaded => format!("already loaded: {}", named(loaded)),
            };
            Failure::new(format!("slot {place}: {failure}; {loaded}"))
        })?;
    }
    let report = Report {
        damper: name,
        revision: damper.revision(),
        loaded: others,
        skipped,
    };
    link.print(&report, |out, report| {
        writeln!(out, "{}, revision {:#010x}", report.damper, report.revision)?;
        if !report.loaded.is_empty() {
            writeln!(out, "loaded into {}", named(&report.loaded))?;
        }
        if !report.skipped.is_empty() {
            writeln!(out, "skipped {}: already loaded", named(&report.skipped))?;
        }
        Ok(())
    })
}
