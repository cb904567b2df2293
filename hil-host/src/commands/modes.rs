//! `dashpot modes`: axle loads and natural modes of a vehicle at standstill.

use std::io::{self, Write};

use dashpot_rail::vehicle::{Mode, Standstill};
use serde::Serialize;

use super::{Format, print_report};
use crate::commands::failure::Outcome;
use crate::files::vehicle::{self, VehicleFileError};

/// Axle loads and natural modes of a vehicle at standstill: frequency, damping, and what moves.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot modes --vehicle locomotive
  dashpot modes --vehicle locomotive --set \"front lateral damper.damper='in-service'\" --format json")]
pub struct ModesArguments {
    /// The vehicle: the name of one that ships (locomotive) or a TOML file.
    #[arg(long, default_value = "locomotive", value_name = "VEHICLE")]
    pub vehicle: String,
    /// Changes a value of the vehicle's file: part.key=value, such as body.mass_kg=70e3; may be given several times.
    #[arg(long = "set", value_name = "PART.KEY=VALUE")]
    pub overrides: Vec<String>,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
}

#[derive(Serialize)]
struct Report {
    vehicle: String,
    axle_loads_n: Vec<f64>,
    modes: Vec<ModeRow>,
}

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
            mode: mode.words(),
            undamped_hz: mode.undamped_hz(),
            damped_hz: mode.damped_hz(),
            damping_ratio: mode.damping_ratio(),
        }
    }
}

/// Prints axle loads and modes.
///
/// # Errors
/// A vehicle that is refused.
pub fn run(arguments: &ModesArguments) -> Outcome<()> {
    let name = &arguments.vehicle;
    let vehicle = vehicle::load(name, &arguments.overrides)?;
    let refused = |source| VehicleFileError::Vehicle {
        name: name.clone(),
        source,
    };
    let standstill = Standstill::new(&vehicle).map_err(refused)?;
    let modes = standstill.modes().map_err(refused)?;
    let report = Report {
        vehicle: vehicle.name,
        axle_loads_n: standstill.axle_loads_n().to_vec(),
        modes: modes.iter().map(ModeRow::from).collect(),
    };
    print_report(arguments.format, &report, print)
}

fn print(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    writeln!(out, "{} at standstill", report.vehicle)?;
    if !report.axle_loads_n.is_empty() {
        let loads: Vec<String> = report
            .axle_loads_n
            .iter()
            .map(|load| format!("{:.1}", load / 1e3))
            .collect();
        writeln!(out, "axle loads, kN: {}", loads.join(", "))?;
    }
    writeln!(out)?;
    writeln!(out, "undamped Hz  damped Hz  damping ratio  mode")?;
    for row in &report.modes {
        writeln!(
            out,
            "{:11.3}  {:9.3}  {:13.3}  {}",
            row.undamped_hz, row.damped_hz, row.damping_ratio, row.mode
        )?;
    }
    Ok(())
}
