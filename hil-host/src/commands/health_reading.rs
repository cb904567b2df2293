//! A reading of a damper's health as commands tell it: in JSON, and in words.

use dashpot_core::health::{Estimate, HealthReading, HealthStatus};
use serde::Serialize;

use crate::study::health::stiffness_in_words;

/// An estimate, its status in words.
#[derive(Debug, Serialize)]
pub struct Told {
    pub flow_factor: Estimate,
    pub damping_factor: Estimate,
    pub stiffness_n_per_m: Estimate,
    pub clearance_m: Estimate,
    pub lag_s: Estimate,
    pub compliance_m_per_n: Estimate,
    pub samples: u32,
    pub rejected: u32,
    pub status: Vec<String>,
}

impl From<&HealthReading> for Told {
    fn from(reading: &HealthReading) -> Self {
        let names = reading.status.iter_names();
        Self {
            flow_factor: reading.flow_factor,
            damping_factor: reading.damping_factor(),
            stiffness_n_per_m: reading.stiffness_n_per_m,
            clearance_m: reading.clearance_m,
            lag_s: reading.lag_s,
            compliance_m_per_n: reading.compliance_m_per_n,
            samples: reading.samples,
            rejected: reading.rejected,
            status: names.map(|(name, _)| name.to_lowercase()).collect(),
        }
    }
}

impl Told {
    /// The stiffness in words, MN/m.
    pub fn stiffness_in_words(&self) -> String {
        stiffness_in_words(self.stiffness_n_per_m, self.compliance_m_per_n)
    }

    /// Whether the status has this.
    pub fn has(&self, status: HealthStatus) -> bool {
        let mut names = status.iter_names();
        names.any(|(name, _)| {
            self.status
                .iter()
                .any(|told| told.eq_ignore_ascii_case(name))
        })
    }
}
