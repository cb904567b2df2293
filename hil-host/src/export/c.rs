//! C source with the bytes of a damper as a constant in flash.

use std::fmt::Write;

use dashpot_core::Damper;

use super::{Provenance, Word, name};
use crate::failure::{Failure, Outcome};

/// C source of `const uint8_t NAME[]`, to compile on its own or to include in one file; C++ too.
///
/// The array is what `dashpot_damper_init` of the C library takes, and aligned as a word.
///
/// # Errors
/// The scalar is not `f32`; `constant` is no name of a constant, or one the headers included may define.
pub fn c_source<T: Word>(
    constant: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
) -> Outcome<String> {
    name::check_c(constant)?;
    if T::NAME != f32::NAME {
        return Err(Failure::wrong_use(format!(
            "--scalar {}: the C library is of single precision, allowed with --lang c: f32",
            T::NAME
        )));
    }
    let image = T::image(damper);
    let length = image.len();
    let stored = format!("{length} bytes");
    let needs = format!("the C library of dashpot {}", env!("CARGO_PKG_VERSION"));
    let comment = provenance.comment(damper, &stored, &needs);
    let title = provenance.title();
    let mut text = format!(
        "{comment}\n\
         #include <stdint.h>\n\n\
         #ifdef __cplusplus\n\
         #define {constant}_ALIGN alignas(4)\n\
         extern \"C\" {{\n\
         #else\n\
         #define {constant}_ALIGN _Alignas(4)\n\
         #endif\n\n\
         // {title}\n\
         extern const uint8_t {constant}[{length}];\n\n\
         {constant}_ALIGN const uint8_t {constant}[{length}] = {{\n"
    );
    for row in image.chunks(16) {
        let bytes: Vec<String> = row.iter().map(|byte| format!("0x{byte:02x}")).collect();
        // Writing to a String does not fail.
        let _ = writeln!(text, "    {},", bytes.join(", "));
    }
    text.push_str(&format!(
        "}};\n\n#undef {constant}_ALIGN\n#ifdef __cplusplus\n}}\n#endif\n"
    ));
    Ok(text)
}
