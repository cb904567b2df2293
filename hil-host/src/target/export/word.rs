//! What an exported damper consists of, for either scalar.

use std::fmt::LowerHex;

use dashpot_core::Damper;

use crate::study::NamedScalar;

/// A scalar whose dampers are written as words or as bytes.
pub trait Word: NamedScalar {
    /// The words of a damper, as literals.
    fn literals(damper: &Damper<Self>) -> Vec<String>;
    /// The bytes of a damper, as firmware and the C library check them.
    fn image(damper: &Damper<Self>) -> Vec<u8>;
}

impl Word for f32 {
    fn literals(damper: &Damper<f32>) -> Vec<String> {
        damper.to_words().map(|word| literal(word, 8)).into()
    }
    fn image(damper: &Damper<f32>) -> Vec<u8> {
        damper.to_image().into()
    }
}

impl Word for f64 {
    fn literals(damper: &Damper<f64>) -> Vec<String> {
        damper.to_words().map(|word| literal(word, 16)).into()
    }
    fn image(damper: &Damper<f64>) -> Vec<u8> {
        damper.to_image().into()
    }
}

fn literal(word: impl LowerHex, digits: usize) -> String {
    format!("0x{word:0digits$x}")
}
