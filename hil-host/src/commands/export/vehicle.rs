//! `dashpot export --fmi --case`: exports a vehicle with external dampers as an FMU.

use std::path::PathBuf;

use super::ExportArguments;
use super::fmu::{Content, fmu_name, write};
use crate::commands::failure::{Failure, Outcome};
use dashpot_export::fmu::{Fmu, Interface};
use dashpot_files::case::Case;
use dashpot_vehicle_run::{Coupled, CoupledCase, VehicleRunError};

/// File name of the vehicle library.
const LIBRARY: &str = "libdashpot_vehicle_model.a";

/// Builds the vehicle of the case called `name` and writes the FMU.
pub(super) fn run(arguments: &ExportArguments, name: &str, interface: Interface) -> Outcome<()> {
    let options = &arguments.fmu;
    if options.outside.is_empty() {
        return Err(Failure::wrong_use(
            "--case requires at least one --outside DAMPER",
        ));
    }
    let library = library(options.library.clone())?;
    let case = Case::load(name)?;
    let refused = |error: VehicleRunError| Failure::new(format!("{}: {error}", case.name));
    let coupled_case = CoupledCase::new(&case, &options.outside).map_err(refused)?;
    let contact = coupled_case.contact().map_err(refused)?;
    let (mut tables, mut files) = (Vec::new(), Vec::new());
    for pair in contact.pairs() {
        let of_pair = pair.tables().map_err(refused)?;
        let name_in_fmu = pair.tables_file_name().map_err(refused)?;
        files.push((name_in_fmu, of_pair.to_bytes()));
        tables.push(of_pair);
    }
    let coupled = Coupled::new(&coupled_case, &tables).map_err(refused)?;
    let fmu = Fmu::of_vehicle(
        interface,
        &fmu_name(arguments, name),
        &coupled_case,
        &coupled,
        files,
        library,
    )?;
    let content = Content::Vehicle {
        case: case.name,
        outside: coupled_case.outside,
    };
    write(arguments, &fmu, content)
}

/// Returns the path of the vehicle library: the given one, or the one next to this program.
fn library(named: Option<PathBuf>) -> Outcome<PathBuf> {
    let beside = || Some(std::env::current_exe().ok()?.parent()?.join(LIBRARY));
    let library = named.or_else(beside).unwrap_or_else(|| LIBRARY.into());
    if library.is_file() {
        return Ok(library);
    }
    Err(Failure::new(format!(
        "{}: vehicle library not found; give it with --library FILE. `cargo build --release --package \
         dashpot-vehicle-model` builds it as target/release/{LIBRARY} in the project folder",
        library.display()
    )))
}
