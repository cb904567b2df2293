//! `dashpot export --lang`: exports a built damper as source code or bytes.

use dashpot_core::Damper;
use serde::Serialize;

use super::named::{command_line, name_of};
use super::written::Exported;
use super::{ExportArguments, Language};
use crate::commands::failure::{Failure, Outcome};
use crate::commands::print_report_beside;
use dashpot_export::{
    Provenance, Word, c_header, c_source, rust_source, standalone_header, standalone_source,
    standalone_table_bytes,
};
use dashpot_files::Scalar;

#[derive(Serialize)]
struct Report {
    damper: String,
    #[serde(flatten)]
    exported: Exported,
    scalar: Scalar,
    step_s: f64,
    revision: u32,
    /// Size in memory; for standalone C, size of the table.
    damper_bytes: usize,
    state_bytes: usize,
    /// Size of the image; `None` for Rust source, which contains words instead of an image.
    #[serde(skip_serializing_if = "Option::is_none")]
    image_bytes: Option<usize>,
}

/// Builds the damper and writes it.
pub(super) fn run<T: Word>(arguments: &ExportArguments) -> Outcome<()> {
    if arguments.standalone && arguments.lang != Language::C {
        return Err(Failure::wrong_use(format!(
            "--standalone --lang {}: standalone code is available in C only; allowed: --lang c",
            arguments.lang.name()
        )));
    }
    let report = export::<T>(arguments)?;
    print_report_beside(
        &arguments.output,
        arguments.format,
        &report,
        |out, report| {
            report.exported.print(out)?;
            writeln!(
                out,
                ": {} for a step of {} us, {}, revision {:#010x}: {}{} bytes {}, state {} bytes",
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
    let source = |header: Option<&str>| {
        Ok(match arguments.lang {
            Language::Rust => rust_source(constant, &damper, &provenance)?.into_bytes(),
            Language::C if arguments.standalone => {
                standalone_source(constant, &damper, &provenance, header)?.into_bytes()
            }
            Language::C => c_source(constant, &damper, &provenance)?.into_bytes(),
            Language::Bin => T::image(&damper),
        })
    };
    let header = || {
        if arguments.standalone {
            standalone_header(constant, &damper, &provenance)
        } else {
            c_header(constant, &damper, &provenance)
        }
    };
    let exported = Exported::write(arguments, name.clone(), source, header)?;
    let is_image = arguments.lang != Language::Rust && !arguments.standalone;
    Ok(Report {
        damper: arguments.damper.damper.clone(),
        exported,
        scalar: Scalar::of::<T>(),
        step_s,
        revision: damper.revision(),
        damper_bytes: if arguments.standalone {
            standalone_table_bytes(&damper)
        } else {
            size_of::<Damper<T>>()
        },
        state_bytes: size_of::<dashpot_core::DamperState<T>>(),
        image_bytes: is_image.then(|| T::image(&damper).len()),
    })
}
