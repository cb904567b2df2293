//! Where an exported damper came from, as a comment of its source.

use dashpot_core::health::{Health, HealthModel};
use dashpot_core::{Damper, DamperState};

use super::Word;
use dashpot_files::Scalar;

/// How an exported damper was made, written into the file.
pub struct Provenance<'a> {
    /// Preset or file the damper came from.
    pub damper: &'a str,
    /// The requested step (us).
    pub step_us: f64,
    /// Command line that makes the file again.
    pub command: &'a str,
}

impl Provenance<'_> {
    /// Damper and step in a few words.
    pub(super) fn title(&self) -> String {
        format!(
            "Damper `{}`, step {} us.",
            one_line(self.damper),
            self.step_us
        )
    }

    /// As [`Self::title`], of the damper's model of health.
    pub(super) fn health_title(&self) -> String {
        format!(
            "Model of health of damper `{}`, step {} us.",
            one_line(self.damper),
            self.step_us
        )
    }

    /// As [`Self::comment`], of the damper's model of health.
    pub(super) fn health_comment(&self, needs: &str) -> String {
        let version = env!("CARGO_PKG_VERSION");
        format!(
            "// Model of health of damper `{}` for a step of {} us ({:.6} kHz).\n\
             // {} bytes in flash; in memory it takes {} bytes, an estimate {}.\n\
             // Made by dashpot {version} with\n//     {}\n\
             // Needs {needs} {version}; do not edit.\n",
            one_line(self.damper),
            self.step_us,
            1e3 / self.step_us,
            HealthModel::IMAGE_BYTES,
            size_of::<HealthModel>(),
            size_of::<Health>(),
            one_line(self.command),
        )
    }

    /// Comment lines of Rust or C; `stored` says what the source holds, `needs` what reads it.
    pub(super) fn comment<T: Word>(&self, damper: &Damper<T>, stored: &str, needs: &str) -> String {
        let version = env!("CARGO_PKG_VERSION");
        format!(
            "// Damper `{}` for a step of {} us ({:.6} kHz), {}, revision {:#010x}.\n\
             // {stored} in flash; a state takes {} bytes.\n\
             // Made by dashpot {version} with\n//     {}\n\
             // Needs {needs}; do not edit.\n",
            one_line(self.damper),
            self.step_us,
            1e3 / self.step_us,
            Scalar::of::<T>(),
            damper.revision(),
            size_of::<DamperState<T>>(),
            one_line(self.command),
        )
    }
}

/// A file name may hold a line break, which would end the comment.
fn one_line(text: &str) -> String {
    text.chars()
        .map(|letter| if letter.is_control() { ' ' } else { letter })
        .collect()
}
