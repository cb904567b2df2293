//! The transfer system of a hybrid test in C99 without a library: one header and one source.
//!
//! The sources are a second implementation of `dashpot_core::hybrid` with an adaptive compensator. They need no
//! constants, because the settings are given at run time; a test compares every bit with the core. Names start like
//! those of [`standalone`](super::standalone).

mod digest;

use super::standalone::{END_OF_HEADER, INCLUDES, rendered};
use super::{ExportError, name};

const HEADER: &str = include_str!("transfer.h");
const SOURCE: &str = concat!(
    include_str!("../standalone/start.c"),
    include_str!("numbers.c"),
    include_str!("motion.c"),
    include_str!("settings.c"),
    include_str!("guard.c"),
    include_str!("tick.c"),
    include_str!("digest.c"),
    include_str!("../standalone/end.c"),
);

/// Returns the C and C++ header of [`transfer_source`]; `command` reproduces the file.
///
/// # Errors
/// `constant` is not a valid constant name, or is reserved by C headers.
pub fn transfer_header(constant: &str, command: &str) -> Result<String, ExportError> {
    Ok(comment(constant, command)? + &declarations(constant))
}

/// Returns C99 source of a transfer system with an adaptive compensator, tracking, energy, guard and motion filter. The
/// source includes the file `header`, which contains [`transfer_header`]; with `None`, the source itself contains the
/// declarations.
///
/// # Errors
/// Same errors as [`transfer_header`]; also an error if `header` is not valid between quotation marks.
pub fn transfer_source(
    constant: &str,
    command: &str,
    header: Option<&str>,
) -> Result<String, ExportError> {
    let declared = match header {
        Some(header) => format!("#include \"{}\"\n\n", name::checked_include(header)?),
        None => declarations(constant) + "\n",
    };
    Ok(comment(constant, command)? + INCLUDES + &declared + &rendered::<f32>(SOURCE, constant))
}

fn declarations(constant: &str) -> String {
    let digest = digest::digest();
    let defined = format!("\n#define PREFIX_DIGEST 0x{digest:08x}U\n");
    rendered::<f32>(&(HEADER.to_owned() + &defined), constant) + END_OF_HEADER
}

fn comment(constant: &str, command: &str) -> Result<String, ExportError> {
    name::check_c(constant)?;
    let version = env!("CARGO_PKG_VERSION");
    let command: String = command
        .chars()
        .map(|letter| if letter.is_control() { ' ' } else { letter })
        .collect();
    Ok(format!(
        "// Transfer system of a hybrid test: adaptive compensator, tracking, energy, guard and motion filter.\n\
         // Made by dashpot {version} with\n//     {command}\n\
         // Needs a C99 compiler and nothing else; do not edit.\n\n"
    ))
}
