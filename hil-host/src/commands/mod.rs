//! The commands of `dashpot`, one per file or folder: options, calls into the library, and the report.
//!
//! To add a command, write a file here with its options (a `clap::Args` whose `after_help` has an example) and a `run`
//! function, then add it to [`Command`]. [`arguments`] has options shared by several commands, [`mod@print`] prints a
//! report as text or JSON, and [`failure`] defines messages and exit codes.

pub mod arguments;
pub mod budget;
pub mod calibrate;
pub mod channels;
pub mod contact;
pub mod demonstrate;
pub mod export;
pub mod failure;
mod gap_report;
pub mod health;
mod health_reading;
pub mod hybrid;
pub mod interruption;
pub mod line;
pub mod link;
pub mod live;
pub mod margin;
mod merge;
pub mod modes;
mod named_values;
mod paced;
pub mod pil;
pub mod print;
pub mod progress;
mod raw_name;
mod recorded;
pub mod recording;
pub mod remedy;
pub mod replay;
pub mod response;
pub mod rig;
pub mod sensors;
pub mod sheet;
pub mod shell;
pub mod shims;
pub mod shipped;
pub mod step_size;
mod streams;
pub mod sweep;
pub mod tables;
mod tick_times;
pub mod vehicle;
pub mod vehicle_sensors;
pub mod verify;
mod wheel_rail;
mod xcp;

use arguments::{DamperArguments, Format, RealtimeArguments, TickLimitArguments};
use failure::Outcome;
use print::{counted, nearest_nanosecond, print_answer, print_report, print_report_beside};
use shipped::Kind;

/// A command with its options; the documentation of the arguments is the help text.
#[allow(missing_docs)]
#[derive(Debug, Clone, clap::Subcommand)]
pub enum Command {
    Replay(replay::ReplayArguments),
    Channels(channels::ChannelsArguments),
    Rig(rig::RigArguments),
    Response(response::ResponseArguments),
    Verify(verify::VerifyArguments),
    Shims(shims::ShimsArguments),
    Budget(budget::BudgetArguments),
    Export(export::ExportArguments),
    Sheet(sheet::SheetArguments),
    Calibrate(calibrate::CalibrateArguments),
    Health(Box<health::HealthArguments>),
    VehicleSensors(vehicle_sensors::VehicleSensorsArguments),
    Contact(contact::ContactArguments),
    Modes(modes::ModesArguments),
    Vehicle(vehicle::VehicleArguments),
    Live(live::LiveArguments),
    Hybrid(hybrid::HybridArguments),
    Sweep(sweep::SweepArguments),
    Merge(merge::MergeArguments),
    Tables(tables::TablesArguments),
    Pil(pil::PilArguments),
    Link(link::LinkArguments),
    /// List the dampers that ship.
    Dampers(shipped::ListArguments),
    /// List the vehicles that ship.
    Vehicles(shipped::ListArguments),
    /// List the tracks that ship.
    Tracks(shipped::ListArguments),
    /// List the cases that ship: a vehicle on a track at a speed.
    Cases(shipped::ListArguments),
    /// List the studies that ship: many cases.
    Studies(shipped::ListArguments),
    /// List the actuators of rigs that ship.
    Actuators(shipped::ListArguments),
    /// List the sheets of rig tests that ship.
    Sheets(shipped::ListArguments),
    Show(shipped::ShowArguments),
    Completions(shell::CompletionsArguments),
    Man(shell::ManArguments),
}

impl Command {
    /// Runs the command; `whole` is the command line that it is part of.
    ///
    /// # Errors
    /// Returns the error of the command's own `run`.
    pub fn run(&self, whole: fn() -> clap::Command) -> Outcome<()> {
        match self {
            Self::Replay(arguments) => replay::run(arguments),
            Self::Channels(arguments) => channels::run(arguments),
            Self::Rig(arguments) => rig::run(arguments),
            Self::Response(arguments) => response::run(arguments),
            Self::Verify(arguments) => verify::run(arguments),
            Self::Shims(arguments) => shims::run(arguments),
            Self::Budget(arguments) => budget::run(arguments),
            Self::Export(arguments) => export::run(arguments),
            Self::Sheet(arguments) => sheet::run(arguments),
            Self::Calibrate(arguments) => calibrate::run(arguments),
            Self::Health(arguments) => health::run(arguments),
            Self::VehicleSensors(arguments) => vehicle_sensors::run(arguments),
            Self::Contact(arguments) => contact::run(arguments),
            Self::Modes(arguments) => modes::run(arguments),
            Self::Vehicle(arguments) => vehicle::run(arguments),
            Self::Live(arguments) => live::run(arguments),
            Self::Hybrid(arguments) => hybrid::run(arguments),
            Self::Sweep(arguments) => sweep::run(arguments),
            Self::Merge(arguments) => merge::run(arguments),
            Self::Tables(arguments) => tables::run(arguments),
            Self::Pil(arguments) => pil::run(arguments),
            Self::Link(arguments) => link::run(arguments),
            Self::Dampers(arguments) => shipped::list(Kind::Damper, arguments),
            Self::Vehicles(arguments) => shipped::list(Kind::Vehicle, arguments),
            Self::Tracks(arguments) => shipped::list(Kind::Track, arguments),
            Self::Cases(arguments) => shipped::list(Kind::Case, arguments),
            Self::Studies(arguments) => shipped::list(Kind::Study, arguments),
            Self::Actuators(arguments) => shipped::list(Kind::Actuator, arguments),
            Self::Sheets(arguments) => shipped::list(Kind::Sheet, arguments),
            Self::Show(arguments) => shipped::show(arguments),
            Self::Completions(arguments) => shell::completions(arguments, whole()),
            Self::Man(arguments) => shell::man(arguments, whole()),
        }
    }
}
