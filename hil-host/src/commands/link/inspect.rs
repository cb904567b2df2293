//! Identity and state of a target: `hello`, `status`, `clear`, `counters`, `outputs`.

use std::io::{self, Write};

use dashpot_core::link::{Counters, Request, Response};
use serde::Serialize;

use super::LinkArguments;
use super::target::{Greeting, Target, step_in_words};
use crate::commands::failure::Outcome;
use dashpot_files::status_bits::{self, StatusBit};

/// Runs `hello`.
pub(super) fn hello(link: &LinkArguments) -> Outcome<()> {
    let target = Target::open(&link.line)?;
    link.print(&target.greeting, print_greeting)
}

fn print_greeting(out: &mut dyn Write, greeting: &Greeting) -> io::Result<()> {
    let version = &greeting.core_version;
    writeln!(
        out,
        "target    dashpot-core {version}, link protocol {}",
        greeting.protocol
    )?;
    writeln!(out, "step      {}", step_in_words(greeting.step_s))?;
    let runs = if greeting.running {
        "free-running"
    } else {
        "stepped by the host"
    };
    writeln!(out, "tick      {}, {runs}", greeting.tick)?;
    writeln!(out, "clock     {} Hz", greeting.clock_hz)?;
    writeln!(out, "\n slot    revision")?;
    for (place, revision) in greeting.revisions.iter().enumerate() {
        writeln!(out, "{place:>5}  {revision:#010x}")?;
    }
    Ok(())
}

/// Status of the damper in one slot.
#[derive(Serialize)]
struct PlaceStatus {
    place: usize,
    status: Vec<StatusBit>,
    /// Number of ticks whose displacement was held or limited, up to 65535.
    rejected_inputs: u16,
}

#[derive(Serialize)]
struct BankStatus {
    places: Vec<PlaceStatus>,
}

/// Runs `status`.
pub(super) fn status(link: &LinkArguments) -> Outcome<()> {
    let status = ask_status(link, &Request::Status)?;
    link.print(&status, print_status)
}

/// Runs `clear`.
pub(super) fn clear(link: &LinkArguments) -> Outcome<()> {
    let cleared = ask_status(link, &Request::ClearStatus)?;
    link.print(&cleared, |out, cleared| {
        writeln!(out, "cleared:")?;
        print_status(out, cleared)
    })
}

fn ask_status(link: &LinkArguments, request: &Request<'_>) -> Outcome<BankStatus> {
    Target::open(&link.line)?.ask(request, |response| match response {
        Response::Status {
            status,
            rejected_inputs,
        } => {
            let both = status.iter().zip(&rejected_inputs).enumerate();
            let places = both.map(|(place, (word, rejected_inputs))| PlaceStatus {
                place,
                status: status_bits::from_word(*word),
                rejected_inputs: *rejected_inputs,
            });
            Some(BankStatus {
                places: places.collect(),
            })
        }
        _ => None,
    })
}

fn print_status(out: &mut dyn Write, bank: &BankStatus) -> io::Result<()> {
    writeln!(out, " slot  rejected inputs  status")?;
    for slot in &bank.places {
        let status = status_bits::describe(&slot.status);
        writeln!(
            out,
            "{:>5}  {:>15}  {status}",
            slot.place, slot.rejected_inputs
        )?;
    }
    Ok(())
}

/// Runs `counters`.
pub(super) fn counters(link: &LinkArguments) -> Outcome<()> {
    let counters =
        Target::open(&link.line)?.ask(&Request::Counters, |response| match response {
            Response::Counters(counters) => Some(counters),
            _ => None,
        })?;
    link.print(&counters, print_counters)
}

fn print_counters(out: &mut dyn Write, counters: &Counters) -> io::Result<()> {
    writeln!(out, "since power-on:")?;
    for (count, what) in [
        (counters.accepted, "requests executed"),
        (counters.refused, "requests refused"),
        (counters.repeated, "repeated requests, answered again"),
        (counters.corrupt, "frames corrupted in transmission"),
        (counters.unreadable, "frames without a valid request"),
        (
            counters.no_session,
            "requests from a session that was not open",
        ),
        (counters.out_of_order, "requests out of sequence"),
        (counters.overruns, "ticks that started late"),
        (counters.link_losses, "losses of the link"),
        (
            counters.corruptions,
            "dampers and states corrupted in memory",
        ),
    ] {
        writeln!(out, "{count:>10}  {what}")?;
    }
    Ok(())
}

#[derive(Serialize)]
struct Outputs {
    /// Output of each slot (N).
    outputs_n: Vec<f32>,
}

/// Runs `outputs`.
pub(super) fn outputs(link: &LinkArguments) -> Outcome<()> {
    let outputs = Target::open(&link.line)?.ask(&Request::Outputs, |response| match response {
        Response::Outputs { outputs_n } => Some(Outputs {
            outputs_n: outputs_n.to_vec(),
        }),
        _ => None,
    })?;
    link.print(&outputs, |out, outputs| {
        writeln!(out, " slot    output_n")?;
        for (place, output_n) in outputs.outputs_n.iter().enumerate() {
            writeln!(out, "{place:>5}  {output_n:>10.1}")?;
        }
        Ok(())
    })
}
