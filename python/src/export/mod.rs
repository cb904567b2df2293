//! Dampers for firmware and other tools: source code, bytes and FMUs.

mod damper;
mod fmu;
mod health;
mod written;

pub use damper::export;
pub use fmu::export_fmu;
pub use health::export_health;

use dashpot_export::ExportError;

use crate::damper::Damper;
use crate::error::Refusal;

/// The name of a damper without its overrides.
fn own_name(damper: &Damper) -> &str {
    damper.name.split(", ").next().unwrap_or_default()
}

impl From<ExportError> for Refusal {
    fn from(error: ExportError) -> Self {
        Self::Value(error.to_string())
    }
}
