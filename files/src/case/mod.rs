//! Cases of a vehicle on a track: from a file in TOML, or in the words of a command line.

mod bounds;
mod error;
mod fault;
mod parts;
mod tables;

use dashpot_core::DamperParameters;
use dashpot_rail::vehicle::{Law, RailSupport, VehicleParameters};
pub use error::CaseError;
use error::Origin;
pub use fault::{Fault, FaultOptions};
pub use parts::CaseParts;
use tables::CaseTables;

use crate::overrides::explain;
use crate::shipped::{Found, Shipped};
use crate::track::{self, TrackParameters};
use crate::vehicle::{self, Replacement};

/// Cases that ship with the program: name and file.
pub const CASES: [(&str, &str); 4] = [
    (
        "straight-180",
        include_str!("../../data/cases/straight-180.toml"),
    ),
    (
        "curve-r200",
        include_str!("../../data/cases/curve-r200.toml"),
    ),
    (
        "curve-r300",
        include_str!("../../data/cases/curve-r300.toml"),
    ),
    (
        "curve-r600",
        include_str!("../../data/cases/curve-r600.toml"),
    ),
];

const SHIPPED: Shipped = Shipped {
    what: "case",
    one: "case",
    texts: &CASES,
};

/// Normal damping of a case that gives none, s/m: without any, impacts of the flange are chaotic, and in a curve it never comes to rest.
pub const NORMAL_DAMPING_S_PER_M: f64 = 5.0;

/// A vehicle on a track at a speed.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Case {
    /// Name.
    pub name: String,
    /// The vehicle, its dampers replaced and its values overridden.
    pub vehicle: VehicleParameters,
    /// The track; [`TrackParameters::build`] makes it.
    pub track: TrackParameters,
    /// Speed, m/s.
    pub speed_m_per_s: f64,
    /// Time that is computed, s.
    pub duration_s: f64,
    /// Distance of the vehicle's middle along the track at the start, m.
    pub start_m: f64,
    /// Static friction coefficient of wheel and rail.
    pub friction: f64,
    /// Normal damping of wheel on rail over the normal force, s/m.
    pub normal_damping_s_per_m: f64,
    /// Step, s.
    pub step_s: f64,
    /// By how much all bodies but the first stand to the right at the start, m.
    pub push_m: f64,
    /// What carries the rails; they do not give way where there is none.
    pub rails: Option<RailSupport>,
    /// Changes of dampers on the way, by rising time.
    pub faults: Vec<Fault>,
}

impl Case {
    /// The case called `name`: a shipped one, or the TOML file at that path, `-` being standard input.
    ///
    /// # Errors
    /// As [`CaseOptions::load`] and [`CaseOptions::case`].
    ///
    /// ```
    /// let case = dashpot_files::case::Case::load("curve-r200")?;
    /// assert_eq!(case.speed_m_per_s, 100.0 / 3.6);
    /// assert_eq!(case.vehicle.wheelsets.len(), 6);
    /// # Ok::<(), dashpot_files::case::CaseError>(())
    /// ```
    pub fn load(name: &str) -> Result<Self, CaseError> {
        CaseOptions::load(name)?.case()
    }

    /// The parameters of one of the vehicle's dampers, by its name and number.
    pub fn damper(&self, name: &str) -> Option<&DamperParameters> {
        let mut dampers = self.vehicle.dampers();
        match &dampers.find(|element| element.name == name)?.law {
            Law::Damper { parameters, .. } => Some(parameters),
            _ => None,
        }
    }

    /// Distance of the vehicle's middle along the track at the end, m.
    pub fn end_m(&self) -> f64 {
        self.start_m + self.speed_m_per_s * self.duration_s
    }
}

/// A case in names, as a file or a command line gives it.
///
/// ```
/// use dashpot_files::case::CaseOptions;
/// let mut options = CaseOptions::new("coach", "curve-r600", 120.0);
/// options.duration_s = 5.0;
/// options.dampers.push("lateral=in-service".parse()?);
/// options.overrides.push("body.mass_kg=40e3".into());
/// let case = options.case()?;
/// assert_eq!(case.name, "coach on curve-r600 at 120 km/h");
/// assert_eq!(case.vehicle.bodies[0].mass_kg, 40e3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct CaseOptions {
    /// Name; of vehicle, track and speed when there is none.
    pub name: Option<String>,
    /// A shipped vehicle or a file.
    pub vehicle: String,
    /// A shipped track or a file.
    pub track: String,
    /// Dampers replaced before the overrides are applied.
    pub dampers: Vec<Replacement>,
    /// Overrides `part.key=value` of the vehicle.
    pub overrides: Vec<String>,
    /// Speed, km/h.
    pub speed_km_h: f64,
    /// Time that is computed, s.
    pub duration_s: f64,
    /// Distance of the vehicle's middle along the track at the start, m.
    pub start_m: f64,
    /// Static friction coefficient of wheel and rail.
    pub friction: f64,
    /// Normal damping of wheel on rail over the normal force, s/m.
    pub normal_damping_s_per_m: f64,
    /// Step, us.
    pub step_us: f64,
    /// By how much all bodies but the first stand to the right at the start, m.
    pub push_m: f64,
    /// What carries the rails.
    pub rails: Option<RailSupport>,
    /// Changes of dampers on the way.
    pub faults: Vec<FaultOptions>,
    /// The file that this is from.
    origin: Option<Origin>,
}

impl CaseOptions {
    /// A vehicle on a track at a speed for 10 s from the distance 0 on, friction 0.4, normal damping 5 s/m, a step of 1 ms.
    pub fn new(vehicle: &str, track: &str, speed_km_h: f64) -> Self {
        Self {
            name: None,
            vehicle: vehicle.to_owned(),
            track: track.to_owned(),
            dampers: Vec::new(),
            overrides: Vec::new(),
            speed_km_h,
            duration_s: 10.0,
            start_m: 0.0,
            friction: 0.4,
            normal_damping_s_per_m: NORMAL_DAMPING_S_PER_M,
            step_us: 1000.0,
            push_m: 0.0,
            rails: None,
            faults: Vec::new(),
            origin: None,
        }
    }

    /// The case called `name`: a shipped one, or the TOML file at that path, `-` being standard input. Names of files in it count
    /// from the case file, those within its `set` from the working folder.
    ///
    /// # Errors
    /// Neither case nor readable file; text that is no TOML; unknown or missing keys.
    pub fn load(name: &str) -> Result<Self, CaseError> {
        let found = SHIPPED.find::<CaseError>(name)?;
        Self::parse_in(&found)
    }

    /// The case written in `text`; `name` stands for it in errors.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub fn parse(name: &str, text: &str) -> Result<Self, CaseError> {
        Self::parse_in(&Found {
            name: name.to_owned(),
            text: text.to_owned().into(),
            folder: std::path::PathBuf::new(),
        })
    }

    fn parse_in(found: &Found) -> Result<Self, CaseError> {
        let tables: CaseTables = toml::from_str(&found.text).map_err(|error| CaseError::Text {
            name: found.name.clone(),
            message: explain(&error),
        })?;
        Ok(tables.options(found))
    }

    /// Keys of the numbers of a case.
    pub const NUMBERS: [&str; 7] = [
        "speed_km_h",
        "duration_s",
        "start_m",
        "friction",
        "normal_damping_s_per_m",
        "step_us",
        "push_m",
    ];

    /// Another number for one of [`Self::NUMBERS`]; nothing for any other key.
    pub fn set_number(&mut self, key: &str, value: f64) {
        let number = match key {
            "speed_km_h" => &mut self.speed_km_h,
            "duration_s" => &mut self.duration_s,
            "start_m" => &mut self.start_m,
            "friction" => &mut self.friction,
            "normal_damping_s_per_m" => &mut self.normal_damping_s_per_m,
            "step_us" => &mut self.step_us,
            "push_m" => &mut self.push_m,
            _ => return,
        };
        *number = value;
        if key == "speed_km_h" {
            self.name = None;
        }
        self.forget_line(key);
    }

    /// Another vehicle.
    pub fn set_vehicle(&mut self, name: &str) {
        name.clone_into(&mut self.vehicle);
        self.name = None;
        self.forget_line("vehicle");
    }

    /// Another track.
    pub fn set_track(&mut self, name: &str) {
        name.clone_into(&mut self.track);
        self.name = None;
        self.forget_line("track");
    }

    /// The value of `key` is no longer the file's: what is wrong with it is not told with the file's line.
    fn forget_line(&mut self, key: &str) {
        if let Some(origin) = &mut self.origin {
            origin.lines.remove(key);
        }
    }

    /// The case, its vehicle and its track read and every number checked.
    ///
    /// # Errors
    /// A number out of its bounds, a vehicle or track that there is not or that is wrong, a fault of a damper that there is not; where they are from
    /// a case file, with its line.
    pub fn case(&self) -> Result<Case, CaseError> {
        self.read().map_err(|error| match &self.origin {
            Some(origin) => origin.locate(error),
            None => error,
        })
    }

    fn read(&self) -> Result<Case, CaseError> {
        bounds::check(self)?;
        if let Some(rails) = &self.rails {
            rails.check().map_err(CaseError::Rails)?;
        }
        let vehicle = vehicle::load_with(&self.vehicle, &self.dampers, &self.overrides)?;
        let track = track::load(&self.track)?;
        let faults = fault::read(&self.faults, &vehicle, self.duration_s)?;
        let made_name = || {
            let Self {
                vehicle,
                track,
                speed_km_h,
                ..
            } = self;
            format!("{vehicle} on {track} at {speed_km_h} km/h")
        };
        Ok(Case {
            name: self.name.clone().unwrap_or_else(made_name),
            vehicle,
            track,
            speed_m_per_s: self.speed_km_h / 3.6,
            duration_s: self.duration_s,
            start_m: self.start_m,
            friction: self.friction,
            normal_damping_s_per_m: self.normal_damping_s_per_m,
            step_s: self.step_us / 1e6,
            push_m: self.push_m,
            rails: self.rails,
            faults,
        })
    }
}
