//! `dashpot shims`: compares the shim packs of a damper in theory, as published and as used.

mod capital;
mod fe;
mod plots;
mod report;

use std::path::PathBuf;

use dashpot_core::characteristic::Characteristic;
use fe::{PlateArguments, PlateReport};
use report::{Report, print};

use super::{DamperArguments, Format, print_report};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::damper;
use dashpot_files::output::write_folder;
use dashpot_testbench::shim_report::{self, valve_reports};
use dashpot_testbench::shim_valves::erratum;

/// Analyse the shim packs of a damper: Cw, equivalent thickness, lift (theory, published, used) and flow.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot shims --damper paper
  dashpot shims --damper in-service --plots shims --format json
  dashpot shims --fe --pressure-pa 1e6,5e6 --allowable-stress-pa 8e8
  dashpot shims --fe --valve piston-extension --bosses 6 --boss-share 0.4 --loaded-radii-m 0.019,0.026
  dashpot shims --fe --valve foot-compression --loaded-radii-m 0.005,0.0104 --decay-radii-m 0.005,0.011")]
pub struct ShimsArguments {
    /// Damper.
    #[command(flatten)]
    pub damper: DamperArguments,
    /// Output folder for plots.
    #[arg(long, default_value = "shims-plots", value_name = "FOLDER")]
    pub plots: PathBuf,
    /// Do not write plots.
    #[arg(long)]
    pub no_plots: bool,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Plate analysis.
    #[command(flatten)]
    pub plates: PlateArguments,
}

/// Prints and draws the shim packs of a damper.
///
/// # Errors
/// The damper is invalid or has no shim packs, or a plot cannot be written.
pub fn run(arguments: &ShimsArguments) -> Outcome<()> {
    let name = &arguments.damper.damper;
    let parameters = arguments.damper.load()?;
    let hydraulics = shim_report::hydraulics(&parameters)
        .map_err(|error| Failure::new(format!("{name}: {error}")))?;
    let characteristic = Characteristic::new(&parameters);
    let paper = damper::load("paper", &[])?;
    let valves = valve_reports(&parameters, &paper)?;
    let solved = if arguments.plates.fe {
        fe::solve(&arguments.plates, &parameters, hydraulics)?
    } else {
        Vec::new()
    };
    let plates = if solved.is_empty() {
        None
    } else {
        Some(PlateReport::new(&arguments.plates, &solved)?)
    };
    let plots = if arguments.no_plots {
        Vec::new()
    } else {
        let mut drawings = plots::draw(hydraulics, &valves, &characteristic)?;
        if !solved.is_empty() {
            drawings.extend(fe::draw(&solved)?);
        }
        write_folder(&arguments.plots, &drawings)?
    };
    let report = Report::new(
        name,
        valves,
        &erratum(shim_report::hydraulics(&paper)?)?,
        plates,
        plots,
    );
    print_report(arguments.format, &report, print)
}
