//! `dashpot export --fmi --case`: exports a vehicle with external dampers as an FMU.

use std::path::PathBuf;

use super::ExportArguments;
use super::fmu::{Content, fmu_name, packed, report, write};
use crate::commands::failure::{Failure, Outcome};
use dashpot_core::Damper;
use dashpot_export::fmu::{Fmu, Interface, NamedDamper, Part, Platform, system};
use dashpot_files::case::Case;
use dashpot_rail::vehicle::{Element, Law};
use dashpot_vehicle_run::signals::slug;
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
    let libraries = options
        .targets()?
        .into_iter()
        .map(|target| library(&options.library, target.platform))
        .collect::<Outcome<Vec<_>>>()?;
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
        libraries,
    )?;
    let content = Content::Vehicle {
        case: case.name,
        outside: coupled_case.outside.clone(),
    };
    match options.ssp {
        true => write_system(arguments, &fmu, &coupled_case, content),
        false => write(arguments, &fmu, content),
    }
}

/// Writes the vehicle with an FMU of each external damper, as the vehicle has it.
fn write_system(
    arguments: &ExportArguments,
    vehicle: &Fmu,
    coupled: &CoupledCase,
    content: Content,
) -> Outcome<()> {
    let mut fmus = Vec::new();
    for name in &coupled.outside {
        let is_it = |element: &&Element| element.name == *name;
        let element = coupled.case.vehicle.dampers().find(is_it);
        let Some(Law::Damper { parameters, .. }) = element.map(|element| &element.law) else {
            return Err(Failure::new(format!(
                "{}: no damper {name}",
                coupled.case.name
            )));
        };
        let damper: Damper<f32> = parameters.check()?.build(vehicle.step_s())?;
        let clearance_m = parameters.mount.clearance_m;
        let named = NamedDamper {
            name: name.clone(),
            damper,
            clearance_m,
        };
        let fmu = Fmu::of_dampers(
            vehicle.interface(),
            &slug(name),
            &[named],
            vehicle.step_s(),
            false,
        )?;
        fmus.push(((slug(name), packed(arguments, &fmu)?.1), fmu));
    }
    let (names_and_files, fmus): (Vec<_>, Vec<_>) = fmus.into_iter().unzip();
    let dampers = names_and_files
        .into_iter()
        .zip(&fmus)
        .map(|((name, content), fmu)| Part { name, fmu, content });
    let (platforms, packed) = packed(arguments, vehicle)?;
    let part = Part {
        name: vehicle.identifier().to_owned(),
        fmu: vehicle,
        content: packed,
    };
    let dampers: Vec<Part<'_>> = dampers.collect();
    let bytes = system(vehicle.identifier(), &part, &dampers)
        .map_err(|error| Failure::new(error.to_string()))?;
    report(arguments, vehicle, content, platforms, &bytes)
}

/// Returns the path of a platform's vehicle library: the given one, or for this platform the one next to this program.
fn library(
    given: &[(Option<Platform>, PathBuf)],
    platform: Platform,
) -> Outcome<(Platform, PathBuf)> {
    let is_here = platform == Platform::here();
    let is_it =
        |(of, _): &&(Option<Platform>, PathBuf)| of.as_ref().map_or(is_here, |of| *of == platform);
    let named = given.iter().find(is_it).map(|(_, file)| file.clone());
    if named.is_none() && !is_here {
        return Err(Failure::new(format!(
            "no vehicle library for {platform}; give it with --library {platform}=FILE. `cargo build --release \
             --target TRIPLE -p dashpot-vehicle-model` builds it as target/TRIPLE/release/{LIBRARY}"
        )));
    }
    let beside = || Some(std::env::current_exe().ok()?.parent()?.join(LIBRARY));
    let library = named.or_else(beside).unwrap_or_else(|| LIBRARY.into());
    if library.is_file() {
        return Ok((platform, library));
    }
    Err(Failure::new(format!(
        "{}: vehicle library not found; give it with --library FILE. `cargo build --release -p \
         dashpot-hil -p dashpot-vehicle-model` builds it as target/release/{LIBRARY} in the project folder",
        library.display()
    )))
}
