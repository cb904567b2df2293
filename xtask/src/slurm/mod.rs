//! `cargo xtask slurm`: the files of `cluster/` with a real scheduler, and what `dashpot merge` makes of it.

mod array;
mod node;
mod parallel;
mod trial;

use crate::run::{Outcome, cargo, output_of};
use crate::tools::{MUNGED, PARALLEL, SBATCH, SLURMCTLD, SLURMD, Tool, install, missing};

use node::Node;
use trial::{CASES, SHARDS, Trial};

/// What the proof runs.
const TOOLS: [Tool; 5] = [MUNGED, SLURMCTLD, SLURMD, SBATCH, PARALLEL];

/// What is checked, in this order.
type Check = (&'static str, fn(&Trial) -> Outcome<String>);

const CHECKS: [Check; 9] = [
    (
        "array of 4 shards: merged as one machine has it",
        array::complete,
    ),
    (
        "shards ended midway, by scancel and killed: missing cases named",
        array::ended,
    ),
    (
        "these shards sent again: go on with their rows",
        array::resumed,
    ),
    (
        "queued again by Slurm midway: goes on with its rows",
        array::requeued,
    ),
    (
        "complete shard sent again: nothing run, nothing changed",
        array::complete_again,
    ),
    (
        "the same shard twice at once: one refused, rows right",
        array::twice_at_once,
    ),
    (
        "a task of 5 shards among 4: double and missing named",
        array::wrong_count,
    ),
    ("a task beyond the shards: refused", array::beyond),
    (
        "GNU parallel, one shard failed: that one run again",
        parallel::one_failed,
    ),
];

/// Builds `dashpot`, starts Slurm, checks, prints a table, and ends Slurm.
///
/// # Errors
/// What is missing; a check that failed.
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
    println!("| check | result | seen |\n|---|---|---|");
    let mut failed = 0;
    for (name, check) in CHECKS {
        failed += tell(name, check(&trial));
    }
    failed += tell("Slurm ended, nothing left", trial.node.end());
    match failed {
        0 => Ok(()),
        _ => Err(format!(
            "{failed} checks failed; rows and logs are in {}",
            trial.folder.display()
        )),
    }
}

/// What the checks are made with, as each program tells it.
fn versions(node: &Node) -> Outcome<String> {
    let mut told = Vec::new();
    for program in ["sinfo", "munge", "parallel"] {
        let mut command = node.command(program);
        command.arg("--version");
        let text = output_of(command, &format!("{program} --version"))?;
        told.push(text.lines().next().unwrap_or_default().to_owned());
    }
    Ok(told.join(", "))
}

/// Prints a line of the table; how many of its checks failed.
fn tell(name: &str, outcome: Outcome<String>) -> u32 {
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
