//! `save` and `restore`: the states of a bank and its tick, kept in a file.

use std::path::PathBuf;

use dashpot_core::link::{Request, Response};
use serde::Serialize;

use super::LinkArguments;
use super::target::Target;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::print::{counted, print_report_beside};
use dashpot_files::FileError;
use dashpot_files::input;
use dashpot_files::output::{self, cannot_write, write_whole};
use dashpot_files::states::BankState;

/// Write the states of all dampers and the tick to a file.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Example:
  dashpot link --link serial:/dev/ttyACM0 save --output states.toml

The file is TOML: the tick, and for each place the revision of its damper, displacement, stretch, flow potential, force, \
status and rejected inputs, to the bit.")]
pub(super) struct SaveArguments {
    /// File to write, `-` for standard output.
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
}

/// Give all dampers of a target that does not run free the states and the tick of a file.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Example:
  dashpot link --link serial:/dev/ttyACM0 restore --input states.toml

A state goes with its damper: where the target holds another one, load it first (`load`, and `set` for the clearance).")]
pub(super) struct RestoreArguments {
    /// File that `save` wrote, `-` for standard input.
    #[arg(long, value_name = "FILE")]
    input: PathBuf,
}

/// States that were saved or restored.
#[derive(Serialize)]
struct Report {
    file: String,
    tick: u32,
    dampers: usize,
}

/// `save`.
pub(super) fn save(save: &SaveArguments, link: &LinkArguments) -> Outcome<()> {
    let path = &save.output;
    let mut report = Report {
        file: output::name(path).display().to_string(),
        tick: 0,
        dampers: 0,
    };
    write_whole::<_, Failure>(path, |file| {
        let bank = Target::open(&link.line)?.ask(&Request::Save, |response| match response {
            Response::Saved { tick, states } => BankState::from_bytes(tick, states),
            _ => None,
        })?;
        (report.tick, report.dampers) = (bank.tick, bank.slots.len());
        file.write_all(bank.to_toml()?.as_bytes())
            .map_err(|error| cannot_write(path, error))?;
        Ok(())
    })?;
    print_report_beside(path, link.format, &report, |out, report| {
        let (tick, file) = (report.tick, &report.file);
        let states = counted(report.dampers as u64, "state");
        writeln!(out, "{states} of tick {tick} in {file}")
    })
}

/// `restore`.
pub(super) fn restore(restore: &RestoreArguments, link: &LinkArguments) -> Outcome<()> {
    let path = &restore.input;
    let bank = BankState::read(path)?;
    let mut target = Target::open(&link.line)?;
    check(&bank, &target.greeting.revisions)
        .map_err(|reason| FileError::in_file(&input::name(path), reason))?;
    target.order(&Request::Restore {
        tick: bank.tick,
        states: &bank.to_bytes(),
    })?;
    let report = Report {
        file: input::name(path).display().to_string(),
        tick: bank.tick,
        dampers: bank.slots.len(),
    };
    link.print(&report, |out, report| {
        let (tick, file) = (report.tick, &report.file);
        let states = counted(report.dampers as u64, "state");
        writeln!(out, "{states} of tick {tick} restored from {file}")
    })
}

/// Whether the states are of the dampers of these revisions, or why not.
fn check(bank: &BankState, revisions: &[u32]) -> Result<(), String> {
    if bank.slots.len() != revisions.len() {
        return Err(format!(
            "{}, the target has {}; allowed: one state for each place",
            counted(bank.slots.len() as u64, "state"),
            counted(revisions.len() as u64, "place")
        ));
    }
    let pairs = bank.slots.iter().zip(revisions).enumerate();
    let others: Vec<String> = pairs
        .filter(|(_, (state, revision))| state.revision != **revision)
        .map(|(place, (state, revision))| {
            format!(
                "place {place}: state of damper {:#010x}, the target's is {revision:#010x}",
                state.revision
            )
        })
        .collect();
    if others.is_empty() {
        Ok(())
    } else {
        Err(format!(
            "{}; load the dampers that made the states first",
            others.join("; ")
        ))
    }
}
