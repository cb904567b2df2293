//! Axle loads, natural modes and critical speeds of a vehicle, from its linear equations.

mod critical;
mod report;

use dashpot_rail::contact::{ContactGeometry, WheelsetContact};
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::vehicle::{Element, Law, Standstill, VehicleParameters};

use dashpot_files::case::NORMAL_DAMPING_S_PER_M;
use dashpot_files::contact::{self, ContactOptions, ContactParameters, Wheels};
use dashpot_files::vehicle::{self, Replacement, VehicleFileError};
use dashpot_vehicle_run::contact::ContactSetup;
use dashpot_vehicle_run::{VehicleRunError, hunting};

pub use critical::MIN_GROWTH;
use critical::{MAX_SEARCH_KM_H, critical_speed_km_h, modes_at};
pub use report::{CriticalSpeeds, DryFriction, ModeRow, ModesReport};

/// The vehicle, its speed and the modes to compute.
#[derive(Clone, Debug)]
pub struct ModesRequest {
    /// Vehicle: built-in name or file.
    pub vehicle: String,
    /// Dampers in place of those of the vehicle.
    pub replacements: Vec<Replacement>,
    /// Overrides of the vehicle, or of the contact: `part.key=value`.
    pub overrides: Vec<String>,
    /// Wheels and rails, in place of those of the overrides.
    pub contact: ContactOptions,
    /// Speed (km/h); `None` for standstill.
    pub speed_km_h: Option<f64>,
    /// True to search for the critical speeds; the modes are then those at the linear one.
    pub hunting: bool,
    /// True if the friction elements slide, so that they have no part in a mode.
    pub sliding: bool,
    /// Friction coefficient, unless an override gives one.
    pub friction: f64,
}

/// Reasons for not computing modes.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ModesError {
    /// The speed is out of range.
    #[error("speed_km_h: {0}, allowed: {min} to {max} km/h", min = SPEEDS_KM_H.start(), max = SPEEDS_KM_H.end())]
    Speed(f64),
    /// The friction is out of range.
    #[error("friction: {0}, allowed: {min} to {max}", min = FRICTION.start(), max = FRICTION.end())]
    Friction(f64),
    /// An override of the contact is invalid.
    #[error("override {assignment}: {reason}")]
    Override {
        /// The override.
        assignment: String,
        /// The problem.
        reason: String,
    },
    /// Wheels and rails do not fit together.
    #[error("{0}")]
    Contact(String),
    /// The contact is not that of uniform track.
    #[error(
        "contact: values of one rail or along the track, allowed: values of the whole track, because modes are those \
         of a vehicle on uniform track"
    )]
    NotUniform,
    /// The vehicle is invalid.
    #[error(transparent)]
    File(#[from] VehicleFileError),
    /// The vehicle cannot run.
    #[error("{name}: {source}")]
    Run {
        /// Name of the vehicle.
        name: String,
        /// The problem.
        source: VehicleRunError,
    },
}

type Contact = WheelsetContact<KalkerBook, ContactGeometry>;

/// Speeds at which modes are computed, km/h.
pub const SPEEDS_KM_H: std::ops::RangeInclusive<f64> = 1.0..=700.0;

/// Friction coefficients.
const FRICTION: std::ops::RangeInclusive<f64> = 0.0..=2.0;

/// Modes above this frequency (Hz) are those of wheel and rail and are not listed.
const MAX_MODE_HZ: f64 = 50.0;

impl ModesRequest {
    /// The modes of a vehicle at standstill, with the command's default friction of 0.4.
    pub fn of(vehicle: &str) -> Self {
        Self {
            vehicle: vehicle.to_owned(),
            replacements: Vec::new(),
            overrides: Vec::new(),
            contact: ContactOptions::default(),
            speed_km_h: None,
            hunting: false,
            sliding: false,
            friction: 0.4,
        }
    }
}

/// Computes axle loads and modes, and the critical speeds if they are asked for.
///
/// # Errors
/// The vehicle, the contact, the speed or the friction is invalid.
///
/// ```
/// use dashpot_study::modes::{ModesRequest, modes};
/// let found = modes(&ModesRequest::of("locomotive"))?;
/// let bounce = found.modes.iter().find(|mode| mode.mode == "body bounce").unwrap();
/// assert!((bounce.undamped_hz - 1.789).abs() < 1e-3);
/// assert_eq!(found.axle_loads_n.len(), 6);
/// # Ok::<(), dashpot_study::modes::ModesError>(())
/// ```
pub fn modes(request: &ModesRequest) -> Result<ModesReport, ModesError> {
    if let Some(speed) = request.speed_km_h
        && !SPEEDS_KM_H.contains(&speed)
    {
        return Err(ModesError::Speed(speed));
    }
    let name = &request.vehicle;
    let mut options = ContactOptions::default();
    let overrides = contact::apply_overrides(&mut options, &request.overrides);
    let overrides =
        overrides.map_err(|(assignment, reason)| ModesError::Override { assignment, reason })?;
    options.replace_by(request.contact.clone());
    let (vehicle, wheels) = vehicle::load_with_wheels(name, &request.replacements, &overrides)?;
    let refused = |source| VehicleFileError::Vehicle {
        name: name.clone(),
        source,
    };
    let linear = linearised(&vehicle, request.sliding);
    let standstill = Standstill::new(&linear).map_err(refused)?;
    let (mut hunting, mut speed_km_h) = (None, request.speed_km_h);
    let modes = if request.hunting || speed_km_h.is_some() {
        let setup = setup(request, &vehicle, wheels, &options)?;
        let contacts = setup.exact().map_err(|error| of_vehicle(name, error))?;
        let contacts: Vec<&Contact> = contacts.iter().map(AsRef::as_ref).collect();
        if request.hunting {
            let critical = critical_speed_km_h(&linear, &contacts).map_err(refused)?;
            speed_km_h = Some(critical.unwrap_or(MAX_SEARCH_KM_H));
            // The step lets friction stick and slide, so its speeds do not belong to those of sliding friction.
            let cycle = if request.sliding {
                None
            } else {
                limit_cycle(name, &vehicle, &setup, critical)?
            };
            hunting = Some(CriticalSpeeds {
                critical_speed_km_h: critical,
                greatest_speed_km_h: MAX_SEARCH_KM_H,
                nonlinear_critical_speed_km_h: cycle.map(|cycle| 3.6 * cycle.speed_m_per_s),
                limit_cycle_m: cycle.map(|cycle| cycle.amplitude_m),
            });
        }
        let modes =
            modes_at(&linear, &contacts, speed_km_h.unwrap_or_default()).map_err(refused)?;
        modes
            .into_iter()
            .filter(|mode| mode.undamped_hz() < MAX_MODE_HZ)
            .collect()
    } else {
        standstill.modes().map_err(refused)?
    };
    let elements = friction_elements(&vehicle);
    Ok(ModesReport {
        dry_friction: (elements > 0).then_some(DryFriction {
            elements,
            linearised_as: if request.sliding {
                "sliding"
            } else {
                "sticking"
            },
        }),
        vehicle: vehicle.name,
        axle_loads_n: standstill.axle_loads_n().to_vec(),
        speed_km_h,
        hunting,
        modes: modes.iter().map(ModeRow::from).collect(),
    })
}

fn is_friction(element: &Element) -> bool {
    matches!(element.law, Law::Friction { .. })
}

fn friction_elements(vehicle: &VehicleParameters) -> usize {
    let elements = vehicle.elements.iter();
    elements.filter(|element| is_friction(element)).count()
}

/// Returns the vehicle for the linear equations, in which friction elements stick unless they are `sliding`.
fn linearised(vehicle: &VehicleParameters, sliding: bool) -> VehicleParameters {
    let mut linear = vehicle.clone();
    if sliding {
        linear.elements.retain(|element| !is_friction(element));
    }
    linear
}

/// Resolves the contact of the vehicle with the values of the options.
///
/// # Errors
/// An invalid value, or values of one rail or along the track: the linear equations are those of uniform track.
fn setup(
    request: &ModesRequest,
    vehicle: &VehicleParameters,
    wheels: Wheels,
    options: &ContactOptions,
) -> Result<ContactSetup, ModesError> {
    let friction = options.friction.unwrap_or(request.friction);
    if !FRICTION.contains(&friction) {
        return Err(ModesError::Friction(friction));
    }
    let contact = ContactParameters::new(vehicle, wheels, options, friction)
        .map_err(|error| ModesError::Contact(error.to_string()))?;
    if !(contact.gauge_over_distance.is_empty() && contact.friction_over_distance.is_empty()) {
        return Err(ModesError::NotUniform);
    }
    let setup = ContactSetup::new(vehicle, &contact, friction, NORMAL_DAMPING_S_PER_M);
    setup.map_err(|error| of_vehicle(&request.vehicle, error.into()))
}

/// Error in the vehicle `name`.
fn of_vehicle(name: &str, source: VehicleRunError) -> ModesError {
    let name = name.to_owned();
    ModesError::Run { name, source }
}

/// Finds the lowest speed with a limit cycle, from a tenth of the linear critical speed to slightly above it.
fn limit_cycle(
    name: &str,
    vehicle: &VehicleParameters,
    setup: &ContactSetup,
    critical_km_h: Option<f64>,
) -> Result<Option<hunting::Outcome>, ModesError> {
    let refused = |error: VehicleRunError| of_vehicle(name, error);
    let contacts = setup.tabulated().map_err(refused)?;
    let max_m_per_s = 1.02 * critical_km_h.unwrap_or(MAX_SEARCH_KM_H) / 3.6;
    let hunting = hunting::Hunting::new(vehicle, contacts).map_err(refused)?;
    hunting
        .critical(0.1 * max_m_per_s..=max_m_per_s)
        .map_err(refused)
}
