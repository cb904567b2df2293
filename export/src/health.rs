//! A health model as a Rust or C constant: the bytes of its image, which firmware and the C library check.

use std::fmt::Write;

use dashpot_core::health::HealthModel;

use super::c::{array, declared, guarded};
use super::{ExportError, Provenance, name};

/// Returns C source (C99, C++11) of `const uint8_t NAME[]`, the input of `dashpot_health_model_init` in the C library.
///
/// # Errors
/// Returns an error if `constant` is not a valid constant name or reserved by C headers.
pub fn health_c_source(
    constant: &str,
    model: &HealthModel,
    provenance: &Provenance<'_>,
) -> Result<String, ExportError> {
    Ok(declaration(constant, provenance)? + &array(constant, &model.to_image()))
}

/// Returns a C and C++ header that declares the array of [`health_c_source`] with its size.
///
/// # Errors
/// Same errors as [`health_c_source`].
pub fn health_c_header(constant: &str, provenance: &Provenance<'_>) -> Result<String, ExportError> {
    Ok(guarded(constant, &declaration(constant, provenance)?))
}

fn declaration(constant: &str, provenance: &Provenance<'_>) -> Result<String, ExportError> {
    name::check_c(constant)?;
    let comment = provenance.health_comment("the C library of dashpot");
    let title = provenance.health_title();
    Ok(declared(
        &comment,
        &title,
        constant,
        HealthModel::IMAGE_BYTES,
    ))
}

/// Returns Rust source of `pub static NAME: [u8; ...]`, the input of `HealthModel::from_image`, for `include!` or as a
/// module.
///
/// # Errors
/// Returns an error if `constant` is not a constant name: a capital letter, then capitals, digits and `_`.
pub fn health_rust_source(
    constant: &str,
    model: &HealthModel,
    provenance: &Provenance<'_>,
) -> Result<String, ExportError> {
    name::check(constant)?;
    let mut text = format!(
        "{}\n\
         /// {}\n\
         #[rustfmt::skip]\n\
         pub static {constant}: [u8; {}] = [\n",
        provenance.health_comment("dashpot-core"),
        provenance.health_title(),
        HealthModel::IMAGE_BYTES,
    );
    for row in model.to_image().chunks(16) {
        let bytes: Vec<String> = row.iter().map(|byte| format!("0x{byte:02x}")).collect();
        // Writing to a String does not fail.
        let _ = writeln!(text, "    {},", bytes.join(", "));
    }
    text.push_str("];\n");
    Ok(text)
}
