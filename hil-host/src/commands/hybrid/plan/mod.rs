//! `dashpot hybrid plan`: what a hybrid test bears and asks for, before it starts.

mod demand;
mod report;

use clap::ValueEnum;
use dashpot_files::actuator::ActuatorParameters;
use dashpot_hybrid::Compensation;
use dashpot_vehicle_run::outside_index;
use demand::Demand;
use report::{Position, Report};

use crate::commands::failure::{Failure, Outcome};
use crate::commands::margin::{LinearVehicle, Margin};
use crate::commands::vehicle::{CaseArguments, Compensate};
use crate::commands::{Format, print_report};

/// Tell which delay each damper position of a vehicle bears, which margin an actuator leaves, and what the case asks of
/// it.
#[derive(Debug, Clone, clap::Args)]
#[command(
    allow_negative_numbers = true,
    after_help = "Examples:
  dashpot hybrid plan --case straight-180 --actuator servo
  dashpot hybrid plan --case curve-r600 --outside \"front yaw damper 1\" --actuator servo --compensate none

The delay that a position bears is exact for the linear vehicle on straight track with rigid rails: the roots of its
characteristic equation with a delayed damper, in small motion and at the largest secant of the damper up to 0.3 m/s,
with the clearance taken up; the smaller delay counts. `any`: stable with every delay. The margin is the delay that the
loop with the actuator bears beyond that of the actuator. The exit code is 1 if a position has no margin of one tick, or
if the case asks for more than the actuator can give."
)]
pub(super) struct PlanArguments {
    #[command(flatten)]
    case: CaseArguments,
    /// Damper that is to be on the rig [default: all]. May be repeated.
    #[arg(long = "outside", value_name = "DAMPER")]
    outside: Vec<String>,
    /// Actuator: built-in name (servo, second-order, slow, benchmark) or TOML file.
    #[arg(long, value_name = "ACTUATOR")]
    actuator: String,
    /// Compensation of the delay of the actuator.
    #[arg(long, value_enum, default_value_t = Compensate::Ats)]
    compensate: Compensate,
    /// Do not run the case: no stroke, velocity, force and bandwidth.
    #[arg(long)]
    no_run: bool,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Runs the command.
///
/// # Errors
/// An argument is invalid, the case cannot run, or a position has no margin.
pub(super) fn run(arguments: &PlanArguments) -> Outcome<()> {
    let case = arguments.case.case()?;
    let actuator = ActuatorParameters::load(&arguments.actuator)?;
    let all: Vec<&str> = case
        .vehicle
        .dampers()
        .map(|element| element.name.as_str())
        .collect();
    let mut dampers = Vec::new();
    for name in &arguments.outside {
        let index = outside_index(&case, name, &dampers);
        dampers.push(
            index.map_err(|error| Failure::wrong_use(format!("--outside \"{name}\": {error}")))?,
        );
    }
    if dampers.is_empty() {
        dampers = (0..all.len()).collect();
    }
    if dampers.is_empty() {
        return Err(Failure::wrong_use(format!(
            "{}: the vehicle has no dampers",
            case.name
        )));
    }
    let vehicle = LinearVehicle::new(&case)?;
    let demands = match arguments.no_run {
        true => vec![None; dampers.len()],
        false => Demand::of_case(&case, &dampers)?
            .into_iter()
            .map(Some)
            .collect(),
    };
    let compensation = Compensation::from(arguments.compensate);
    let positions = dampers.iter().zip(demands).map(|(damper, demand)| {
        let critical = vehicle.critical(*damper);
        let at_critical = match critical {
            Margin::Below { frequency_hz, .. } => {
                Some(vehicle.actuator_at(*damper, &actuator, frequency_hz))
            }
            _ => None,
        };
        Position {
            damper: all[*damper].to_owned(),
            actuator_delay_s: at_critical.map(|(delay_s, _)| delay_s),
            actuator_gain: at_critical.map(|(_, gain)| gain),
            critical,
            uncompensated: vehicle.margin(*damper, &actuator, Compensation::None),
            margin: vehicle.margin(*damper, &actuator, compensation),
            exceeded: demand
                .as_ref()
                .map_or_else(Vec::new, |demand| demand.exceeded(&actuator)),
            demand,
        }
    });
    let positions: Vec<Position> = positions.collect();
    let refused: Vec<String> = positions
        .iter()
        .filter_map(|position| position.refusal(case.step_s))
        .collect();
    let report = Report {
        case: case.name.clone(),
        vehicle: case.vehicle.name.clone(),
        speed_km_h: 3.6 * case.speed_m_per_s,
        actuator: actuator.name.clone(),
        compensation: arguments
            .compensate
            .to_possible_value()
            .map_or_else(String::new, |value| value.get_name().to_owned()),
        positions,
    };
    print_report(arguments.format, &report, report::print)?;
    match &refused[..] {
        [] => Ok(()),
        some => Err(Failure::new(format!("no test: {}", some.join("; ")))),
    }
}
