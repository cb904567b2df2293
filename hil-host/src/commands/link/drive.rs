//! The free-running tick by hand: `run`, `displace`, `stop`.

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
    /// Displacement, positive in extension, m; one for all places, or one for each separated by commas.
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

/// What the target does from now on.
#[derive(Serialize)]
struct Driven {
    running: bool,
    /// The last tick before that.
    tick: u32,
    /// Of each place (m).
    displacements_m: Vec<f32>,
}

/// `run`.
pub(super) fn run(run: &DisplacementArguments, link: &LinkArguments) -> Outcome<()> {
    let driven = drive(run, link, |displacements_m| Request::Run {
        displacements_m,
    })?;
    link.print(&driven, |out, _| {
        writeln!(out, "the tick runs free, every damper from rest")
    })
}

/// `displace`.
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

/// `stop`.
pub(super) fn stop(link: &LinkArguments) -> Outcome<()> {
    Target::open(&link.line)?.order(&Request::Stop)?;
    link.print(&Stopped { running: false }, |out, _| {
        writeln!(out, "stopped: the host steps, the outputs are 0")
    })
}
