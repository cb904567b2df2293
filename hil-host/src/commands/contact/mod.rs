//! `dashpot contact`: computes and plots the contact geometry of wheel and rail.

mod plots;
mod profiles;
mod report;

use std::path::{Path, PathBuf};

use dashpot_rail::contact::{Installation, Pair, RigidContact};
use dashpot_rail::indices::RollingRadiusDifference;
use profiles::{ProfileArguments, Profiles};
use report::{print, report};

use super::{Format, print_report};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::output::write_folder;
use dashpot_study::wheelset_geometry::WheelsetGeometry;

/// Compute the contact geometry of a wheelset on a track: contact points, rolling radius, equivalent conicity.
#[derive(Debug, Clone, clap::Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  dashpot contact
  dashpot contact --wheel worn.whl --rail worn.ban
  dashpot contact --rail worn.csv --gauge-m 1.432 --plots worn-plots --format json"
)]
pub struct ContactArguments {
    /// Wheel and rail.
    #[command(flatten)]
    pub profiles: ProfileArguments,
    /// Track gauge, m.
    #[arg(long, default_value_t = Installation::default().gauge_m)]
    pub gauge_m: f64,
    /// Depth below the top of the rails at which the gauge is measured, m.
    #[arg(long, default_value_t = Installation::default().gauge_depth_m)]
    pub gauge_depth_m: f64,
    /// Distance between the flange backs, m.
    #[arg(long, default_value_t = Installation::default().back_to_back_m)]
    pub back_to_back_m: f64,
    /// Distance from the back of the flange to the tread datum, m.
    #[arg(long, default_value_t = Installation::default().back_to_datum_m)]
    pub back_to_datum_m: f64,
    /// Wheel radius at the tread datum, m.
    #[arg(long, default_value_t = Installation::default().wheel_radius_m)]
    pub wheel_radius_m: f64,
    /// Rail inclination: 0.025 is 1:40.
    #[arg(long, default_value_t = Installation::default().inclination)]
    pub inclination: f64,
    /// Output folder for plots.
    #[arg(long, default_value = "contact-plots", value_name = "FOLDER")]
    pub plots: PathBuf,
    /// Do not write plots.
    #[arg(long)]
    pub no_plots: bool,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

/// Largest lateral shift that is drawn, at which the flange face touches, m.
const LARGEST_SHIFT_DRAWN_M: f64 = 8e-3;
/// Prints and draws the contact geometry of the given profiles.
///
/// # Errors
/// A profile or a distance is not valid, or a plot cannot be written.
pub fn run(arguments: &ContactArguments) -> Outcome<()> {
    let Profiles {
        wheel,
        rail,
        readings,
    } = arguments.profiles.load()?;
    let installation = Installation::default()
        .with_wheel_radius_m(arguments.wheel_radius_m)
        .with_back_to_back_m(arguments.back_to_back_m)
        .with_back_to_datum_m(arguments.back_to_datum_m)
        .with_gauge_m(arguments.gauge_m)
        .with_gauge_depth_m(arguments.gauge_depth_m)
        .with_inclination(arguments.inclination);
    let pair = Pair::new(wheel, &rail, installation)?;
    let geometry = WheelsetGeometry::new(&pair).map_err(|error| Failure::new(error.to_string()))?;
    let plots = if arguments.no_plots {
        Vec::new()
    } else {
        draw(
            &arguments.plots,
            &pair,
            &geometry.contacts,
            &geometry.rolling,
        )?
    };
    let report = report(&pair, readings, &geometry, plots);
    print_report(arguments.format, &report, print)
}

/// Writes the plots into `folder` and returns their paths.
fn draw(
    folder: &Path,
    pair: &Pair,
    contacts: &[RigidContact],
    rolling: &RollingRadiusDifference,
) -> Outcome<Vec<String>> {
    // One line per half millimetre.
    let lines: Vec<RigidContact> = contacts
        .iter()
        .copied()
        .step_by(20)
        .filter(|c| c.lateral_m.abs() < LARGEST_SHIFT_DRAWN_M + 0.1e-3)
        .collect();
    Ok(write_folder(
        folder,
        &[
            ("contact-points.svg", plots::contact_points(pair, &lines)?),
            ("rolling-radius.svg", plots::rolling_radius(pair, contacts)?),
            (
                "conicity.svg",
                plots::conicity(pair, rolling, LARGEST_SHIFT_DRAWN_M)?,
            ),
        ],
    )?)
}
