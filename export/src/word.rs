//! What an exported damper consists of, for either scalar.

use std::fmt::LowerHex;

use dashpot_core::{Damper, DamperState, Real};

/// A scalar whose dampers are written as words or as bytes.
pub trait Word: Real {
    /// The words of a damper, as literals.
    fn literals(damper: &Damper<Self>) -> Vec<String>;
    /// The bytes of a damper, as firmware and the C library check them.
    fn image(damper: &Damper<Self>) -> Vec<u8>;
    /// The words of a damper, zero-extended.
    fn words(damper: &Damper<Self>) -> Vec<u64>;
    /// The number of a word.
    fn from_word(word: u64) -> Self;
    /// A state as bare bytes.
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
