//! Manual control of the free-running mode: `run`, `displace`, `stop`.

use dashpot_core::link::{Reals, Request, Response};
use serde::Serialize;

use super::LinkArguments;
use super::target::Target;
use crate::commands::failure::Outcome;

/// Displacements of the dampers.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot link --link serial:/dev/ttyACM0 run --displacement-m 0
  dashpot link --link serial:/dev/ttyACM0 displace --displacement-m 0.001,0.001,-0.002")]
pub(super) struct DisplacementArguments {
    /// Displacement, positive in extension, m: one for all slots, or one per slot, separated by commas.
    #[arg(
        long,
        value_name = "M",
        required = true,
        value_delimiter = ',',
        value_parser = finite,
        allow_hyphen_values = true
    )]
    displacement_m: Vec<f32>,
}

fn finite(text: &str) -> Result<f32, &'static str> {
    text.parse()
        .ok()
        .filter(|number: &f32| number.is_finite())
        .ok_or("allowed: a finite number in single precision")
}

/// State of the target after the request.
#[derive(Serialize)]
struct Driven {
    running: bool,
    /// Last tick before the request took effect.
    tick: u32,
    /// Displacement of each slot (m).
    displacements_m: Vec<f32>,
}

/// Runs `run`.
pub(super) fn run(run: &DisplacementArguments, link: &LinkArguments) -> Outcome<()> {
    let driven = drive(run, link, |displacements_m| Request::Run {
        displacements_m,
    })?;
    link.print(&driven, |out, _| {
        writeln!(out, "free-running; every damper started from rest")
    })
}

/// Runs `displace`.
pub(super) fn displace(displace: &DisplacementArguments, link: &LinkArguments) -> Outcome<()> {
    let driven = drive(displace, link, |displacements_m| Request::Displace {
        displacements_m,
    })?;
    link.print(&driven, |out, driven| {
        writeln!(out, "displaced after tick {}", driven.tick)
    })
}

fn drive(
    arguments: &DisplacementArguments,
    link: &LinkArguments,
    request: impl FnOnce(Reals) -> Request<'static>,
) -> Outcome<Driven> {
    let mut target = Target::open(&link.line)?;
    let given = target.for_each_damper("--displacement-m", &arguments.displacement_m)?;
    let displacements_m = given.to_vec();
    target.ask(&request(given), |response| match response {
        Response::Forces(forces) => Some(Driven {
            running: true,
            tick: forces.tick,
            displacements_m,
        }),
        _ => None,
    })
}

#[derive(Serialize)]
struct Stopped {
    running: bool,
}

/// Runs `stop`.
pub(super) fn stop(link: &LinkArguments) -> Outcome<()> {
    Target::open(&link.line)?.order(&Request::Stop)?;
    link.print(&Stopped { running: false }, |out, _| {
        writeln!(
            out,
            "stopped: the host triggers each step, the outputs are 0"
        )
    })
}
