//! C source with a damper's bytes as a constant in flash, and the header that declares it.

use std::fmt::Write;

use dashpot_core::Damper;

use super::{ExportError, Provenance, Word, error, name};
use dashpot_files::Scalar;

/// Returns C source (C99, C++11) of `const uint8_t NAME[]`, either to compile separately or to include in one file.
///
/// The array is the input of `dashpot_damper_init` in the C library.
///
/// # Errors
/// Returns an error if the scalar is not `f32`, or if `constant` is not a valid constant name or reserved by C headers.
pub fn c_source<T: Word>(
    constant: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
) -> Result<String, ExportError> {
    let declaration = declaration(constant, damper, provenance)?;
    Ok(declaration + &array(constant, &T::image(damper)))
}

/// Defines an array of bytes.
pub(super) fn array(constant: &str, bytes: &[u8]) -> String {
    let mut text = format!("\nconst uint8_t {constant}[{}] = {{\n", bytes.len());
    for row in bytes.chunks(16) {
        let bytes: Vec<String> = row.iter().map(|byte| format!("0x{byte:02x}")).collect();
        // Writing to a String does not fail.
        let _ = writeln!(text, "    {},", bytes.join(", "));
    }
    text.push_str("};\n");
    text
}

/// Returns a C and C++ header that declares the array of [`c_source`] with its size.
///
/// # Errors
/// Same errors as [`c_source`].
pub fn c_header<T: Word>(
    constant: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
) -> Result<String, ExportError> {
    let declaration = declaration(constant, damper, provenance)?;
    Ok(guarded(constant, &declaration))
}

/// Wraps a declaration in an include guard.
pub(super) fn guarded(constant: &str, declaration: &str) -> String {
    let guard = format!("{}{constant}_H", error::C_LIBRARY_PREFIX);
    format!("#ifndef {guard}\n#define {guard}\n\n{declaration}\n#endif\n")
}

/// Returns the provenance comment and the array's declaration. C++ needs the declaration before the definition;
/// otherwise, the constant has internal linkage.
fn declaration<T: Word>(
    constant: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
) -> Result<String, ExportError> {
    name::check_c(constant)?;
    if Scalar::of::<T>() != Scalar::F32 {
        return Err(ExportError::Scalar {
            scalar: Scalar::of::<T>(),
        });
    }
    let length = T::image(damper).len();
    let stored = format!("{length} bytes");
    let needs = format!("the C library of dashpot {}", env!("CARGO_PKG_VERSION"));
    let comment = provenance.comment(damper, &stored, &needs);
    Ok(declared(&comment, &provenance.title(), constant, length))
}

/// Returns a comment and the declaration of an array of `length` bytes.
pub(super) fn declared(comment: &str, title: &str, constant: &str, length: usize) -> String {
    format!(
        "{comment}\n\
         #include <stdint.h>\n\n\
         #ifdef __cplusplus\n\
         extern \"C\" {{\n\
         #endif\n\n\
         // {title}\n\
         extern const uint8_t {constant}[{length}];\n\n\
         #ifdef __cplusplus\n\
         }}\n\
         #endif\n",
    )
}
