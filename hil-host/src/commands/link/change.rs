//! Settings of a target that take effect immediately: `set` and `loss-of-link`.

use std::fmt;
use std::str::FromStr;

use dashpot_core::link::{LossOfLink, Parameter, Request, SafeOutput};
use dashpot_core::parameters::MAX_CLEARANCE_M;
use serde::Serialize;

use super::LinkArguments;
use super::places;
use super::target::Target;
use crate::commands::failure::Outcome;
use crate::commands::print::counted;

/// Change the clearance of the damper in one slot immediately; its force stays continuous.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Example:
  dashpot link --link serial:/dev/ttyACM0 set --place 3 --clearance-m 0.001

This also changes the damper's revision. To change any other parameter, load a new damper: dashpot link load --help")]
pub(super) struct SetArguments {
    /// Slot of the bank, from 0.
    #[arg(long, value_parser = places::place())]
    place: u8,
    /// Clearance 2a (total play), m.
    #[arg(
        help = format!("Clearance 2a (total play), m; 0 to {MAX_CLEARANCE_M}"),
        long,
        value_name = "M",
        value_parser = clearance,
        allow_hyphen_values = true
    )]
    clearance_m: f32,
}

fn clearance(text: &str) -> Result<f32, String> {
    text.parse()
        .ok()
        .filter(|clearance_m| (0.0..=MAX_CLEARANCE_M as f32).contains(clearance_m))
        .ok_or_else(|| format!("allowed: 0 to {MAX_CLEARANCE_M} m"))
}

#[derive(Serialize)]
struct Set {
    place: u8,
    clearance_m: f32,
}

/// Runs `set`.
pub(super) fn set(set: &SetArguments, link: &LinkArguments) -> Outcome<()> {
    let (place, clearance_m) = (set.place, set.clearance_m);
    let mut target = Target::open(&link.line)?;
    places::check(place, &target)?;
    target.order(&Request::Set {
        damper: place,
        parameter: Parameter::ClearanceM,
        value: clearance_m,
    })?;
    link.print(&Set { place, clearance_m }, |out, set| {
        writeln!(out, "slot {}: clearance {} m", set.place, set.clearance_m)
    })
}

/// Configure when the link is treated as lost, and the outputs after that.
///
/// In free-running mode, the target treats the link as lost after more than this number of ticks without a
/// displacement. The outputs then stay safe until the next `run` or `stop`.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot link --link serial:/dev/ttyACM0 loss-of-link --after-ticks 100 --output ramp=100
  dashpot link --link serial:/dev/ttyACM0 loss-of-link --after-ticks 1 --output zero

The target's own default is 100 ticks and a ramp of 100.")]
pub(super) struct LossOfLinkArguments {
    /// Number of ticks without a displacement that are tolerated.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    after_ticks: u32,
    /// Outputs after a loss: hold (the last force), ramp=TICKS (to zero within this number of ticks) or zero.
    #[arg(long, value_name = "OUTPUT")]
    output: SafeOutputChoice,
}

/// A safe output, parsed from its name on the command line.
#[derive(Debug, Clone, Copy)]
struct SafeOutputChoice(SafeOutput);

impl FromStr for SafeOutputChoice {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let ramp = |text: &str| text.strip_prefix("ramp=")?.parse().ok();
        match (text, ramp(text)) {
            ("hold", _) => Ok(Self(SafeOutput::Hold)),
            ("zero", _) => Ok(Self(SafeOutput::Zero)),
            (_, Some(ticks)) => Ok(Self(SafeOutput::RampToZero { ticks })),
            _ => Err("allowed: hold, ramp=TICKS, zero"),
        }
    }
}

impl fmt::Display for SafeOutputChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            SafeOutput::Hold => f.write_str("hold"),
            SafeOutput::Zero => f.write_str("zero"),
            SafeOutput::RampToZero { ticks } => write!(f, "ramp={ticks}"),
            other => write!(f, "{other:?}"),
        }
    }
}

#[derive(Serialize)]
struct Loss {
    after_ticks: u32,
    /// Outputs after a loss, written like the value of the option.
    output: String,
}

/// Runs `loss-of-link`.
pub(super) fn loss_of_link(loss: &LossOfLinkArguments, link: &LinkArguments) -> Outcome<()> {
    let request = Request::LossOfLink(LossOfLink {
        after_ticks: loss.after_ticks,
        output: loss.output.0,
    });
    Target::open(&link.line)?.order(&request)?;
    let report = Loss {
        after_ticks: loss.after_ticks,
        output: loss.output.to_string(),
    };
    link.print(&report, |out, report| {
        let after = counted(report.after_ticks.into(), "tick");
        writeln!(
            out,
            "the link is lost after {after} without a displacement; outputs after that: {}",
            report.output
        )
    })
}
