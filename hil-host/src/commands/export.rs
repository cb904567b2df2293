//! `dashpot export`: the built damper as a constant or as bytes for firmware.

mod health;

use std::path::{Path, PathBuf};

use dashpot_core::Damper;
use serde::Serialize;

use super::sensors::SensorArguments;
use super::step_size::{self, StepSize};
use super::{DamperArguments, Format, print_report_beside};
use crate::commands::failure::{Failure, Outcome};
use crate::files::input::is_standard_stream;
use crate::files::output::{self, is_replaceable, write_bytes, write_together};
use crate::study::Scalar;
use crate::target::export::{
    Provenance, Word, c_header, c_source, rust_source, standalone_header, standalone_source,
    standalone_table_bytes,
};

/// Language of the exported source.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Language {
    /// A Rust source with a `static` of dashpot-core.
    Rust,
    /// A C source with the bytes that the C library takes, and beside it its header (x.c and x.h); C++ too.
    C,
    /// The bytes alone: for a link, a file system or another linker.
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

/// Write the built damper as a constant or as bytes for firmware.
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = "Examples:
  dashpot export --damper reduced-vertical --lang rust --step-us 500 --output vertical.rs
  dashpot export --damper in-service --lang c --output in_service.c
  dashpot export --damper in-service --lang c --standalone --output in_service.c
  dashpot export --damper in-service --lang bin --output in_service.bin
  dashpot export --damper in-service --lang c --health --displacement-noise-m 60e-6 --force-noise-n 60 --output health.c

Then in Rust: mod vertical; ... vertical::REDUCED_VERTICAL.step(&mut state, x)
and in C: #include \"in_service.h\" ... dashpot_damper_init(&damper, IN_SERVICE, sizeof IN_SERVICE)
without a library: #include \"in_service.h\" ... in_service_step(&in_service_as_built, &state, x), see docs/portable-c.md
of its health: HealthModel::from_image(&health::IN_SERVICE_HEALTH), dashpot_health_model_init(&model, IN_SERVICE_HEALTH, \
sizeof IN_SERVICE_HEALTH)")]
pub struct ExportArguments {
    #[command(flatten)]
    damper: DamperArguments,
    /// Language of the source.
    #[arg(long, value_enum)]
    lang: Language,
    /// The step, us.
    #[arg(help = step_size::help("Step the damper is built for", ""), 
        long,
        default_value = "1000",
        value_name = "US",
        allow_negative_numbers = true
    )]
    step_us: StepSize,
    /// Floating-point type.
    #[arg(long, value_enum, default_value_t = Scalar::F32)]
    scalar: Scalar,
    /// Write step and constants in C99 that need no library, for tool chains without Rust; `--lang c` in either scalar.
    #[arg(long, conflicts_with = "health")]
    standalone: bool,
    /// Write what watches the damper's health in place of the damper: the bytes of its model in any language.
    #[arg(long)]
    health: bool,
    #[command(flatten)]
    sensors: SensorArguments,
    /// Name of the constant; the damper's name in capitals when not given, with _HEALTH of its health. Bytes alone have none.
    #[arg(long)]
    name: Option<String>,
    /// File to write, `-` for standard output.
    #[arg(long, value_name = "FILE")]
    output: PathBuf,
    /// How results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Report {
    damper: String,
    /// Of the constant; `None` for bytes alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    output: String,
    /// Beside a C source that is a file.
    #[serde(skip_serializing_if = "Option::is_none")]
    header: Option<String>,
    scalar: Scalar,
    step_s: f64,
    revision: u32,
    /// In memory; of C without a library the table.
    damper_bytes: usize,
    state_bytes: usize,
    /// Bytes of an image; source in Rust holds words.
    #[serde(skip_serializing_if = "Option::is_none")]
    image_bytes: Option<usize>,
}

/// Builds the damper and writes its source.
///
/// # Errors
/// The damper or the name is refused, or the file cannot be written.
pub fn run(arguments: &ExportArguments) -> Outcome<()> {
    if arguments.health {
        return health::run(arguments);
    }
    arguments.sensors.refuse_without("--health")?;
    if arguments.standalone && arguments.lang != Language::C {
        return Err(Failure::wrong_use(format!(
            "--standalone --lang {}: a step without a library is of C, allowed: --lang c",
            arguments.lang.name()
        )));
    }
    let report = match arguments.scalar {
        Scalar::F32 => export::<f32>(arguments),
        Scalar::F64 => export::<f64>(arguments),
    }?;
    print_report_beside(
        &arguments.output,
        arguments.format,
        &report,
        |out, report| {
            if let Some(name) = &report.name {
                write!(out, "{name} in ")?;
            }
            write!(out, "{}", report.output)?;
            if let Some(header) = &report.header {
                write!(out, ", declared in {header}")?;
            }
            writeln!(
                out,
                ": {} for {} us, {}, revision {:#010x}: {}{} bytes {}, a state {} bytes",
                report.damper,
                arguments.step_us,
                report.scalar,
                report.revision,
                report
                    .image_bytes
                    .map_or_else(String::new, |bytes| format!("image {bytes} bytes, ")),
                report.damper_bytes,
                if arguments.standalone {
                    "of constants"
                } else {
                    "in memory"
                },
                report.state_bytes
            )
        },
    )
}

fn export<T: Word>(arguments: &ExportArguments) -> Outcome<Report> {
    let name = name_of(arguments, "")?;
    let step_s = arguments.step_us.step_s();
    let damper: Damper<T> = arguments.damper.load()?.build(step_s)?;
    let constant = name.as_deref().unwrap_or_default();
    let provenance = Provenance {
        damper: &arguments.damper.damper,
        step_us: arguments.step_us.step_us(),
        command: &command_line(arguments, constant),
    };
    let path = &arguments.output;
    let header = (arguments.lang == Language::C && is_replaceable(path))
        .then(|| header_beside(path))
        .transpose()?;
    let bytes = match arguments.lang {
        Language::Rust => rust_source(constant, &damper, &provenance)?.into_bytes(),
        Language::C if arguments.standalone => {
            let included = header.as_deref().and_then(Path::file_name);
            let included = included.map(|name| name.to_string_lossy());
            standalone_source(constant, &damper, &provenance, included.as_deref())?.into_bytes()
        }
        Language::C => c_source(constant, &damper, &provenance)?.into_bytes(),
        Language::Bin => T::image(&damper),
    };
    match &header {
        Some(header) => {
            let text = if arguments.standalone {
                standalone_header(constant, &damper, &provenance)?
            } else {
                c_header(constant, &damper, &provenance)?
            };
            write_together(&[(path, &bytes), (header, text.as_bytes())])?;
        }
        None => write_bytes(path, &bytes)?,
    }
    Ok(Report {
        damper: arguments.damper.damper.clone(),
        name,
        output: output::name(path).display().to_string(),
        header: header.map(|header| header.display().to_string()),
        scalar: Scalar::of::<T>(),
        step_s,
        revision: damper.revision(),
        damper_bytes: if arguments.standalone {
            standalone_table_bytes(&damper)
        } else {
            size_of::<Damper<T>>()
        },
        state_bytes: size_of::<dashpot_core::DamperState<T>>(),
        image_bytes: (arguments.lang != Language::Rust && !arguments.standalone)
            .then(|| T::image(&damper).len()),
    })
}

/// Of the constant, which ends in `end` where it is not given; bytes alone have none.
fn name_of(arguments: &ExportArguments, end: &str) -> Outcome<Option<String>> {
    match (&arguments.name, arguments.lang) {
        (None, Language::Bin) => Ok(None),
        (Some(name), Language::Bin) => Err(Failure::wrong_use(format!(
            "--name {name}: bytes have no name, allowed: --lang rust or c"
        ))),
        (Some(name), _) => Ok(Some(name.clone())),
        (None, _) => Ok(Some(constant_name(&arguments.damper.damper) + end)),
    }
}

/// `folder/x.h` for `folder/x.c`.
fn header_beside(source: &Path) -> Outcome<PathBuf> {
    let header = source.with_extension("h");
    if header == source {
        return Err(Failure::wrong_use(format!(
            "--output {}: the header of the source takes this name, allowed with --lang c: another end, such as .c",
            source.display()
        )));
    }
    Ok(header)
}

/// The command line with every default written out.
fn command_line(arguments: &ExportArguments, name: &str) -> String {
    let mut line = format!("dashpot export --damper '{}'", arguments.damper.damper);
    for assignment in &arguments.damper.overrides {
        line.push_str(&format!(" --set '{assignment}'"));
    }
    let standalone = if arguments.standalone {
        " --standalone"
    } else {
        ""
    };
    line.push_str(&format!(
        " --lang {}{standalone} --step-us {} --scalar {} --name {name} --output '{}'",
        arguments.lang.name(),
        arguments.step_us,
        arguments.scalar,
        arguments.output.display()
    ));
    line
}

/// `data/my-damper.toml` is MY_DAMPER, standard input DAMPER.
fn constant_name(damper: &str) -> String {
    if is_standard_stream(Path::new(damper)) {
        return "DAMPER".into();
    }
    let stem = Path::new(damper)
        .file_stem()
        .map_or_else(|| damper.into(), |stem| stem.to_string_lossy());
    let name: String = stem
        .chars()
        .map(|letter| {
            if letter.is_ascii_alphanumeric() {
                letter.to_ascii_uppercase()
            } else {
                '_'
            }
        })
        .collect();
    if name.starts_with(|first: char| first.is_ascii_uppercase()) {
        name
    } else {
        format!("DAMPER_{name}")
    }
}
