//! `dashpot export --fmi --case`: a vehicle as an FMU, some of its dampers outside.

use std::path::PathBuf;

use super::ExportArguments;
use super::fmu::{Content, fmu_name, write};
use crate::commands::failure::{Failure, Outcome};
use dashpot_export::fmu::{Fmu, Interface};
use dashpot_files::case::Case;
use dashpot_files::input;
use dashpot_vehicle_run::{Coupled, CoupledCase, VehicleRunError};

/// Name of the library in the folder of a build.
const LIBRARY: &str = "libdashpot_vehicle_model.a";

/// Builds the vehicle of the case called `name` and writes the FMU.
pub(super) fn run(arguments: &ExportArguments, name: &str, interface: Interface) -> Outcome<()> {
    let options = &arguments.fmu;
    if options.outside.is_empty() {
        return Err(Failure::wrong_use(
            "--case: no damper is outside, allowed: with --outside DAMPER",
        ));
    }
    let library = library(options.library.clone())?;
    let case = Case::load(name)?;
    let refused = |error: VehicleRunError| Failure::new(format!("{}: {error}", case.name));
    let of = CoupledCase::new(&case, &options.outside).map_err(refused)?;
    let contact = of.contact().map_err(refused)?;
    let tables = contact.tables().map_err(refused)?;
    let coupled = Coupled::new(&of, tables).map_err(refused)?;
    let file = contact.tables_file().map_err(refused)?;
    let name_in_fmu = file.file_name().unwrap_or_default().to_string_lossy();
    let content = input::read(&file)?;
    let fmu = Fmu::of_vehicle(
        interface,
        &fmu_name(arguments, name),
        &of,
        &coupled,
        (name_in_fmu.into_owned(), content),
        library,
    )?;
    let content = Content::Vehicle {
        case: case.name,
        outside: of.outside,
    };
    write(arguments, &fmu, content)
}

/// The library of vehicles: the one that is named, else that beside the program.
fn library(named: Option<PathBuf>) -> Outcome<PathBuf> {
    let beside = || Some(std::env::current_exe().ok()?.parent()?.join(LIBRARY));
    let library = named.or_else(beside).unwrap_or_else(|| LIBRARY.into());
    if library.is_file() {
        return Ok(library);
    }
    Err(Failure::new(format!(
        "{}: no library of vehicles there; allowed: --library FILE, which `cargo build --release --package dashpot-vehicle-model` makes as \
         target/release/{LIBRARY} in the folder of the project",
        library.display()
    )))
}
