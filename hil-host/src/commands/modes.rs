//! `dashpot modes`: computes axle loads, natural modes and critical speed of a vehicle.

use std::io::{self, Write};

use dashpot_rail::contact::{ContactGeometry, WheelsetContact};
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::vehicle::{
    Element, Law, Mode, Running, Standstill, VehicleError, VehicleParameters,
};
use serde::Serialize;

use super::wheel_rail::WheelRailArguments;
use super::{Format, print_report};
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::case::NORMAL_DAMPING_S_PER_M;
use dashpot_files::contact::{self, ContactOptions, ContactParameters, Wheels};
use dashpot_files::vehicle::{self, VehicleFileError};
use dashpot_vehicle_run::contact::ContactSetup;
use dashpot_vehicle_run::{VehicleRunError, hunting};

/// Compute axle loads and natural modes of a vehicle at standstill or at a speed: frequency, damping and mode shape.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot modes --vehicle locomotive
  dashpot modes --vehicle locomotive --speed-km-h 180
  dashpot modes --vehicle coach --hunting
  dashpot modes --vehicle freight-wagon --sliding
  dashpot modes --vehicle locomotive --set \"front lateral damper.damper='in-service'\" --format json")]
pub struct ModesArguments {
    /// Vehicle: built-in name (`dashpot vehicles` lists them) or TOML file.
    #[arg(long, default_value = "locomotive", value_name = "VEHICLE")]
    pub vehicle: String,
    /// Override a value of the vehicle file: part.key=value, such as body.mass_kg=70e3, or of the contact, such as
    /// contact.residual_friction_ratio=0.5. May be repeated.
    #[arg(long = "set", value_name = "PART.KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Speed on straight track, km/h [default: standstill].
    #[arg(long, value_name = "KM/H")]
    pub speed_km_h: Option<f64>,
    /// Search up to 500 km/h for the linear critical speed, at which a mode becomes unstable, and for the nonlinear
    /// one, above which a push to the flange leads to a limit cycle.
    #[arg(long, conflicts_with = "speed_km_h")]
    pub hunting: bool,
    /// Linear equations in which all friction elements slide: their constant force has no part in a mode. Without it
    /// they stick, as in motion too small to move their sliders. With --hunting, only the linear critical speed is
    /// found.
    #[arg(long)]
    pub sliding: bool,
    /// Friction coefficient between wheel and rail.
    #[arg(long, default_value_t = 0.4, value_name = "MU")]
    pub friction: f64,
    /// Wheels and rails.
    #[command(flatten)]
    pub contact: WheelRailArguments,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

#[derive(Serialize)]
struct Report {
    vehicle: String,
    axle_loads_n: Vec<f64>,
    /// Speed of the modes; `None` at standstill.
    speed_km_h: Option<f64>,
    /// Only with `--hunting`.
    #[serde(skip_serializing_if = "Option::is_none")]
    hunting: Option<HuntingRow>,
    /// `None` if the vehicle has no friction elements.
    #[serde(skip_serializing_if = "Option::is_none")]
    dry_friction: Option<DryFriction>,
    modes: Vec<ModeRow>,
}

/// Friction elements in the linear equations.
#[derive(Serialize)]
struct DryFriction {
    elements: usize,
    linearised_as: &'static str,
}

#[derive(Serialize)]
struct HuntingRow {
    critical_speed_km_h: Option<f64>,
    greatest_speed_km_h: f64,
    /// `None` if a push decays even at the linear critical speed, or at the maximum speed if there is no linear
    /// critical speed. `None` with `--sliding`, which concerns the linear equations only.
    nonlinear_critical_speed_km_h: Option<f64>,
    /// Maximum lateral displacement of a wheelset in the limit cycle at that speed, m.
    limit_cycle_m: Option<f64>,
}

type Contact = WheelsetContact<KalkerBook, ContactGeometry>;

/// Speeds at which modes are computed, km/h.
const SPEEDS_KM_H: std::ops::RangeInclusive<f64> = 1.0..=700.0;

/// Friction coefficients.
const FRICTION: std::ops::RangeInclusive<f64> = 0.0..=2.0;

/// Maximum speed and step of the search for a critical speed, km/h.
const MAX_SEARCH_KM_H: f64 = 500.0;
const SEARCH_STEP_KM_H: f64 = 10.0;

/// A mode is unstable if it grows by more than this part of its frequency. Rounding gives the modes of a vehicle
/// without dampers a small damping of either sign.
const MIN_GROWTH: f64 = 1e-9;

/// Modes above this frequency (Hz) are those of wheel and rail and are not listed.
const MAX_MODE_HZ: f64 = 50.0;

#[derive(Serialize)]
struct ModeRow {
    mode: String,
    undamped_hz: f64,
    damped_hz: f64,
    damping_ratio: f64,
}

impl From<&Mode> for ModeRow {
    fn from(mode: &Mode) -> Self {
        Self {
            mode: mode.description(),
            undamped_hz: mode.undamped_hz(),
            damped_hz: mode.damped_hz(),
            damping_ratio: mode.damping_ratio(),
        }
    }
}

/// Prints axle loads and modes, and the critical speed with `--hunting`.
///
/// # Errors
/// The vehicle, the speed or the friction is invalid.
pub fn run(arguments: &ModesArguments) -> Outcome<()> {
    if let Some(speed) = arguments.speed_km_h
        && !SPEEDS_KM_H.contains(&speed)
    {
        let (min, max) = (SPEEDS_KM_H.start(), SPEEDS_KM_H.end());
        return Err(Failure::wrong_use(format!(
            "--speed-km-h: {speed}, allowed: {min} to {max} km/h; omit it for standstill"
        )));
    }
    let name = &arguments.vehicle;
    let mut options = ContactOptions::default();
    let overrides = contact::apply_overrides(&mut options, &arguments.overrides);
    let overrides = overrides.map_err(|(assignment, reason)| {
        Failure::wrong_use(format!("--set {assignment}: {reason}"))
    })?;
    arguments.contact.add_to(&mut options);
    let (vehicle, wheels) = vehicle::load_with_wheels(name, &[], &overrides)?;
    let refused = |source| VehicleFileError::Vehicle {
        name: name.clone(),
        source,
    };
    let linear = linearised(&vehicle, arguments.sliding);
    let standstill = Standstill::new(&linear).map_err(refused)?;
    let (mut hunting, mut speed_km_h) = (None, arguments.speed_km_h);
    let modes = if arguments.hunting || speed_km_h.is_some() {
        let setup = setup(arguments, &vehicle, wheels, &options)?;
        let contacts = setup.exact().map_err(|error| of_vehicle(name, &error))?;
        let contacts: Vec<&Contact> = contacts.iter().map(AsRef::as_ref).collect();
        if arguments.hunting {
            let critical = critical_speed_km_h(&linear, &contacts).map_err(refused)?;
            speed_km_h = Some(critical.unwrap_or(MAX_SEARCH_KM_H));
            // The step lets friction stick and slide, so its speeds do not belong to those of sliding friction.
            let cycle = if arguments.sliding {
                None
            } else {
                limit_cycle(name, &vehicle, &setup, critical)?
            };
            hunting = Some(HuntingRow {
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
    let report = Report {
        dry_friction: (elements > 0).then_some(DryFriction {
            elements,
            linearised_as: if arguments.sliding {
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
    };
    print_report(arguments.format, &report, print)
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
    arguments: &ModesArguments,
    vehicle: &VehicleParameters,
    wheels: Wheels,
    options: &ContactOptions,
) -> Outcome<ContactSetup> {
    let friction = options.friction.unwrap_or(arguments.friction);
    if !FRICTION.contains(&friction) {
        let (min, max) = (FRICTION.start(), FRICTION.end());
        return Err(Failure::wrong_use(format!(
            "--friction: {friction}, allowed: {min} to {max}"
        )));
    }
    let contact = ContactParameters::new(vehicle, wheels, options, friction)
        .map_err(|error| Failure::wrong_use(error.to_string()))?;
    if !(contact.gauge_over_distance.is_empty() && contact.friction_over_distance.is_empty()) {
        return Err(Failure::wrong_use(
            "contact: values of one rail or along the track, allowed: values of the whole track, because modes are \
             those of a vehicle on uniform track",
        ));
    }
    let setup = ContactSetup::new(vehicle, &contact, friction, NORMAL_DAMPING_S_PER_M);
    setup.map_err(|error| of_vehicle(&arguments.vehicle, &error.into()))
}

/// Reports an invalid vehicle.
fn of_vehicle(name: &str, error: &VehicleRunError) -> Failure {
    Failure::new(format!("{name}: {error}"))
}

/// Finds the lowest speed with a limit cycle, from a tenth of the linear critical speed to slightly above it.
fn limit_cycle(
    name: &str,
    vehicle: &VehicleParameters,
    setup: &ContactSetup,
    critical_km_h: Option<f64>,
) -> Outcome<Option<hunting::Outcome>> {
    let refused = |error: VehicleRunError| of_vehicle(name, &error);
    let contacts = setup.tabulated().map_err(refused)?;
    let max_m_per_s = 1.02 * critical_km_h.unwrap_or(MAX_SEARCH_KM_H) / 3.6;
    let hunting = hunting::Hunting::new(vehicle, contacts).map_err(refused)?;
    hunting
        .critical(0.1 * max_m_per_s..=max_m_per_s)
        .map_err(refused)
}

fn modes_at(
    vehicle: &VehicleParameters,
    contacts: &[&Contact],
    km_h: f64,
) -> Result<Vec<Mode>, VehicleError> {
    Running::with_contacts(vehicle, contacts, km_h / 3.6)?.modes()
}

/// Finds the lowest speed at which a mode is unstable: search in steps, then bisection to 0.01 km/h.
fn critical_speed_km_h(
    vehicle: &VehicleParameters,
    contacts: &[&Contact],
) -> Result<Option<f64>, VehicleError> {
    let grows = |km_h: f64| -> Result<bool, VehicleError> {
        let modes = modes_at(vehicle, contacts, km_h)?;
        Ok(modes.iter().any(|mode| mode.damping_ratio() < -MIN_GROWTH))
    };
    let mut stable = 0.0;
    while stable < MAX_SEARCH_KM_H {
        let mut growing = stable + SEARCH_STEP_KM_H;
        if grows(growing)? {
            while growing - stable > 0.01 {
                let middle = 0.5 * (stable + growing);
                if grows(middle)? {
                    growing = middle;
                } else {
                    stable = middle;
                }
            }
            return Ok(Some(growing));
        }
        stable = growing;
    }
    Ok(None)
}

fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    match (&report.hunting, report.speed_km_h) {
        (None, None) => writeln!(out, "{} at standstill", report.vehicle)?,
        (None, Some(speed)) => writeln!(out, "{} at {speed} km/h", report.vehicle)?,
        (Some(hunting), _) => match hunting.critical_speed_km_h {
            Some(speed) => writeln!(
                out,
                "{}: linear critical speed {speed:.1} km/h; modes at that speed:",
                report.vehicle
            )?,
            None => writeln!(
                out,
                "{}: all modes are stable up to {} km/h; modes at that speed:",
                report.vehicle, hunting.greatest_speed_km_h
            )?,
        },
    }
    if !report.axle_loads_n.is_empty() {
        let loads: Vec<String> = report
            .axle_loads_n
            .iter()
            .map(|load| format!("{:.1}", load / 1e3))
            .collect();
        writeln!(out, "axle loads, kN: {}", loads.join(", "))?;
    }
    if let Some(friction) = &report.dry_friction {
        let state = match friction.linearised_as {
            "sliding" => "slide and add nothing to the modes; without --sliding they stick",
            _ => {
                "stick, as in motion too small to move their sliders; larger motion is softer and damped, and \
                  --sliding shows its modes without friction"
            }
        };
        writeln!(
            out,
            "dry friction: {} elements, which in these linear equations {state}",
            friction.elements
        )?;
    }
    if let Some(HuntingRow {
        nonlinear_critical_speed_km_h: Some(speed),
        limit_cycle_m: Some(amplitude_m),
        ..
    }) = &report.hunting
    {
        writeln!(
            out,
            "nonlinear critical speed {speed:.1} km/h: above it, wheelsets pushed to the flange keep oscillating with \
             an amplitude of at least {:.1} mm",
            1e3 * amplitude_m
        )?;
    }
    writeln!(out)?;
    writeln!(out, "undamped Hz  damped Hz  damping ratio  mode")?;
    for row in &report.modes {
        // Rounding gives undamped modes either sign.
        let is_undamped = row.damping_ratio.abs() < MIN_GROWTH;
        let damping_ratio = if is_undamped { 0.0 } else { row.damping_ratio };
        writeln!(
            out,
            "{:11.3}  {:9.3}  {:13.3}  {}",
            row.undamped_hz, row.damped_hz, damping_ratio, row.mode
        )?;
    }
    Ok(())
}
