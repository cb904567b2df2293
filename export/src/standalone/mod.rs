//! A damper in C99 without a library: step and constants in one header and one source.
//!
//! `damper.h` and `damper.c` are the step; like `core/src/step.rs`, they transcribe docs/numerics.md. `bank.c` adds the
//! step of several dampers for FMUs. `start.c` and `end.c` are around every source: they keep a compiler from fusing
//! and reordering operations. In names that start with `prefix_` or `PREFIX_`, the name of the constant replaces the
//! prefix, so that several dampers link into one program. The constants are separate from the step, so the step works
//! with any damper of the same scalar type.

mod constants;
mod digest;
mod number;

use dashpot_core::Damper;

use super::{ExportError, Provenance, Word, name};
use dashpot_files::Scalar;

/// Includes of every source, before everything else.
pub(super) const INCLUDES: &str = "#include <float.h>\n#include <stdbool.h>\n\n";

const HEADER: &str = include_str!("damper.h");
const SOURCE: &str = concat!(
    include_str!("start.c"),
    include_str!("damper.c"),
    include_str!("end.c")
);
const SOURCE_WITH_BANK: &str = concat!(
    include_str!("start.c"),
    include_str!("damper.c"),
    include_str!("bank.c"),
    include_str!("end.c")
);

/// End of the header, which closes the C++ block and the include guard.
pub(super) const END_OF_HEADER: &str = "\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n";

/// Returns the C and C++ header of [`standalone_source`]: types, functions and the damper as built.
///
/// # Errors
/// Returns an error if `constant` is not a valid constant name or reserved by C headers.
pub fn standalone_header<T: Word>(
    constant: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
) -> Result<String, ExportError> {
    Ok(comment(constant, damper, provenance)? + &declarations(constant, damper))
}

/// Returns C99 source of a damper: step and constants, without a library. The source includes the file `header`, which
/// contains [`standalone_header`]; with `None`, the source itself contains the declarations.
///
/// # Errors
/// Same errors as [`standalone_header`]; also an error if `header` is not valid between quotation marks.
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
        + INCLUDES
        + &declared
        + &rendered::<T>(SOURCE, constant)
        + &constants)
}

/// Header of the step alone; the names in it start with `constant`.
pub(super) fn header_of_step<T: Word>(constant: &str) -> String {
    rendered::<T>(HEADER, constant) + END_OF_HEADER
}

/// Source of the step of one damper and of a bank; the names in it start with `constant`.
pub(super) fn source_with_bank<T: Word>(constant: &str) -> String {
    rendered::<T>(SOURCE_WITH_BANK, constant)
}

/// Constants of a damper; their names start with `name`, and the names of the step start with `prefix`.
pub(super) fn constants_of<T: Word>(prefix: &str, name: &str, damper: &Damper<T>) -> String {
    constants::definitions(prefix, name, damper)
}

/// Size in bytes of a damper's table as C constants.
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
    let comment = provenance.comment(damper, &stored, "a C99 compiler and nothing else");
    Ok(comment + "\n")
}

/// Fills in the scalar type and the constant's prefix in a source text of the step.
pub(super) fn rendered<T: Word>(text: &str, constant: &str) -> String {
    let (float, word, bits, fraction_bits) = match Scalar::of::<T>() {
        Scalar::F32 => ("float", "uint32_t", "32", "23"),
        Scalar::F64 => ("double", "uint64_t", "64", "52"),
    };
    // The name is replaced last, because it may contain any of these words.
    text.replace("SCALAR_TYPE", float)
        .replace("SCALAR_WORD", word)
        .replace("SCALAR_BITS", bits)
        .replace("SCALAR_FRACTION_BITS", fraction_bits)
        .replace("prefix_", &format!("{}_", constant.to_lowercase()))
        .replace("PREFIX_", &format!("{constant}_"))
}
