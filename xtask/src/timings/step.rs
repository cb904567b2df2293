//! Counts the instructions of a step in the command, built as users build it.

use std::path::Path;
use std::process::Command;

use crate::run::{Outcome, output_of};

/// Number of steps that are counted.
const STEPS: u32 = 20_000;

/// Maximum number of instructions of a step in `f32` on x86-64; 386 were measured. If compiled without optimisation, or
/// in several codegen units, a step takes 2000 or more.
const MAX_INSTRUCTIONS: u64 = 450;

/// Counts the instructions of a step of `program` with Valgrind and checks the bound.
///
/// # Errors
/// Valgrind fails, or a step takes too many instructions.
pub fn check(program: &Path) -> Outcome {
    let counts = program.with_file_name("step.callgrind");
    let mut valgrind = Command::new("valgrind");
    valgrind
        .arg("--tool=callgrind")
        .arg(format!("--callgrind-out-file={}", counts.display()))
        .arg("--toggle-collect=*compiled_step*")
        .arg(program)
        .args(["budget", "--steps", &STEPS.to_string()]);
    output_of(valgrind, "valgrind")?;
    let text = std::fs::read_to_string(&counts)
        .map_err(|error| format!("{}: {error}", counts.display()))?;
    let total = total(&text).ok_or_else(|| format!("{}: no summary", counts.display()))?;
    judge(total / u64::from(STEPS))
}

/// Total number of instructions in callgrind's output file.
fn total(text: &str) -> Option<u64> {
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("totals: "))?;
    line.trim().parse().ok()
}

fn judge(instructions: u64) -> Outcome {
    println!("a step takes {instructions} instructions, at most {MAX_INSTRUCTIONS} are allowed");
    if (1..=MAX_INSTRUCTIONS).contains(&instructions) {
        return Ok(());
    }
    Err(format!(
        "a step of the command takes {instructions} instructions, 1 to {MAX_INSTRUCTIONS} are allowed: keep the step \
         in an optimised crate (testbench/src/compiled.rs and the release profile in Cargo.toml)"
    ))
}

#[cfg(test)]
mod tests {
    use super::{MAX_INSTRUCTIONS, judge, total};

    #[test]
    fn the_total_is_read() {
        assert_eq!(
            total("events: Ir\nfn=(1)\ntotals: 7720000\n"),
            Some(7_720_000)
        );
        assert_eq!(total("events: Ir\n"), None);
    }

    #[test]
    fn too_many_and_no_instructions_fail() {
        assert_eq!(judge(MAX_INSTRUCTIONS), Ok(()));
        assert!(judge(MAX_INSTRUCTIONS + 1).is_err());
        assert!(judge(0).is_err());
    }
}
