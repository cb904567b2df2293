//! `dashpot export --fmi`: exports a damper, a bank or a vehicle as an FMU.

use std::fmt;
use std::path::PathBuf;

use dashpot_core::Damper;
use serde::Serialize;

use super::ExportArguments;
use super::named::constant_name;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::print_report_beside;
use dashpot_export::Word;
use dashpot_export::fmu::{CompileError, Fmu, Interface, NamedDamper, Remedy, archive, compile};
use dashpot_files::Scalar;
use dashpot_files::damper;
use dashpot_files::output::{self, write_bytes};

/// Options of an FMU.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct FmuArguments {
    /// Write a co-simulation FMU of this FMI version, with a binary for this platform and C sources.
    #[arg(
        long,
        value_name = "2|3",
        value_parser = ["2", "3"],
        conflicts_with_all = ["lang", "standalone", "health"]
    )]
    fmi: Option<String>,
    /// Additional damper of the FMU, preset or TOML file, without overrides; repeat for a bank.
    #[arg(long, value_name = "NAME|FILE")]
    also: Vec<String>,
    /// Store the constants as images in the resources folder of the FMU, where they can be replaced.
    #[arg(long)]
    loadable: bool,
    /// Export a vehicle on its track instead of a damper: built-in case or TOML file.
    #[arg(
        long,
        value_name = "CASE",
        requires = "fmi",
        conflicts_with_all = ["damper", "overrides", "step_us", "scalar", "also", "loadable", "sources_only"]
    )]
    pub(super) case: Option<String>,
    /// Damper of the vehicle, by name and number, whose force becomes an input of the FMU. May be repeated.
    #[arg(long, value_name = "DAMPER")]
    pub(super) outside: Vec<String>,
    /// Vehicle library built by `cargo build --release -p dashpot-vehicle-model` [default: the one next to this
    /// program].
    #[arg(long, value_name = "FILE")]
    pub(super) library: Option<PathBuf>,
    /// Omit the binary for this platform: needs no C compiler here, and the importer compiles the sources.
    #[arg(long)]
    sources_only: bool,
}

impl FmuArguments {
    /// Returns the requested interface; `None` without `--fmi`.
    ///
    /// # Errors
    /// An option is given that requires `--fmi` or `--case`.
    pub(super) fn interface(&self) -> Outcome<Option<Interface>> {
        let vehicle_options = [
            ("--outside", !self.outside.is_empty()),
            ("--library", self.library.is_some()),
        ];
        if self.case.is_none()
            && let Some((option, _)) = vehicle_options.iter().find(|(_, is_given)| *is_given)
        {
            return Err(Failure::wrong_use(format!(
                "{option} applies to the FMU of a vehicle only and requires --case"
            )));
        }
        let others = [
            ("--also", !self.also.is_empty()),
            ("--loadable", self.loadable),
            ("--sources-only", self.sources_only),
            ("--case", self.case.is_some()),
        ];
        match (
            self.fmi.as_deref(),
            others.iter().find(|(_, is_given)| *is_given),
        ) {
            (None, Some((option, _))) => Err(Failure::wrong_use(format!(
                "{option} applies to FMUs only and requires --fmi"
            ))),
            (None, None) => Ok(None),
            (Some("2"), _) => Ok(Some(Interface::Two)),
            (Some(_), _) => Ok(Some(Interface::Three)),
        }
    }
}

/// Content of an FMU.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Content {
    Dampers {
        dampers: Vec<String>,
        scalar: Scalar,
    },
    Vehicle {
        case: String,
        outside: Vec<String>,
    },
}

impl fmt::Display for Content {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Dampers { dampers, scalar } => write!(f, "{}, {scalar}", dampers.join(", ")),
            Self::Vehicle { case, outside } => {
                write!(f, "{case}, external dampers: {}", outside.join(", "))
            }
        }
    }
}

#[derive(Serialize)]
struct Report<'a> {
    #[serde(flatten)]
    content: Content,
    fmi: &'static str,
    name: &'a str,
    output: String,
    step_s: f64,
    token: &'a str,
    /// Platform of the binary; `None` for an FMU with sources only.
    #[serde(skip_serializing_if = "Option::is_none")]
    platform: Option<String>,
    fmu_bytes: usize,
}

/// Builds the dampers and writes the FMU.
pub(super) fn run<T: Word>(arguments: &ExportArguments, interface: Interface) -> Outcome<()> {
    let step_s = arguments.step_us.step_s();
    let first = (arguments.damper.damper.clone(), arguments.damper.load()?);
    let mut dampers = vec![first];
    for name in &arguments.fmu.also {
        dampers.push((name.clone(), damper::load(name, &[])?));
    }
    let named = dampers.into_iter().map(|(name, parameters)| -> Outcome<_> {
        let damper: Damper<T> = parameters.build(step_s)?;
        let clearance_m = parameters.mount.clearance_m;
        Ok(NamedDamper {
            name,
            damper,
            clearance_m,
        })
    });
    let named = named.collect::<Outcome<Vec<_>>>()?;
    let name = fmu_name(arguments, &arguments.damper.damper);
    let is_loaded = arguments.fmu.loadable;
    let fmu = Fmu::of_dampers(interface, &name, &named, step_s, is_loaded)?;
    let content = Content::Dampers {
        dampers: named.into_iter().map(|named| named.name).collect(),
        scalar: Scalar::of::<T>(),
    };
    write(arguments, &fmu, content)
}

/// Returns the name of the FMU: the given one, or one derived from `content`.
pub(super) fn fmu_name(arguments: &ExportArguments, content: &str) -> String {
    match &arguments.name {
        Some(name) => name.clone(),
        None => constant_name(content).to_lowercase(),
    }
}

/// Describes a compile error and its remedies in terms of command-line options.
fn cannot_compile(error: &CompileError) -> Failure {
    let remedies = error.remedies().iter().map(|remedy| match remedy {
        Remedy::OtherCompiler => "another C compiler in the variable CC",
        Remedy::SourcesOnly => "no library for this platform with --sources-only",
        Remedy::Fmi3 => "--fmi 3",
        Remedy::OtherLibrary => "a library for this platform with --library FILE",
    });
    let remedies: Vec<&str> = remedies.collect();
    // A compiler's messages may span several lines.
    let separator = match error {
        CompileError::Failed { .. } => "\n",
        _ => "; ",
    };
    Failure::new(match remedies.is_empty() {
        true => error.to_string(),
        false => format!("{error}{separator}allowed: {}", remedies.join(", or ")),
    })
}

/// Compiles the FMU unless `--sources-only` is given, writes it and prints a report.
///
/// # Errors
/// The compiler fails; the file cannot be written.
pub(super) fn write(arguments: &ExportArguments, fmu: &Fmu, content: Content) -> Outcome<()> {
    // Round to the picosecond to remove the rounding error of the product.
    let step_us = (fmu.step_s() * 1e12).round() / 1e6;
    let binary = match arguments.fmu.sources_only {
        true => None,
        false => Some(compile(fmu).map_err(|error| cannot_compile(&error))?),
    };
    let bytes = archive(fmu, binary.as_ref()).map_err(|error| Failure::new(error.to_string()))?;
    write_bytes(&arguments.output, &bytes)?;
    let report = Report {
        content,
        fmi: fmu.interface().number(),
        name: fmu.identifier(),
        output: output::name(&arguments.output).display().to_string(),
        step_s: fmu.step_s(),
        token: fmu.token(),
        platform: binary.map(|binary| binary.platform),
        fmu_bytes: bytes.len(),
    };
    print_report_beside(
        &arguments.output,
        arguments.format,
        &report,
        |out, report| {
            let library = match (&report.platform, fmu.has_sources()) {
                (Some(platform), true) => format!("binary for {platform} and sources"),
                (Some(platform), false) => format!("binary for {platform}"),
                (None, _) => "sources only".into(),
            };
            writeln!(
                out,
                "{} in {}: FMI {}, {} for {step_us} us, {library}; {} bytes",
                report.name, report.output, report.fmi, report.content, report.fmu_bytes
            )
        },
    )
}
