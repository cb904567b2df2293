//! Rust source with a damper as a constant in flash.

use std::fmt::{LowerHex, Write};

use dashpot_core::Damper;

use crate::failure::{Failure, Outcome};

/// A scalar whose dampers are written as words.
pub trait Word: Sized {
    /// The words of a damper, as literals.
    fn literals(damper: &Damper<Self>) -> Vec<String>;
    /// Name of the type.
    const NAME: &'static str;
}

impl Word for f32 {
    const NAME: &'static str = "f32";
    fn literals(damper: &Damper<f32>) -> Vec<String> {
        damper.to_words().map(|word| literal(word, 8)).into()
    }
}

impl Word for f64 {
    const NAME: &'static str = "f64";
    fn literals(damper: &Damper<f64>) -> Vec<String> {
        damper.to_words().map(|word| literal(word, 16)).into()
    }
}

fn literal(word: impl LowerHex, digits: usize) -> String {
    format!("0x{word:0digits$x}")
}

/// How an exported damper was made, written into the file.
pub struct Provenance<'a> {
    /// Preset or file the damper came from.
    pub damper: &'a str,
    /// Step as asked for (us).
    pub step_us: u32,
    /// Command line that makes the file again.
    pub command: &'a str,
}

/// Rust source of `pub static NAME: Damper<T>`, for `include!` or as a module.
///
/// # Errors
/// `name` is no Rust constant's name: capital letter first, then capitals, digits and `_`.
pub fn rust_source<T: Word + dashpot_core::Real>(
    name: &str,
    damper: &Damper<T>,
    provenance: &Provenance<'_>,
) -> Outcome<String> {
    check_name(name)?;
    let literals = T::literals(damper);
    let scalar = T::NAME;
    let step_us = provenance.step_us;
    let mut text = format!(
        "// Damper `{}` for a step of {step_us} us ({:.6} kHz), {scalar}, revision {:#010x}.\n\
         // {} words, {} bytes in flash; a state takes {} bytes.\n\
         // Made by dashpot {} with\n//     {}\n\
         // Needs dashpot-core {} with or without its features; do not edit.\n\n\
         /// Damper `{}`, step {step_us} us.\n\
         #[rustfmt::skip]\n\
         #[allow(clippy::unreadable_literal)]\n\
         pub static {name}: dashpot_core::Damper<{scalar}> = dashpot_core::Damper::<{scalar}>::from_words(&[\n",
        one_line(provenance.damper),
        1e3 / f64::from(step_us),
        damper.revision(),
        literals.len(),
        size_of::<Damper<T>>(),
        size_of::<dashpot_core::DamperState<T>>(),
        env!("CARGO_PKG_VERSION"),
        one_line(provenance.command),
        env!("CARGO_PKG_VERSION"),
        one_line(provenance.damper),
    );
    for row in literals.chunks(8) {
        // Writing to a String does not fail.
        let _ = writeln!(text, "    {},", row.join(", "));
    }
    text.push_str("]);\n");
    Ok(text)
}

/// A file name may hold a line break, which would end the comment.
fn one_line(text: &str) -> String {
    text.chars()
        .map(|letter| if letter.is_control() { ' ' } else { letter })
        .collect()
}

fn check_name(name: &str) -> Outcome<()> {
    let valid = name.starts_with(|first: char| first.is_ascii_uppercase())
        && name
            .chars()
            .all(|letter| letter.is_ascii_uppercase() || letter.is_ascii_digit() || letter == '_');
    if valid {
        Ok(())
    } else {
        Err(Failure::new(format!(
            "--name {name}: no name of a constant, allowed: A to Z first, then A to Z, 0 to 9 and _"
        )))
    }
}
