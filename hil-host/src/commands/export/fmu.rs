//! `dashpot export --fmi`: exports a damper, a bank or a vehicle as an FMU.

use std::fmt;
use std::path::PathBuf;

use dashpot_core::Damper;
use serde::Serialize;

use super::ExportArguments;
use crate::commands::failure::{Failure, Outcome};
use crate::commands::print_report_beside;
use dashpot_export::fmu::{
    Binary, CompileError, Fmu, Interface, NamedDamper, Platform, Remedy, Target, archive, compile,
};
use dashpot_export::{Word, constant_name};
use dashpot_files::Scalar;
use dashpot_files::damper;
use dashpot_files::output::{self, write_bytes};
use dashpot_report::rounded::microseconds;

/// Options of an FMU.
#[derive(Debug, Clone, clap::Args)]
pub(super) struct FmuArguments {
    /// Write a co-simulation FMU of this FMI version, with binaries and C sources.
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
    /// Write the vehicle, an FMU of each external damper and their connections as one SSP file.
    #[arg(long, requires = "case")]
    pub(super) ssp: bool,
    /// Vehicle library built by `cargo build --release -p dashpot-hil -p dashpot-vehicle-model`, for this platform or
    /// another one [default for this platform: the one next to this program]. May be repeated.
    #[arg(long, value_name = "FILE|PLATFORM=FILE", value_parser = platform_library)]
    pub(super) library: Vec<(Option<Platform>, PathBuf)>,
    /// Add a binary for another platform: processor and system, and its C compiler with options, such as
    /// x86_64-windows=x86_64-w64-mingw32-gcc. This platform has cc, or the one in the variable CC. May be repeated.
    #[arg(long = "platform", value_name = "PLATFORM=COMPILER", value_parser = target)]
    pub(super) targets: Vec<Target>,
    /// Omit all binaries: needs no C compiler here, and the importer compiles the sources.
    #[arg(long, conflicts_with = "targets")]
    sources_only: bool,
}

fn target(text: &str) -> Result<Target, String> {
    let (platform, compiler) = text.split_once('=').ok_or("allowed: PLATFORM=COMPILER")?;
    let platform = platform
        .parse::<Platform>()
        .map_err(|error| error.to_string())?;
    match compiler.trim() {
        "" => Err("no compiler; allowed: PLATFORM=COMPILER".into()),
        compiler => Ok(Target {
            platform,
            compiler: compiler.to_owned(),
        }),
    }
}

/// Reads a file, or a platform and a file; a file may contain `=`.
fn platform_library(text: &str) -> Result<(Option<Platform>, PathBuf), String> {
    let pair = text
        .split_once('=')
        .map(|(platform, file)| (platform.parse::<Platform>(), file));
    Ok(match pair {
        Some((Ok(platform), file)) => (Some(platform), file.into()),
        _ => (None, text.into()),
    })
}

impl FmuArguments {
    /// Platforms of the binaries: this one, if none is given for it, and the given ones.
    ///
    /// # Errors
    /// A platform is given twice.
    pub(super) fn targets(&self) -> Outcome<Vec<Target>> {
        let mut targets: Vec<Target> = Vec::new();
        for target in &self.targets {
            if targets
                .iter()
                .any(|other| other.platform == target.platform)
            {
                let platform = &target.platform;
                return Err(Failure::wrong_use(format!(
                    "--platform {platform}: given twice; give each once"
                )));
            }
            targets.push(target.clone());
        }
        Ok(Target::with_here(targets))
    }

    /// Returns the requested interface; `None` without `--fmi`.
    ///
    /// # Errors
    /// An option is given that requires `--fmi` or `--case`.
    pub(super) fn interface(&self) -> Outcome<Option<Interface>> {
        let vehicle_options = [
            ("--outside", !self.outside.is_empty()),
            ("--library", !self.library.is_empty()),
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
            ("--platform", !self.targets.is_empty()),
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
    /// Platforms of the binaries.
    platforms: Vec<String>,
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
fn cannot_compile(error: &CompileError, target: &Target) -> Failure {
    let platform = &target.platform;
    let is_here = *platform == Platform::here();
    Failure::new(error.with_remedies(|remedy| match remedy {
        Remedy::OtherCompiler if is_here => "another C compiler in the variable CC".to_owned(),
        Remedy::OtherCompiler => format!("another C compiler with --platform {platform}=COMPILER"),
        Remedy::SourcesOnly => "no library with --sources-only".to_owned(),
        Remedy::Fmi3 => "--fmi 3".to_owned(),
        Remedy::OtherLibrary if is_here => {
            "a library for this platform with --library FILE".to_owned()
        }
        Remedy::OtherLibrary => format!("a library for it with --library {platform}=FILE"),
    }))
}

/// Compiles and writes the FMU, and prints a report.
///
/// # Errors
/// The compiler fails; the file cannot be written.
pub(super) fn write(arguments: &ExportArguments, fmu: &Fmu, content: Content) -> Outcome<()> {
    let (platforms, bytes) = packed(arguments, fmu)?;
    report(arguments, fmu, content, platforms, &bytes)
}

/// Compiles the FMU unless `--sources-only` is given, and returns its platforms and its file.
///
/// # Errors
/// The compiler fails.
pub(super) fn packed(arguments: &ExportArguments, fmu: &Fmu) -> Outcome<(Vec<String>, Vec<u8>)> {
    let targets = match arguments.fmu.sources_only {
        true => Vec::new(),
        false => arguments.fmu.targets()?,
    };
    let binaries = targets
        .iter()
        .map(|target| compile(fmu, target).map_err(|error| cannot_compile(&error, target)));
    let binaries: Vec<Binary> = binaries.collect::<Outcome<_>>()?;
    let bytes = archive(fmu, &binaries).map_err(|error| Failure::new(error.to_string()))?;
    let platforms = binaries.into_iter().map(|binary| binary.platform);
    Ok((platforms.collect(), bytes))
}

/// Writes the file and prints a report.
///
/// # Errors
/// The file cannot be written.
pub(super) fn report(
    arguments: &ExportArguments,
    fmu: &Fmu,
    content: Content,
    platforms: Vec<String>,
    bytes: &[u8],
) -> Outcome<()> {
    let step_us = microseconds(fmu.step_s());
    write_bytes(&arguments.output, bytes)?;
    let report = Report {
        content,
        fmi: fmu.interface().number(),
        name: fmu.identifier(),
        output: output::name(&arguments.output).display().to_string(),
        step_s: fmu.step_s(),
        token: fmu.token(),
        platforms,
        fmu_bytes: bytes.len(),
    };
    print_report_beside(
        &arguments.output,
        arguments.format,
        &report,
        |out, report| {
            let platforms = report.platforms.join(", ");
            let library = match (platforms.is_empty(), fmu.has_sources()) {
                (false, true) => format!("binary for {platforms}, and sources"),
                (false, false) => format!("binary for {platforms}"),
                (true, _) => "sources only".into(),
            };
            writeln!(
                out,
                "{} in {}: FMI {}, {} for {step_us} us, {library}; {} bytes",
                report.name, report.output, report.fmi, report.content, report.fmu_bytes
            )
        },
    )
}
