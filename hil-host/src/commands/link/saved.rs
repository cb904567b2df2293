//! `save` and `restore`: the states of a bank and its tick in a file.

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

/// Save the states of all dampers and the tick to a file.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Example:
  dashpot link --link serial:/dev/ttyACM0 save --output states.toml

The file is TOML: the tick, and for each slot the damper's revision, displacement, stretch, flow potential, force,
status and rejected inputs, all bit-exact.")]
pub(super) struct SaveArguments {
    /// File to write, `-` for standard output.
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
}

/// Restore the states of all dampers and the tick from a file; the target must not be free-running.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Example:
  dashpot link --link serial:/dev/ttyACM0 restore --input states.toml

A state belongs to one damper: if the target holds another one, load the right one first (`load`, then `set` for the
clearance).")]
pub(super) struct RestoreArguments {
    /// File written by `save`, `-` for standard input.
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

/// Runs `save`.
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

/// Runs `restore`.
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

/// Checks that the states belong to dampers of these revisions.
fn check(bank: &BankState, revisions: &[u32]) -> Result<(), String> {
    if bank.slots.len() != revisions.len() {
        return Err(format!(
            "{}, but the target has {}; allowed: one state per slot",
            counted(bank.slots.len() as u64, "state"),
            counted(revisions.len() as u64, "slot")
        ));
    }
    let pairs = bank.slots.iter().zip(revisions).enumerate();
    let others: Vec<String> = pairs
        .filter(|(_, (state, revision))| state.revision != **revision)
        .map(|(place, (state, revision))| {
            format!(
                "slot {place}: state of damper {:#010x}, but the target holds {revision:#010x}",
                state.revision
            )
        })
        .collect();
    if others.is_empty() {
        Ok(())
    } else {
        Err(format!(
            "{}; first load the dampers that the states belong to",
            others.join("; ")
        ))
    }
}
