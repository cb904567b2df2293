//! `dashpot contact`: computes and plots the contact geometry of wheel and rail.

mod load;
mod patch_plot;
mod plots;
mod profiles;
mod report;
mod under_load;
mod warnings;

use std::path::{Path, PathBuf};

use dashpot_rail::contact::{Installation, Pair, RigidContact};
use load::{LoadArguments, UnderLoad};
use profiles::{ProfileArguments, Profiles};
use report::{print, report};

use super::{Format, print_report};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::output::write_folder;
use dashpot_rail::profile::Profile;
use dashpot_study::wheelset_geometry::WheelsetGeometry;

/// Compute the contact of a wheelset on a track: contact points, rolling radius, equivalent conicity; with a load also
/// patches, pressures and forces.
#[derive(Debug, Clone, clap::Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  dashpot contact
  dashpot contact --wheel worn.whl --rail worn.ban
  dashpot contact --rail worn.csv --gauge-m 1.432 --plots worn-plots --format json
  dashpot contact --load-kn 100 --friction 0.3
  dashpot contact --wheel worn.whl --rail worn.ban --load-kn 80 --lateral-mm -2,0,2 --yaw-mrad 3
  dashpot contact --wheel right.whl --left-wheel left.whl --load-kn 100"
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
    /// Inclination at which the rails are laid: 0.025 is 1:40; 0 for rail files that contain the inclination.
    #[arg(long, default_value_t = Installation::default().inclination)]
    pub inclination: f64,
    /// Load.
    #[command(flatten)]
    pub load: LoadArguments,
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

/// The left and the right side of a wheelset on its track.
struct Sides {
    left: Pair,
    right: Pair,
    are_equal: bool,
}

impl Sides {
    fn new(profiles: &Profiles, installation: Installation) -> Outcome<Self> {
        let (wheel, rail) = (&profiles.wheel.profile, &profiles.rail.profile);
        let left_wheel = profiles.left_wheel.as_ref().map(|left| &left.profile);
        let left_rail = profiles.left_rail.as_ref().map(|left| &left.profile);
        let pair = |wheel: &Profile, rail| Pair::new(wheel.clone(), rail, installation);
        Ok(Self {
            are_equal: left_wheel.is_none() && left_rail.is_none(),
            right: pair(wheel, rail)?,
            left: pair(left_wheel.unwrap_or(wheel), left_rail.unwrap_or(rail))?,
        })
    }

    fn pairs(&self) -> [&Pair; 2] {
        [&self.left, &self.right]
    }

    /// Names of the profiles.
    fn title(&self) -> String {
        let name = |pair: &Pair| format!("{} on {}", pair.wheel().name(), pair.rail().name());
        if self.are_equal {
            name(&self.right)
        } else {
            format!("left {}, right {}", name(&self.left), name(&self.right))
        }
    }
}

/// Prints and draws the contact of the given profiles.
///
/// # Errors
/// A profile, a distance or the load is not valid, or a plot cannot be written.
pub fn run(arguments: &ContactArguments) -> Outcome<()> {
    let profiles = arguments.profiles.load()?;
    let installation = Installation::default()
        .with_wheel_radius_m(arguments.wheel_radius_m)
        .with_back_to_back_m(arguments.back_to_back_m)
        .with_back_to_datum_m(arguments.back_to_datum_m)
        .with_gauge_m(arguments.gauge_m)
        .with_gauge_depth_m(arguments.gauge_depth_m)
        .with_inclination(arguments.inclination);
    let sides = Sides::new(&profiles, installation)?;
    let geometry = WheelsetGeometry::new(sides.pairs()).map_err(failure)?;
    let under_load = arguments.load.compute(&sides)?;
    let plots = if arguments.no_plots {
        Vec::new()
    } else {
        draw(&arguments.plots, &sides, &geometry, under_load.as_ref())?
    };
    let report = report(&sides, &profiles, &geometry, under_load, plots);
    print_report(arguments.format, &report, print)
}

fn failure(error: impl std::fmt::Display) -> Failure {
    Failure::new(error.to_string())
}

/// Writes the plots into `folder` and returns their paths.
fn draw(
    folder: &Path,
    sides: &Sides,
    geometry: &WheelsetGeometry,
    under_load: Option<&UnderLoad>,
) -> Outcome<Vec<String>> {
    let contacts = &geometry.contacts;
    // One line per half millimetre.
    let lines: Vec<RigidContact> = contacts
        .iter()
        .copied()
        .step_by(20)
        .filter(|c| c.lateral_m.abs() < LARGEST_SHIFT_DRAWN_M + 0.1e-3)
        .collect();
    let title = sides.title();
    let mut files = vec![(
        "contact-points.svg",
        plots::contact_points(&sides.right, &lines, 1)?,
    )];
    if !sides.are_equal {
        files.push((
            "contact-points-left.svg",
            plots::contact_points(&sides.left, &lines, 0)?,
        ));
    }
    files.push((
        "rolling-radius.svg",
        plots::rolling_radius(&title, contacts)?,
    ));
    let elastic = under_load.map(|under_load| &under_load.rolling);
    let radius_m = sides.right.installation().wheel_radius_m;
    files.push((
        "conicity.svg",
        plots::conicity(
            &title,
            &geometry.rolling,
            elastic,
            radius_m,
            LARGEST_SHIFT_DRAWN_M,
        )?,
    ));
    if let Some(under_load) = under_load {
        let patches = patch_plot::patches(&title, sides.pairs(), under_load)?;
        files.push(("patches.svg", patches));
    }
    Ok(write_folder(folder, &files)?)
}
