//! C source with the bytes of a damper as a constant in flash, and the header that declares it.

use std::fmt::Write;

use dashpot_core::Damper;

use super::{ExportError, Provenance, Word, error, name};
use dashpot_files::Scalar;

/// C source of `const uint8_t NAME[]`, to compile on its own or to include in one file; C99 and C++11.
///
/// The array is what `dashpot_damper_init` of the C library takes.
///
/// # Errors
/// The scalar is not `f32`; `constant` is no name of a constant, or one that headers may define.
pub fn c_source<T: Word>(
    constant: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
) -> Result<String, ExportError> {
    let declaration = declaration(constant, damper, provenance)?;
    Ok(declaration + &array(constant, &T::image(damper)))
}

/// The array of some bytes.
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

/// C header that declares the array of [`c_source`] with its size; C++ too.
///
/// # Errors
/// Those of [`c_source`].
pub fn c_header<T: Word>(
    constant: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
) -> Result<String, ExportError> {
    let declaration = declaration(constant, damper, provenance)?;
    Ok(guarded(constant, &declaration))
}

/// A header of a declaration.
pub(super) fn guarded(constant: &str, declaration: &str) -> String {
    let guard = format!("{}{constant}_H", error::C_LIBRARY_PREFIX);
    format!("#ifndef {guard}\n#define {guard}\n\n{declaration}\n#endif\n")
}

/// Where the damper is from, and its array declared: without a declaration before it a constant of C++
/// would be of its own file only.
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

/// The declaration of an array of `length` bytes, after a comment.
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
