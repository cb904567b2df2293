//! Words and bytes of an exported damper, for both scalar types.

use std::fmt::LowerHex;

use dashpot_core::{Damper, DamperState, Real};

/// Scalar type whose dampers can be written as words or bytes.
pub trait Word: Real {
    /// Returns the words of a damper as literals.
    fn literals(damper: &Damper<Self>) -> Vec<String>;
    /// Returns the image of a damper, which firmware and the C library check.
    fn image(damper: &Damper<Self>) -> Vec<u8>;
    /// Returns the words of a damper, zero-extended to 64 bits.
    fn words(damper: &Damper<Self>) -> Vec<u64>;
    /// Converts a word to the number that it encodes.
    fn from_word(word: u64) -> Self;
    /// Returns the bytes of a state, without a checksum.
    fn state_bytes(state: &DamperState<Self>) -> Vec<u8>;
}

impl Word for f32 {
    fn literals(damper: &Damper<f32>) -> Vec<String> {
        damper.to_words().map(|word| literal(word, 8)).into()
    }
    fn image(damper: &Damper<f32>) -> Vec<u8> {
        damper.to_image().into()
    }
    fn words(damper: &Damper<f32>) -> Vec<u64> {
        damper.to_words().map(u64::from).into()
    }
    fn from_word(word: u64) -> Self {
        Self::from_bits(word as u32)
    }
    fn state_bytes(state: &DamperState<f32>) -> Vec<u8> {
        state.to_bytes().into()
    }
}

impl Word for f64 {
    fn literals(damper: &Damper<f64>) -> Vec<String> {
        damper.to_words().map(|word| literal(word, 16)).into()
    }
    fn image(damper: &Damper<f64>) -> Vec<u8> {
        damper.to_image().into()
    }
    fn words(damper: &Damper<f64>) -> Vec<u64> {
        damper.to_words().into()
    }
    fn from_word(word: u64) -> Self {
        Self::from_bits(word)
    }
    fn state_bytes(state: &DamperState<f64>) -> Vec<u8> {
        state.to_bytes().into()
    }
}

fn literal(word: impl LowerHex, digits: usize) -> String {
    format!("0x{word:0digits$x}")
}
