//! `dashpot shims`: the shim packs of a damper, theory beside published and used.

mod plots;
mod report;

use std::path::PathBuf;

use dashpot_core::characteristic::Characteristic;
use dashpot_core::parameters::Element;
use report::{Report, ValveReport, print, valve_report};

use super::{DamperArguments, Format, print_report};
use crate::commands::failure::{Failure, Outcome};
use crate::files::damper;
use crate::study::shim_valves::{VALVE_LOCATIONS, erratum};

/// Shim packs: Cw over radius, equivalent thickness, lift under pressure by theory, as published and as used, flow.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot shims --damper paper
  dashpot shims --damper in-service --plots shims --format json")]
pub struct ShimsArguments {
    /// The damper.
    #[command(flatten)]
    pub damper: DamperArguments,
    /// Folder the plots are written to.
    #[arg(long, default_value = "shims-plots", value_name = "FOLDER")]
    pub plots: PathBuf,
    /// Write no plots.
    #[arg(long)]
    pub no_plots: bool,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

/// Prints the shim packs of a damper and draws them.
///
/// # Errors
/// A damper that is refused or has no shim packs, or a plot that cannot be written.
pub fn run(arguments: &ShimsArguments) -> Outcome<()> {
    let name = &arguments.damper.damper;
    let parameters = arguments.damper.load()?;
    let Element::Physical(hydraulics) = &parameters.element else {
        return Err(Failure::new(format!(
            "{name}: a reduced damper has no shim packs; allowed: a damper with [valves], such as `paper`"
        )));
    };
    let characteristic = Characteristic::new(&parameters);
    let paper = damper::load("paper", &[])?;
    let Element::Physical(paper) = &paper.element else {
        return Err(Failure::new("the preset `paper` has no valves"));
    };
    let valves: Vec<ValveReport> = VALVE_LOCATIONS
        .iter()
        .map(|location| valve_report(location, hydraulics, paper, &characteristic))
        .collect::<Outcome<_>>()?;
    let plots = if arguments.no_plots {
        Vec::new()
    } else {
        plots::draw(&arguments.plots, hydraulics, &valves, &characteristic)?
    };
    let report = Report::new(name, valves, &erratum(paper)?, plots);
    print_report(arguments.format, &report, print)
}
