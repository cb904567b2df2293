//! Sample reports and the live page, which the program writes into the finished book.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::run::{Outcome, cargo_command, repository, run};

/// Folder of the samples, relative to the repository's and to the book's folder.
const FOLDER: &str = "docs/samples";
/// Folder in which the commands run. It keeps their other files out of the book.
const WORK: &str = "target/book/samples";

/// A page of the program.
struct Sample {
    /// Name in the folder of the samples.
    name: &'static str,
    /// Arguments of the command, which writes the page.
    arguments: &'static str,
    /// The written page, relative to the folder in which the command runs.
    written: &'static str,
}

const SAMPLES: [Sample; 5] = [
    Sample {
        name: "live.html",
        arguments: "live --case curve-r300 --page live.html",
        written: "live.html",
    },
    Sample {
        name: "demonstration.html",
        arguments: "--output demonstration.html",
        written: "demonstration.html",
    },
    Sample {
        name: "sheet.html",
        arguments: "rig --damper in-service --sheet example --page sheet.html",
        written: "sheet.html",
    },
    Sample {
        name: "vehicle.html",
        arguments: "vehicle --case straight-180 --output vehicle",
        written: "vehicle/report.html",
    },
    Sample {
        name: "study.html",
        arguments: "sweep paper --seeds 4 --output study",
        written: "study/report.html",
    },
];

/// True for a sample, which exists only in the finished book. The path is relative to the repository.
pub fn is_sample(path: &Path) -> bool {
    SAMPLES
        .iter()
        .any(|sample| path == Path::new(FOLDER).join(sample.name))
}

/// Writes the samples into the finished book. Builds the program with optimisation.
///
/// # Errors
/// The program cannot be built, a command fails, or a page cannot be copied.
pub fn write_samples(book: &Path) -> Outcome {
    let work = repository().join(WORK);
    let folder = book.join(FOLDER);
    let failed =
        |path: &Path, error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    fs::create_dir_all(&folder).map_err(|error| failed(&folder, &error))?;
    // A study would resume with the rows of an earlier book.
    if work.exists() {
        fs::remove_dir_all(&work).map_err(|error| failed(&work, &error))?;
    }
    fs::create_dir_all(&work).map_err(|error| failed(&work, &error))?;
    for sample in &SAMPLES {
        run(
            command(sample, &work),
            &format!("dashpot {}", sample.arguments),
        )?;
        let to = folder.join(sample.name);
        let written = work.join(sample.written);
        fs::copy(&written, &to).map_err(|error| failed(&written, &error))?;
    }
    Ok(())
}

/// Returns the command that writes a sample in the folder `work`.
fn command(sample: &Sample, work: &Path) -> Command {
    let manifest = repository().join("Cargo.toml");
    let mut command = cargo_command(&["run", "--release", "--locked", "--quiet"]);
    command
        .arg("--manifest-path")
        .arg(manifest)
        .arg("--")
        .args(sample.arguments.split(' '))
        .current_dir(work);
    command
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    use super::{FOLDER, SAMPLES, is_sample, write_samples};
    use crate::book::links::links;
    use crate::run::repository;

    /// Page that links the samples.
    const PAGE: &str = "docs/samples.md";

    fn read(path: &str) -> String {
        std::fs::read_to_string(repository().join(path)).expect(path)
    }

    #[test]
    fn the_page_links_every_sample_and_states_its_command() {
        let page = read(PAGE);
        let targets: BTreeSet<String> = links(&page).into_iter().map(|link| link.target).collect();
        for sample in &SAMPLES {
            assert!(is_sample(&Path::new(FOLDER).join(sample.name)));
            let target = format!("samples/{}", sample.name);
            assert!(targets.contains(&target), "{PAGE}: no link to {target}");
            let command = format!("`dashpot {}`", sample.arguments);
            assert!(page.contains(&command), "{PAGE}: no {command}");
        }
        assert!(!is_sample(Path::new("docs/samples/other.html")) && !is_sample(Path::new(PAGE)));
    }

    /// docs/reference/commands.md has the help of every command, which tests compare.
    #[test]
    fn the_commands_have_the_options_of_the_samples() {
        let commands = read("docs/reference/commands.md");
        for sample in &SAMPLES {
            let words: Vec<&str> = sample.arguments.split(' ').collect();
            let name = match words[0].starts_with('-') {
                true => "dashpot".to_owned(),
                false => format!("dashpot {}", words[0]),
            };
            let (_, help) = commands
                .split_once(&format!("\n## {name}\n"))
                .unwrap_or_else(|| panic!("no command {name}"));
            let help = help.split("\n## ").next().expect("the help");
            for option in words.iter().filter(|word| word.starts_with("--")) {
                let line = format!("\n      {option} <");
                assert!(help.contains(&line), "{name} has no {option}");
            }
            let folder = sample.written.split('/').next().expect("a name");
            assert!(words.contains(&folder), "{} is not written", sample.written);
        }
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_reported() {
        let file = tempfile::NamedTempFile::new().expect("a file");
        // A book cannot be where a file is.
        let error = write_samples(file.path()).expect_err("no folder");
        assert!(error.contains("samples"), "{error}");
    }
}
