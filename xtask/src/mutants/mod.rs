//! `cargo xtask mutants`: makes small changes to the code that must not break, one at a time, and lists the changes
//! that no test notices.
//!
//! `.cargo/mutants.toml` lists the surviving changes that were judged harmless, each with its reason.

use std::fs;
use std::path::PathBuf;

use crate::run::{Outcome, cargo, repository};
use crate::tools::CARGO_MUTANTS;

mod areas;

pub use areas::{AREAS, Area, Round};

/// Runs the areas with these names, or all areas without names.
///
/// This takes hours. The results are in `target/mutants/NAME`. Options are those of cargo-mutants, such as `--jobs 2`
/// or `--shard 0/8`.
///
/// # Errors
/// An area is unknown, cargo-mutants cannot be installed or run, or a change survived all rounds.
pub fn mutants(names: &[&str], options: &[&str]) -> Outcome {
    let areas = select(names)?;
    CARGO_MUTANTS.install()?;
    let failures: Vec<String> = areas
        .iter()
        .filter_map(|area| run(area, options).err())
        .collect();
    if failures.is_empty() {
        Ok(())
    } else {
        Err(failures.join("\n"))
    }
}

/// Runs the rounds of an area until no change survives.
fn run(area: &Area, options: &[&str]) -> Outcome {
    let folder = output(area);
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut changes = Changes::All(options);
    for round in area.rounds {
        let arguments = arguments(area, round, &changes);
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let Err(error) = cargo(&arguments) else {
            return Ok(());
        };
        let read = |name| {
            fs::read_to_string(folder.join("mutants.out").join(name))
                .map_err(|_| format!("{}: {error}", area.name))
        };
        let (missed, endless) = (read("missed.txt")?, read("timeout.txt")?);
        // A change that makes a test endless is noticed. A failure without either is one of cargo-mutants, such as
        // tests that fail without any change.
        if missed.is_empty() {
            let noticed = !endless.is_empty();
            return noticed
                .then_some(())
                .ok_or_else(|| format!("{}: {error}", area.name));
        }
        let survivors = missed.lines().map(str::to_owned).collect();
        changes = Changes::Survivors(survivors);
    }
    match changes {
        Changes::All(_) => Ok(()),
        Changes::Survivors(lines) => Err(format!(
            "{}: no test noticed\n{}",
            area.name,
            lines.join("\n")
        )),
    }
}

/// Changes that a round tries.
enum Changes<'a> {
    /// All that the options of cargo-mutants select.
    All(&'a [&'a str]),
    /// Those that the last round did not notice, as cargo-mutants prints them.
    Survivors(Vec<String>),
}

/// Returns the areas with these names, or all areas without names.
///
/// # Errors
/// A name is unknown.
pub fn select(names: &[&str]) -> Outcome<Vec<&'static Area>> {
    if names.is_empty() {
        return Ok(AREAS.iter().collect());
    }
    let find = |name: &&str| {
        AREAS.iter().find(|area| area.name == *name).ok_or_else(|| {
            let known = AREAS.each_ref().map(|area| area.name).join(", ");
            format!("mutants: `{name}` is unknown, allowed: {known}")
        })
    };
    names.iter().map(find).collect()
}

/// Returns the folder for the results of an area.
fn output(area: &Area) -> PathBuf {
    repository().join("target/mutants").join(area.name)
}

/// Returns the arguments of cargo for a round.
fn arguments(area: &Area, round: &Round, changes: &Changes<'_>) -> Vec<String> {
    let output = output(area);
    let fixed = [
        "mutants",
        "--no-shuffle",
        "--package",
        area.package,
        "--output",
    ];
    let mut arguments: Vec<String> = fixed.map(str::to_owned).into();
    arguments.push(output.to_string_lossy().into_owned());
    let mut add =
        |option: &str, value: &str| arguments.extend([option.to_owned(), value.to_owned()]);
    for file in area.files {
        add("--file", file);
    }
    for package in round.packages {
        add("--test-package", package);
    }
    match changes {
        Changes::All(options) => arguments.extend(options.iter().map(|&option| option.to_owned())),
        Changes::Survivors(lines) => {
            for line in lines {
                add("--re", &format!("^{}$", escaped(line)));
            }
        }
    }
    arguments.push("--".to_owned());
    arguments.extend(round.tests.iter().map(|&argument| argument.to_owned()));
    arguments
}

/// Returns a regular expression that matches this text only.
fn escaped(text: &str) -> String {
    let escape = |c: char| match c {
        '.' | '*' | '+' | '?' | '(' | ')' | '[' | ']' | '{' | '}' | '|' | '^' | '$' | '\\' => {
            vec!['\\', c]
        }
        _ => vec![c],
    };
    text.chars().flat_map(escape).collect()
}

#[cfg(test)]
mod tests {
    use super::{AREAS, Changes, arguments, select};
    use crate::run::repository;

    #[test]
    fn areas_are_selected_by_name() {
        let names = |names: &[&str]| {
            select(names).map(|areas| areas.iter().map(|area| area.name).collect::<Vec<_>>())
        };
        assert_eq!(names(&["engine", "step"]), Ok(vec!["engine", "step"]));
        assert_eq!(names(&[]).map(|names| names.len()), Ok(AREAS.len()));
        assert!(
            names(&["steps"])
                .unwrap_err()
                .contains("allowed: step, health")
        );
    }

    #[test]
    fn tests_come_after_the_files_and_packages() {
        let area = &AREAS[2];
        let all = Changes::All(&["--jobs", "2"]);
        let line = arguments(area, &area.rounds[0], &all).join(" ");
        let expected = "--file rail/src/vehicle/engine/**/*.rs --test-package dashpot-rail --jobs 2 \
                        -- --lib --test vehicle";
        assert!(line.ends_with(expected), "{line}");
    }

    #[test]
    fn later_rounds_try_the_survivors() {
        let area = &AREAS[2];
        let survivors = Changes::Survivors(vec!["a.rs:1:2: replace * with + in f".to_owned()]);
        let line = arguments(area, &area.rounds[1], &survivors).join(" ");
        assert!(
            line.contains(r"--re ^a\.rs:1:2: replace \* with \+ in f$ --"),
            "{line}"
        );
    }

    #[test]
    fn there_is_code_at_every_path() {
        for path in AREAS.iter().flat_map(|area| area.files) {
            let fixed = path.split('*').next().unwrap_or_default();
            assert!(repository().join(fixed).exists(), "{path}");
        }
    }
}
