//! `cargo xtask slurm`: runs the files of `cluster/` with a real scheduler and merges the results with `dashpot merge`.

mod array;
mod node;
mod parallel;
mod trial;

use crate::run::{Outcome, cargo, output_of};
use crate::tools::{MUNGED, PARALLEL, SBATCH, SLURMCTLD, SLURMD, Tool, install, missing};

use node::Node;
use trial::{CASES, SHARDS, Trial};

/// Programs that the checks run.
const TOOLS: [Tool; 5] = [MUNGED, SLURMCTLD, SLURMD, SBATCH, PARALLEL];

/// Name of a check, and its function, which returns what it observed.
type Check = (&'static str, fn(&Trial) -> Outcome<String>);

const CHECKS: [Check; 9] = [
    (
        "array of 4 shards: merged rows equal those of one process",
        array::complete,
    ),
    (
        "shards ended midway by scancel and by SIGKILL: missing cases named",
        array::ended,
    ),
    (
        "the same shards resubmitted: resume from their rows",
        array::resumed,
    ),
    (
        "requeued by Slurm midway: resumes from its rows",
        array::requeued,
    ),
    (
        "complete shard resubmitted: nothing run, nothing changed",
        array::complete_again,
    ),
    (
        "the same shard twice at once: one refused, rows correct",
        array::twice_at_once,
    ),
    (
        "a task of 5 shards among 4: duplicate and missing cases named",
        array::wrong_count,
    ),
    ("a task beyond the shards: refused", array::beyond),
    (
        "GNU parallel with a failed shard: only that shard run again",
        parallel::one_failed,
    ),
];

/// Builds `dashpot`, starts Slurm, runs the checks, prints a table, and stops Slurm.
///
/// # Errors
/// A program is missing, or a check failed.
pub fn slurm() -> Outcome {
    let packages = missing(&TOOLS);
    if !packages.is_empty() {
        install(&packages)?;
    }
    cargo(&[
        "build",
        "--release",
        "--package",
        "dashpot-hil",
        "--bin",
        "dashpot",
    ])?;
    eprintln!("> rows of one process");
    let trial = Trial::new(Node::start()?)?;
    println!(
        "{}; {CASES} cases in {SHARDS} shards\n",
        versions(&trial.node)?
    );
    println!("| check | result | observed |\n|---|---|---|");
    let mut failed = 0;
    for (name, check) in CHECKS {
        failed += print_row(name, check(&trial));
    }
    failed += print_row("Slurm stopped, nothing left", trial.node.end());
    match failed {
        0 => Ok(()),
        _ => Err(format!(
            "{failed} checks failed; rows and logs are in {}",
            trial.folder.display()
        )),
    }
}

/// Returns the versions of the programs, as they print them.
fn versions(node: &Node) -> Outcome<String> {
    let mut versions = Vec::new();
    for program in ["sinfo", "munge", "parallel"] {
        let mut command = node.command(program);
        command.arg("--version");
        let text = output_of(command, &format!("{program} --version"))?;
        versions.push(text.lines().next().unwrap_or_default().to_owned());
    }
    Ok(versions.join(", "))
}

/// Prints a row of the table and returns the number of failed checks, 0 or 1.
fn print_row(name: &str, outcome: Outcome<String>) -> u32 {
    match outcome {
        Ok(seen) => {
            println!("| {name} | ok | {seen} |");
            0
        }
        Err(reason) => {
            let words: Vec<&str> = reason.split_whitespace().collect();
            println!("| {name} | FAILED | {} |", words.join(" "));
            1
        }
    }
}
