//! Options that make a case.

use crate::commands::failure::{Failure, Outcome};
use dashpot_files::case::{CASES, Case, CaseNumbers, CaseParts};
use dashpot_files::track::TRACKS;
use dashpot_files::vehicle::{Replacement, VEHICLES};
use dashpot_vehicle_run::VehicleRunError;

/// The case, by its name or by its parts; a part that is given changes that of the case.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct CaseArguments {
    /// A case.
    #[arg(long, help = format!("Case: the name of one that ships ({}) or a TOML file", names(&CASES)), value_name = "CASE")]
    case: Option<String>,
    /// A vehicle.
    #[arg(long, help = format!("Vehicle: the name of one that ships ({}) or a TOML file", names(&VEHICLES)), value_name = "VEHICLE")]
    vehicle: Option<String>,
    /// A track.
    #[arg(long, help = format!("Track: the name of one that ships ({}) or a TOML file", names(&TRACKS)), value_name = "TRACK")]
    track: Option<String>,
    /// Speed, km/h.
    #[arg(long, value_name = "KM/H")]
    speed_km_h: Option<f64>,
    /// Time that is computed, s.
    #[arg(long, value_name = "S")]
    duration_s: Option<f64>,
    /// Distance along the track at which the vehicle's middle starts, m.
    #[arg(long, value_name = "M")]
    start_m: Option<f64>,
    /// Friction coefficient of wheel and rail.
    #[arg(long, value_name = "MU")]
    friction: Option<f64>,
    /// Damping of wheel on rail along the normal over the load (Hunt and Crossley), s/m.
    #[arg(long, value_name = "S/M")]
    normal_damping_s_per_m: Option<f64>,
    /// Step, us.
    #[arg(long, value_name = "US")]
    step_us: Option<f64>,
    /// By how much bogies and wheelsets stand to the right at the start, m.
    #[arg(long, value_name = "M")]
    push_m: Option<f64>,
    /// Replaces dampers: those along vertical, lateral or longitudinal, or of a name, by a preset or file; may be given several times.
    #[arg(long = "damper", value_name = "WHICH=DAMPER")]
    dampers: Vec<Replacement>,
    /// Changes a value of the vehicle's file: part.key=value, such as body.mass_kg=70e3, or of its dampers: dampers.table.key=value,
    /// such as vertical.mount.clearance_m=2e-3; may be given several times.
    #[arg(long = "set", value_name = "PART.KEY=VALUE")]
    overrides: Vec<String>,
}

fn names(shipped: &[(&str, &str)]) -> String {
    let names: Vec<&str> = shipped.iter().map(|(name, _)| *name).collect();
    names.join(", ")
}

impl CaseArguments {
    /// The case that the options make.
    ///
    /// # Errors
    /// Neither a case nor vehicle, track and speed; what [`CaseOptions::case`](dashpot_files::case::CaseOptions::case) refuses.
    pub(super) fn case(&self) -> Outcome<Case> {
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
        options.dampers.extend(self.dampers.iter().cloned());
        options.overrides.extend(self.overrides.iter().cloned());
        Ok(options.case()?)
    }
}

/// What a case's vehicle or track is refused for.
pub(super) fn refused(case: &Case, error: &VehicleRunError) -> Failure {
    Failure::new(format!("{}: {error}", case.name))
}
