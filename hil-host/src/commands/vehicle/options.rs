//! Options that define a case.

use crate::commands::failure::{Failure, Outcome};
use crate::commands::wheel_rail::WheelRailArguments;
use dashpot_files::case::{CASES, Case, CaseNumbers, CaseParts};
use dashpot_files::track::TRACKS;
use dashpot_files::vehicle::{Replacement, VEHICLES};
use dashpot_live::Choice;
use dashpot_vehicle_run::VehicleRunError;

/// The case, by name or by its parts; a given part overrides that of the case.
#[derive(Debug, Clone, clap::Args)]
pub(in crate::commands) struct CaseArguments {
    /// Case.
    #[arg(
        long,
        help = format!("Case: built-in name ({}) or TOML file", names(&CASES)),
        value_name = "CASE"
    )]
    case: Option<String>,
    /// Vehicle.
    #[arg(
        long,
        help = format!("Vehicle: built-in name ({}) or TOML file", names(&VEHICLES)),
        value_name = "VEHICLE"
    )]
    vehicle: Option<String>,
    /// Track.
    #[arg(
        long,
        help = format!("Track: built-in name ({}) or TOML file", names(&TRACKS)),
        value_name = "TRACK"
    )]
    track: Option<String>,
    /// Speed, km/h.
    #[arg(long, value_name = "KM/H")]
    speed_km_h: Option<f64>,
    /// Simulated time, s.
    #[arg(long, value_name = "S")]
    duration_s: Option<f64>,
    /// Initial position of the vehicle's centre along the track, m.
    #[arg(long, value_name = "M")]
    start_m: Option<f64>,
    /// Friction coefficient between wheel and rail.
    #[arg(long, value_name = "MU")]
    friction: Option<f64>,
    #[command(flatten)]
    contact: WheelRailArguments,
    /// Normal contact damping per load (Hunt and Crossley), s/m.
    #[arg(long, value_name = "S/M")]
    normal_damping_s_per_m: Option<f64>,
    /// Step, us.
    #[arg(long, value_name = "US")]
    step_us: Option<f64>,
    /// Initial lateral offset of bogies and wheelsets to the right, m.
    #[arg(long, value_name = "M")]
    push_m: Option<f64>,
    /// Replace dampers by a preset or file: all vertical, lateral or longitudinal ones, or those of one name. May be
    /// repeated.
    #[arg(long = "damper", value_name = "WHICH=DAMPER")]
    dampers: Vec<Replacement>,
    /// Override a value of the vehicle file: part.key=value, such as body.mass_kg=70e3, or a value of its dampers:
    /// dampers.table.key=value, such as vertical.mount.clearance_m=2e-3, or a value of the case's contact:
    /// contact.key=value, such as contact.right_friction=0.2. May be repeated.
    #[arg(long = "set", value_name = "PART.KEY=VALUE")]
    overrides: Vec<String>,
}

fn names(shipped: &[(&str, &str)]) -> String {
    let names: Vec<&str> = shipped.iter().map(|(name, _)| *name).collect();
    names.join(", ")
}

impl CaseArguments {
    /// Returns the simulated time (s), if it is given.
    pub(in crate::commands) fn duration_s(&self) -> Option<f64> {
        self.duration_s
    }

    /// Builds the case from the options.
    ///
    /// # Errors
    /// Neither a case nor a track with a speed is given, or
    /// [`CaseOptions::case`](dashpot_files::case::CaseOptions::case) fails.
    pub(in crate::commands) fn case(&self) -> Outcome<Case> {
        let parts = CaseParts {
            case: self.case.as_deref(),
            vehicle: self.vehicle.as_deref(),
            track: self.track.as_deref(),
            numbers: CaseNumbers {
                speed_km_h: self.speed_km_h,
                duration_s: self.duration_s,
                start_m: self.start_m,
                friction: self.friction,
                normal_damping_s_per_m: self.normal_damping_s_per_m,
                step_us: self.step_us,
                push_m: self.push_m,
            },
        };
        let Some(mut options) = parts.options()? else {
            return Err(Failure::wrong_use(format!(
                "no case: give --case ({}), or --track with --speed-km-h",
                names(&CASES)
            )));
        };
        options.replace_contact(self.contact.options());
        options.dampers.extend(self.dampers.iter().cloned());
        options.overrides.extend(self.overrides.iter().cloned());
        Ok(options.case()?)
    }

    /// The case as a choice of shipped files, for a page in which it runs by itself.
    ///
    /// # Errors
    /// Another option of the case is given.
    pub(in crate::commands) fn choice(&self) -> Outcome<Choice> {
        let others = [
            ("--duration-s", self.duration_s.is_some()),
            ("--start-m", self.start_m.is_some()),
            (
                "--normal-damping-s-per-m",
                self.normal_damping_s_per_m.is_some(),
            ),
            ("--step-us", self.step_us.is_some()),
            ("--push-m", self.push_m.is_some()),
            ("--damper", !self.dampers.is_empty()),
            (
                "options of wheel and rail",
                self.contact != WheelRailArguments::default(),
            ),
        ];
        if let Some((option, _)) = others.iter().find(|(_, is_given)| *is_given) {
            return Err(Failure::wrong_use(format!(
                "{option} with --page; allowed: --case, --vehicle, --track, --speed-km-h, --friction and --set"
            )));
        }
        Ok(Choice {
            case: self.case.clone().unwrap_or_else(|| CASES[0].0.to_owned()),
            vehicle: self.vehicle.clone(),
            track: self.track.clone(),
            speed_km_h: self.speed_km_h,
            friction: self.friction,
            seed: None,
            set: self.overrides.clone(),
        })
    }
}

/// Reports an invalid vehicle or track of a case.
pub(in crate::commands) fn refused(case: &Case, error: &VehicleRunError) -> Failure {
    Failure::new(format!("{}: {error}", case.name))
}
