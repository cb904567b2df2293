//! `dashpot dampers`, `vehicles`, `tracks`, `cases`, `studies`, `actuators` and `sheets` list the files that ship;
//! `dashpot show` prints one, to copy it and change the copy.

use std::io::{self, Write};

use clap::ValueEnum;
use serde::Serialize;

use super::Format;
use super::failure::{Failure, Outcome};
use super::print::{print_answer, print_data};
use dashpot_files::actuator::ACTUATORS;
use dashpot_files::case::CASES;
use dashpot_files::damper::PRESETS;
use dashpot_files::did_you_mean;
use dashpot_files::sheet::SHEETS;
use dashpot_files::study::STUDIES;
use dashpot_files::track::TRACKS;
use dashpot_files::vehicle::VEHICLES;

/// Fewest characters that describe a file.
const SHORTEST: usize = 20;

/// Kind of a file that ships.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Kind {
    /// A damper.
    #[value(alias = "dampers")]
    Damper,
    /// A vehicle.
    #[value(alias = "vehicles")]
    Vehicle,
    /// A track.
    #[value(alias = "tracks")]
    Track,
    /// A vehicle on a track at a speed.
    #[value(alias = "cases")]
    Case,
    /// Many cases.
    #[value(alias = "studies")]
    Study,
    /// An actuator of a rig.
    #[value(alias = "actuators")]
    Actuator,
    /// A sheet of a test on a rig.
    #[value(alias = "sheets")]
    Sheet,
}

impl Kind {
    /// Name and text of each file.
    fn files(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Self::Damper => &PRESETS,
            Self::Vehicle => &VEHICLES,
            Self::Track => &TRACKS,
            Self::Case => &CASES,
            Self::Study => &STUDIES,
            Self::Actuator => &ACTUATORS,
            Self::Sheet => &SHEETS,
        }
    }

    /// Name in an option and in messages.
    fn word(self) -> String {
        let value = self.to_possible_value();
        value.map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

/// Options of a list.
#[derive(Debug, Clone, clap::Args)]
pub struct ListArguments {
    /// Output format of the list.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Print a file that ships, to copy it and change the copy.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot show damper in-service > my-damper.toml
  dashpot show vehicle locomotive > my-locomotive.toml

Lists of the names: dashpot dampers, vehicles, tracks, cases, studies, actuators, sheets. docs/parameters.md describes
every key.")]
pub struct ShowArguments {
    /// Kind of the file.
    #[arg(value_enum)]
    kind: Kind,
    /// Name of the file.
    name: String,
}

#[derive(Serialize)]
struct Report {
    files: Vec<Line>,
}

#[derive(Serialize)]
struct Line {
    name: &'static str,
    description: String,
}

/// Lists the files of a kind.
///
/// # Errors
/// Standard output cannot be written.
pub fn list(kind: Kind, arguments: &ListArguments) -> Outcome<()> {
    let files = kind.files().iter().map(|(name, text)| Line {
        name,
        description: description(text),
    });
    let report = Report {
        files: files.collect(),
    };
    print_answer(arguments.format, &report, |out, report| {
        print(out, report, kind)
    })
}

fn print(out: &mut dyn Write, report: &Report, kind: Kind) -> io::Result<()> {
    let names = report.files.iter().map(|file| file.name.len());
    let width = names.max().unwrap_or(0);
    for Line { name, description } in &report.files {
        writeln!(out, "{name:width$}  {description}")?;
    }
    writeln!(out, "\ndashpot show {} NAME prints the file.", kind.word())
}

/// Prints a file.
///
/// # Errors
/// No file of this name ships, or standard output cannot be written.
pub fn show(arguments: &ShowArguments) -> Outcome<()> {
    let ShowArguments { kind, name } = arguments;
    let names = || kind.files().iter().map(|(name, _)| *name);
    let Some((_, text)) = kind.files().iter().find(|(known, _)| known == name) else {
        return Err(Failure::wrong_use(format!(
            "{} `{name}` does not ship; allowed: {}{}",
            kind.word(),
            names().collect::<Vec<_>>().join(", "),
            did_you_mean(name, names())
        )));
    };
    print_data(text.as_bytes())
}

/// Describes a file by the comment at its head: the first sentence, or the part of it before a colon.
fn description(text: &str) -> String {
    let lines = text.lines().map_while(|line| line.strip_prefix('#'));
    let words: Vec<&str> = lines
        .map(str::trim)
        .take_while(|line| !line.is_empty())
        .collect();
    let paragraph = words.join(" ");
    let is_abbreviation =
        |at: usize| paragraph[..at].ends_with("Fig") || paragraph[..at].ends_with("Figs");
    let mut stops = paragraph.match_indices(". ").map(|(at, _)| at);
    let stop = stops.find(|at| !is_abbreviation(*at));
    let sentence = &paragraph[..stop.unwrap_or(paragraph.len())];
    let clause = sentence.find(": ").filter(|at| *at >= SHORTEST);
    sentence[..clause.unwrap_or(sentence.len())]
        .trim_end_matches('.')
        .to_owned()
}

#[cfg(test)]
mod tests {
    use clap::ValueEnum;

    use super::{Kind, SHORTEST, description};

    #[test]
    fn the_head_of_a_file_describes_it() {
        let text = "# A slow actuator of a rig: it\n# resonates. Assumed.\n#\n# More.\nname = 1\n";
        assert_eq!(description(text), "A slow actuator of a rig");
        assert_eq!(
            description("# As in Fig. 3: slow.\n\n# Other.\n"),
            "As in Fig. 3: slow"
        );
        assert_eq!(description("name = 1\n"), "");
    }

    #[test]
    fn every_file_that_ships_describes_itself_in_a_line() {
        for kind in Kind::value_variants() {
            for (name, text) in kind.files() {
                let found = description(text);
                let length = found.chars().count();
                assert!(
                    (SHORTEST..=150).contains(&length),
                    "{name}: {length}: {found}"
                );
            }
        }
    }
}
