//! A damper in C99 without a library: step and constants as one header and one source.
//!
//! `damper.h` and `damper.c` are the step, the transcription of docs/numerics.md beside `core/src/step.rs`. Their
//! names begin with `prefix_` and `PREFIX_`, which become the constant's, so that several dampers link into one
//! program. The step reads any damper of its scalar: constants stand apart from it.

mod constants;
mod digest;
mod number;

use dashpot_core::Damper;

use super::{ExportError, Provenance, Word, name};
use dashpot_files::Scalar;

const HEADER: &str = include_str!("damper.h");
const SOURCE: &str = include_str!("damper.c");

/// End of the header, which has begun a block of C++ and a guard.
const END_OF_HEADER: &str = "\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n";

/// C header of [`standalone_source`]: types, functions and the damper as built; C++ too.
///
/// # Errors
/// `constant` is no name of a constant, or one that headers may define.
pub fn standalone_header<T: Word>(
    constant: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
) -> Result<String, ExportError> {
    Ok(comment(constant, damper, provenance)? + &declarations(constant, damper))
}

/// C source of a damper: its step and its constants, C99 without a library. `header` is the name of the file of
/// [`standalone_header`], which it includes; without one the declarations stand in the source.
///
/// # Errors
/// Those of [`standalone_header`]; `header` cannot stand between quotation marks.
pub fn standalone_source<T: Word>(
    constant: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
    header: Option<&str>,
) -> Result<String, ExportError> {
    let declared = match header {
        Some(header) => format!("#include \"{}\"\n\n", name::checked_include(header)?),
        None => declarations(constant, damper) + "\n",
    };
    let name = constant.to_lowercase();
    let constants = constants::definitions(&name, &name, damper);
    Ok(comment(constant, damper, provenance)?
        + &declared
        + &rendered::<T>(SOURCE, constant)
        + &constants)
}

/// The header of the step alone, names beginning with `constant`.
pub(super) fn header_of_step<T: Word>(constant: &str) -> String {
    rendered::<T>(HEADER, constant) + END_OF_HEADER
}

/// The step alone.
pub(super) fn source_of_step<T: Word>(constant: &str) -> String {
    rendered::<T>(SOURCE, constant)
}

/// The constants of a damper, called `name`, for the step whose names begin with `prefix`.
pub(super) fn constants_of<T: Word>(prefix: &str, name: &str, damper: &Damper<T>) -> String {
    constants::definitions(prefix, name, damper)
}

/// Bytes of a damper's table as constants of C.
pub fn standalone_table_bytes<T: Word>(damper: &Damper<T>) -> usize {
    constants::bytes(damper)
}

fn declarations<T: Word>(constant: &str, damper: &Damper<T>) -> String {
    let constants = constants::declarations(constant, damper);
    rendered::<T>(HEADER, constant) + &constants + END_OF_HEADER
}

fn comment<T: Word>(
    constant: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
) -> Result<String, ExportError> {
    name::check_c(constant)?;
    let stored = format!("{} bytes of constants", standalone_table_bytes(damper));
    let comment = provenance.comment(damper, &stored, "a compiler of C99 and nothing else");
    Ok(comment + "\n")
}

/// A text of the step for a scalar, its names beginning with the constant's.
fn rendered<T: Word>(text: &str, constant: &str) -> String {
    let (float, word, bits) = match Scalar::of::<T>() {
        Scalar::F32 => ("float", "uint32_t", "32"),
        Scalar::F64 => ("double", "uint64_t", "64"),
    };
    // The name comes last: it may have any of these words in it.
    text.replace("SCALAR_TYPE", float)
        .replace("SCALAR_WORD", word)
        .replace("SCALAR_BITS", bits)
        .replace("prefix_", &format!("{}_", constant.to_lowercase()))
        .replace("PREFIX_", &format!("{constant}_"))
}
