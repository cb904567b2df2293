//! Origin of an exported damper, as a comment in the source.

use dashpot_core::health::{Health, HealthModel};
use dashpot_core::{Damper, DamperState};

use super::Word;
use dashpot_files::Scalar;

/// Origin of an exported damper, written into the file.
pub struct Provenance<'a> {
    /// Preset or file of the damper.
    pub damper: &'a str,
    /// Requested time step (us).
    pub step_us: f64,
    /// Command line that reproduces the file.
    pub command: &'a str,
}

impl Provenance<'_> {
    /// One-line title with damper and step.
    pub(super) fn title(&self) -> String {
        format!(
            "Damper `{}`, step {} us.",
            one_line(self.damper),
            self.step_us
        )
    }

    /// Same as [`Self::title`] for the damper's health model.
    pub(super) fn health_title(&self) -> String {
        format!(
            "Health model of damper `{}`, step {} us.",
            one_line(self.damper),
            self.step_us
        )
    }

    /// Same as [`Self::comment`] for the damper's health model.
    pub(super) fn health_comment(&self, needs: &str) -> String {
        let version = env!("CARGO_PKG_VERSION");
        format!(
            "// Health model of damper `{}` for a step of {} us ({:.6} kHz).\n\
             // {} bytes in flash; {} bytes in memory, {} more for each estimate.\n\
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

    /// Returns comment lines for Rust or C; `stored` describes the content, `needs` the code that reads it.
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

/// Replaces control characters: a line break in a file name would end the comment.
fn one_line(text: &str) -> String {
    text.chars()
        .map(|letter| if letter.is_control() { ' ' } else { letter })
        .collect()
}
