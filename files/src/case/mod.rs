//! Cases: a vehicle on a track at a speed, from a TOML file or from separate options.

mod bounds;
mod course;
mod error;
mod event;
mod fault;
mod parts;
mod rails;
mod tables;

pub use course::Course;
use dashpot_core::DamperParameters;
use dashpot_rail::vehicle::{Law, RailSupport, VehicleParameters};
pub use error::CaseError;
use error::Origin;
pub use event::{Change, Event, EventOptions, MAX_SPEED_RATE_M_PER_S2};
pub use fault::{Fault, FaultOptions};
pub use parts::{CaseNumbers, CaseParts};
use tables::CaseTables;

use crate::contact::{self, ContactOptions, ContactParameters};
use crate::overrides::explain;
use crate::shipped::{Found, Shipped};
use crate::track::{self, TrackParameters};
use crate::vehicle::{self, Replacement};

/// Built-in cases: name and text.
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
    kind: "case",
    built_in: "case",
    texts: &CASES,
};

/// Default position of the vehicle's middle at the start, m along the track. Everything on a track begins at 0 or
/// later, so a vehicle of up to 30 m starts on straight and even track.
pub const START_M: f64 = -15.0;

/// Default normal damping, s/m: the middle of the range for steel, 0.12 to 0.48 s/m (Hunt and Crossley, Journal of
/// Applied Mechanics 42, 1975, 440-445, `3/2` times their 0.08 to 0.32 s/m). The rails damp impacts more than the
/// contact.
pub const NORMAL_DAMPING_S_PER_M: f64 = 0.3;

/// A vehicle on a track at a constant speed.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Case {
    /// Name.
    pub name: String,
    /// The vehicle after replacements and overrides.
    pub vehicle: VehicleParameters,
    /// The track; call [`TrackParameters::build`] to generate it.
    pub track: TrackParameters,
    /// Speed, m/s.
    pub speed_m_per_s: f64,
    /// Simulated time, s.
    pub duration_s: f64,
    /// Initial distance of the vehicle's centre along the track, m.
    pub start_m: f64,
    /// Static friction coefficient between wheel and rail, where [`Case::contact`] has no other.
    pub friction: f64,
    /// Profiles, dimensions and friction of wheels and rails.
    pub contact: ContactParameters,
    /// Normal contact damping divided by the normal force, s/m.
    pub normal_damping_s_per_m: f64,
    /// Time step, s.
    pub step_s: f64,
    /// Initial lateral offset of all bodies except the first, m; positive to the right.
    pub push_m: f64,
    /// Support of the rails; `None` for rigid rails.
    pub rails: Option<RailSupport>,
    /// Damper changes during the run, sorted by time.
    pub faults: Vec<Fault>,
    /// Changes of speed, friction and forces during the run, sorted by time.
    pub events: Vec<Event>,
}

impl Case {
    /// Loads the case called `name`: a built-in one, or the TOML file at that path (`-` for standard input).
    ///
    /// # Errors
    /// Same errors as [`CaseOptions::load`] and [`CaseOptions::case`].
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

    /// Returns the parameters of a damper by its name and number, such as `lateral damper 1`.
    pub fn damper(&self, name: &str) -> Option<&DamperParameters> {
        let mut dampers = self.vehicle.dampers();
        match &dampers.find(|element| element.name == name)?.law {
            Law::Damper { parameters, .. } => Some(parameters),
            _ => None,
        }
    }

    /// Final distance of the vehicle's centre along the track, m.
    pub fn end_m(&self) -> f64 {
        self.start_m + self.speeds_m_per_s().integral(self.duration_s)[0]
    }

    /// Speed over time, m/s.
    pub fn speeds_m_per_s(&self) -> Course<1> {
        let mut speeds = Course::new([self.speed_m_per_s]);
        for event in &self.events {
            if let Change::Speed(speed_m_per_s) = event.change {
                speeds.then(event.time_s, event.ramp_s, [speed_m_per_s]);
            }
        }
        speeds
    }
}

/// Unresolved case, with vehicle, track and dampers given by name.
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
    /// Name; `None` derives one from vehicle, track and speed.
    pub name: Option<String>,
    /// Built-in vehicle or file.
    pub vehicle: String,
    /// Built-in track or file.
    pub track: String,
    /// Damper replacements, applied before the overrides.
    pub dampers: Vec<Replacement>,
    /// Overrides of the vehicle, `part.key=value`, of the contact, `contact.key=value`, and of the rails,
    /// `rails.key=value` or `rails=rigid`.
    pub overrides: Vec<String>,
    /// Speed, km/h.
    pub speed_km_h: f64,
    /// Simulated time, s.
    pub duration_s: f64,
    /// Initial distance of the vehicle's centre along the track, m.
    pub start_m: f64,
    /// Static friction coefficient between wheel and rail.
    pub friction: f64,
    /// Wheels, rails and friction; overrides `contact.key=value` are applied on top.
    pub contact: ContactOptions,
    /// Normal contact damping divided by the normal force, s/m.
    pub normal_damping_s_per_m: f64,
    /// Time step, us.
    pub step_us: f64,
    /// Initial lateral offset of all bodies except the first, m; positive to the right.
    pub push_m: f64,
    /// Support of the rails; `None` for rigid rails.
    pub rails: Option<RailSupport>,
    /// Damper changes during the run.
    pub faults: Vec<FaultOptions>,
    /// Changes of speed, friction and forces during the run.
    pub events: Vec<EventOptions>,
    /// Lines of the values in the case file; `None` if the options are not from a file.
    origin: Option<Origin>,
}

impl CaseOptions {
    /// A vehicle on a track at a speed (km/h) with defaults: 10 s from [`START_M`], friction 0.4, flexible rails
    /// ([`RailSupport::BALLASTED`]), [`NORMAL_DAMPING_S_PER_M`], time step 1 ms.
    pub fn new(vehicle: &str, track: &str, speed_km_h: f64) -> Self {
        Self {
            name: None,
            vehicle: vehicle.to_owned(),
            track: track.to_owned(),
            dampers: Vec::new(),
            overrides: Vec::new(),
            speed_km_h,
            duration_s: 10.0,
            start_m: START_M,
            friction: 0.4,
            contact: ContactOptions::default(),
            normal_damping_s_per_m: NORMAL_DAMPING_S_PER_M,
            step_us: 1000.0,
            push_m: 0.0,
            rails: Some(RailSupport::BALLASTED),
            faults: Vec::new(),
            events: Vec::new(),
            origin: None,
        }
    }

    /// Loads the case called `name`: a built-in one, or the TOML file at that path (`-` for standard input).
    ///
    /// File names in it are relative to the case file; file names within its `set` are relative to the working
    /// directory.
    ///
    /// # Errors
    /// Returns an error if there is no such case or readable file, if the text is not TOML, or for unknown or missing
    /// keys.
    pub fn load(name: &str) -> Result<Self, CaseError> {
        let found = SHIPPED.find::<CaseError>(name)?;
        Self::parse_in(&found)
    }

    /// Parses the case in `text`; error messages call it `name`.
    ///
    /// # Errors
    /// Same errors as [`Self::load`].
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
        tables.options(found)
    }

    /// Keys of a case's numbers.
    pub const NUMBERS: [&str; 7] = [
        "speed_km_h",
        "duration_s",
        "start_m",
        "friction",
        "normal_damping_s_per_m",
        "step_us",
        "push_m",
    ];

    /// Sets one of [`Self::NUMBERS`]; ignores any other key.
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
        if key == "friction" {
            self.contact.friction = None;
        }
        if key == "speed_km_h" {
            self.name = None;
        }
        self.forget_line(key);
    }

    /// Replaces the vehicle.
    pub fn set_vehicle(&mut self, name: &str) {
        name.clone_into(&mut self.vehicle);
        self.name = None;
        self.forget_line("vehicle");
    }

    /// Replaces the track.
    pub fn set_track(&mut self, name: &str) {
        name.clone_into(&mut self.track);
        self.name = None;
        self.forget_line("track");
    }

    /// Replaces each value of the contact that `contact` has.
    pub fn replace_contact(&mut self, contact: ContactOptions) {
        for key in contact.given() {
            self.forget_line(&format!("{}.{key}", contact::TABLE));
        }
        self.contact.replace_by(contact);
    }

    /// Forgets the line of `key`, whose value no longer comes from the file.
    fn forget_line(&mut self, key: &str) {
        if let Some(origin) = &mut self.origin {
            origin.lines.remove(key);
        }
    }

    /// Resolves the case: loads vehicle and track and checks all numbers.
    ///
    /// # Errors
    /// Returns an error for a number out of bounds, an unknown or invalid vehicle or track, or a fault of an unknown
    /// damper; with file and line if the value comes from a case file.
    pub fn case(&self) -> Result<Case, CaseError> {
        self.resolve().map_err(|error| match &self.origin {
            Some(origin) => origin.locate(error),
            None => error,
        })
    }

    /// Applies the overrides of contact and rails, so that only those of the vehicle are left.
    fn with_track_applied(&self) -> Result<Self, CaseError> {
        let mut applied = self.clone();
        let overrides = contact::apply_overrides(&mut applied.contact, &self.overrides);
        let overrides =
            overrides.and_then(|left| rails::apply_overrides(&mut applied.rails, &left));
        applied.overrides =
            overrides.map_err(|(assignment, reason)| CaseError::Override { assignment, reason })?;
        if let Some(friction) = applied.contact.friction.take() {
            applied.friction = friction;
        }
        Ok(applied)
    }

    fn resolve(&self) -> Result<Case, CaseError> {
        let Self {
            friction,
            contact,
            overrides,
            rails,
            ..
        } = &self.with_track_applied()?;
        bounds::check(self, *friction)?;
        if let Some(rails) = rails {
            rails.check().map_err(CaseError::Rails)?;
        }
        let (vehicle, wheels) = vehicle::load_with_wheels(&self.vehicle, &self.dampers, overrides)?;
        let contact = ContactParameters::new(&vehicle, wheels, contact, *friction)?;
        let mut track = track::load(&self.track)?;
        track.gauge_changes = contact.gauge_changes();
        track.friction_ratios = contact.friction_ratios(*friction);
        let faults = fault::resolve(&self.faults, &vehicle, self.duration_s)?;
        let events = event::resolve(
            &self.events,
            &vehicle,
            self.speed_km_h / 3.6,
            self.duration_s,
        )?;
        let default_name = || {
            let Self {
                vehicle,
                track,
                speed_km_h,
                ..
            } = self;
            format!("{vehicle} on {track} at {speed_km_h} km/h")
        };
        Ok(Case {
            name: self.name.clone().unwrap_or_else(default_name),
            vehicle,
            track,
            speed_m_per_s: self.speed_km_h / 3.6,
            duration_s: self.duration_s,
            start_m: self.start_m,
            friction: *friction,
            contact,
            normal_damping_s_per_m: self.normal_damping_s_per_m,
            step_s: self.step_us / 1e6,
            push_m: self.push_m,
            rails: *rails,
            faults,
            events,
        })
    }
}
