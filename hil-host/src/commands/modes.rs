//! `dashpot modes`: computes axle loads, natural modes and critical speed of a vehicle.

use std::io::{self, Write};

use super::wheel_rail::WheelRailArguments;
use super::{Format, print_report};
use crate::commands::failure::{Failure, Outcome};
use dashpot_study::modes::{
    CriticalSpeeds, MIN_GROWTH, ModesError, ModesReport, ModesRequest, SPEEDS_KM_H, modes,
};

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

/// Prints axle loads and modes, and the critical speed with `--hunting`.
///
/// # Errors
/// The vehicle, the speed or the friction is invalid.
pub fn run(arguments: &ModesArguments) -> Outcome<()> {
    let request = ModesRequest {
        overrides: arguments.overrides.clone(),
        contact: arguments.contact.options(),
        speed_km_h: arguments.speed_km_h,
        hunting: arguments.hunting,
        sliding: arguments.sliding,
        friction: arguments.friction,
        ..ModesRequest::of(&arguments.vehicle)
    };
    let report = modes(&request).map_err(in_options)?;
    print_report(arguments.format, &report, print)
}

/// The error in terms of the command's options.
fn in_options(error: ModesError) -> Failure {
    match error {
        ModesError::Speed(speed) => {
            let (min, max) = (SPEEDS_KM_H.start(), SPEEDS_KM_H.end());
            Failure::wrong_use(format!(
                "--speed-km-h: {speed}, allowed: {min} to {max} km/h; omit it for standstill"
            ))
        }
        ModesError::Friction(_) => Failure::wrong_use(format!("--{error}")),
        ModesError::Override { assignment, reason } => {
            Failure::wrong_use(format!("--set {assignment}: {reason}"))
        }
        ModesError::Contact(_) | ModesError::NotUniform => Failure::wrong_use(error.to_string()),
        ModesError::File(error) => error.into(),
        error => Failure::new(error.to_string()),
    }
}

fn print(out: &mut dyn Write, report: &ModesReport) -> io::Result<()> {
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
    if let Some(CriticalSpeeds {
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
