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

/// Runs the areas, which takes hours for all of them. The results are in `target/mutants/NAME`. Options are those of
/// cargo-mutants, such as `--jobs 2` or `--shard 0/8`.
///
/// # Errors
/// Cargo-mutants cannot be installed or run, or a change survived all rounds.
pub fn mutants(areas: &[&Area], options: &[&str]) -> Outcome {
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
    let mut survivors = String::new();
    for round in area.rounds {
        let arguments = arguments(area, round, options, &survivors);
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let Err(error) = cargo(&arguments) else {
            return Ok(());
        };
        let failure = format!("{}: {error}", area.name);
        let read = |name| {
            fs::read_to_string(folder.join("mutants.out").join(name)).map_err(|_| failure.clone())
        };
        survivors = read("missed.txt")?;
        if survivors.is_empty() {
            // A change that makes a test endless is noticed. A failure without either is one of cargo-mutants, such as
            // tests that fail without any change.
            let is_noticed = !read("timeout.txt")?.is_empty();
            return is_noticed.then_some(()).ok_or(failure);
        }
    }
    Err(format!("{}: no test noticed\n{survivors}", area.name))
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

/// Returns the arguments of cargo for a round. The first round, without survivors, tries what the options of
/// cargo-mutants select; a later one tries the `survivors`, one per line as cargo-mutants prints them.
fn arguments(area: &Area, round: &Round, options: &[&str], survivors: &str) -> Vec<String> {
    let output = output(area);
    let output = output.to_string_lossy();
    let mut arguments = vec!["mutants", "--no-shuffle", "--package", area.package];
    arguments.extend(["--output", &*output]);
    arguments.extend(area.files.iter().flat_map(|file| ["--file", file]));
    arguments.extend(
        round
            .packages
            .iter()
            .flat_map(|package| ["--test-package", package]),
    );
    let changes: Vec<String> = survivors
        .lines()
        .map(|line| format!("^{}$", escaped(line)))
        .collect();
    if changes.is_empty() {
        arguments.extend(options);
    }
    arguments.extend(changes.iter().flat_map(|change| ["--re", change.as_str()]));
    arguments.push("--");
    arguments.extend(round.tests);
    arguments.into_iter().map(str::to_owned).collect()
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
    use super::{AREAS, arguments, select};
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
        let line = arguments(area, &area.rounds[0], &["--jobs", "2"], "").join(" ");
        let expected = "--file rail/src/vehicle/engine/**/*.rs --test-package dashpot-rail --jobs 2 \
                        -- --lib --test vehicle";
        assert!(line.ends_with(expected), "{line}");
    }

    #[test]
    fn later_rounds_try_the_survivors() {
        let area = &AREAS[2];
        let survivors = "a.rs:1:2: replace * with + in f\n";
        let line = arguments(area, &area.rounds[1], &["--jobs", "2"], survivors).join(" ");
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
