//! `dashpot export`: exports a built damper for firmware and other tools.

mod damper;
mod fmu;
mod health;
mod named;
mod vehicle;
mod written;

use std::path::PathBuf;

use super::named_values;
use super::sensors::SensorArguments;
use super::step_size::{self, StepSize};
use super::{DamperArguments, Format};
use crate::commands::failure::Outcome;
use dashpot_files::Scalar;

/// Language of the exported source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Language {
    /// Rust source with a `static` of dashpot-core.
    Rust,
    /// C source with bytes for the C library, and its header (x.c and x.h); also valid C++.
    C,
    /// Bytes only, to send over a link, store in a file system or link with another linker.
    Bin,
}

impl Language {
    fn name(self) -> &'static str {
        match self {
            Self::Rust => "rust",
            Self::C => "c",
            Self::Bin => "bin",
        }
    }
}

/// Export a damper for firmware (constant, bytes, plain C) or other tools (FMU), or a vehicle as an FMU.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot export --damper reduced-vertical --lang rust --step-us 500 --output vertical.rs
  dashpot export --damper in-service --lang c --output in_service.c
  dashpot export --damper in-service --lang c --standalone --output in_service.c
  dashpot export --damper in-service --lang bin --output in_service.bin
  dashpot export --damper in-service --fmi 3 --output in_service.fmu
  dashpot export --case straight-180 --outside \"front lateral damper 1\" --fmi 3 --output locomotive.fmu
  dashpot export --damper in-service --lang c --health --displacement-noise-m 60e-6 --force-noise-n 60 \\
      --output health.c

Use in Rust: mod vertical; ... vertical::REDUCED_VERTICAL.step(&mut state, x)
Use in C: #include \"in_service.h\" ... dashpot_damper_init(&damper, IN_SERVICE, sizeof IN_SERVICE)
Standalone C (docs/portable-c.md): #include \"in_service.h\" ... in_service_step(&in_service_as_built, &state, x)
Health model: HealthModel::from_image(&health::IN_SERVICE_HEALTH),
  or dashpot_health_model_init(&model, IN_SERVICE_HEALTH, sizeof IN_SERVICE_HEALTH)")]
pub struct ExportArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Language of the exported source.
    #[arg(
        long,
        value_enum,
        required = false,
        required_unless_present = "fmi",
        default_value_if("fmi", clap::builder::ArgPredicate::IsPresent, "c")
    )]
    lang: Language,
    #[command(flatten)]
    fmu: fmu::FmuArguments,
    /// Step, us.
    #[arg(help = step_size::help("Step the damper is built for", ""), 
        long,
        default_value = "1000",
        value_name = "US",
        allow_negative_numbers = true
    )]
    step_us: StepSize,
    /// Floating-point type.
    #[arg(long, value_parser = named_values::scalar(), default_value_t = Scalar::F32)]
    scalar: Scalar,
    /// Write step and constants as C99 without a library, for toolchains without Rust; needs `--lang c` and
    /// accepts either scalar.
    #[arg(long, conflicts_with = "health")]
    standalone: bool,
    /// Write the damper's health model instead of the damper, in any language.
    #[arg(long)]
    health: bool,
    #[command(flatten)]
    sensors: SensorArguments,
    /// Name of the constant, not for `--lang bin` [default: the damper's name in capitals, with _HEALTH for --health].
    #[arg(long)]
    name: Option<String>,
    /// File to write, `-` for standard output.
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
    /// Output format of the results.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// Builds the damper and writes it.
///
/// # Errors
/// The damper or the name is invalid, or the file cannot be written.
pub fn run(arguments: &ExportArguments) -> Outcome<()> {
    let interface = arguments.fmu.interface()?;
    if arguments.health {
        return health::run(arguments);
    }
    arguments.sensors.refuse_without("--health")?;
    if let (Some(interface), Some(case)) = (interface, &arguments.fmu.case) {
        return vehicle::run(arguments, case, interface);
    }
    match (interface, arguments.scalar) {
        (Some(interface), Scalar::F32) => fmu::run::<f32>(arguments, interface),
        (Some(interface), Scalar::F64) => fmu::run::<f64>(arguments, interface),
        (None, Scalar::F32) => damper::run::<f32>(arguments),
        (None, Scalar::F64) => damper::run::<f64>(arguments),
    }
}
