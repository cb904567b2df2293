//! Rust source with a damper as a constant in flash.

use std::fmt::Write;

use dashpot_core::Damper;

use super::{ExportError, Provenance, Word, name};
use dashpot_files::Scalar;

/// Returns Rust source of `pub static NAME: Damper<T>`, for `include!` or as a module.
///
/// # Errors
/// Returns an error if `constant` is not a constant name: a capital letter, then capitals, digits and `_`.
pub fn rust_source<T: Word>(
    constant: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
) -> Result<String, ExportError> {
    name::check(constant)?;
    let literals = T::literals(damper);
    let scalar = Scalar::of::<T>();
    let stored = format!("{} words, {} bytes", literals.len(), size_of::<Damper<T>>());
    let needs = format!(
        "dashpot-core {} with or without its features",
        env!("CARGO_PKG_VERSION")
    );
    let mut text = format!(
        "{}\n\
         /// {}\n\
         #[rustfmt::skip]\n\
         #[allow(clippy::unreadable_literal)]\n\
         pub static {constant}: dashpot_core::Damper<{scalar}> = dashpot_core::Damper::<{scalar}>::from_words(&[\n",
        provenance.comment(damper, &stored, &needs),
        provenance.title(),
    );
    for row in literals.chunks(8) {
        // Writing to a String does not fail.
        let _ = writeln!(text, "    {},", row.join(", "));
    }
    text.push_str("]);\n");
    Ok(text)
}
