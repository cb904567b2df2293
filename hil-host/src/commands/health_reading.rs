//! Health estimates of a damper in command reports, as JSON and as text.

use dashpot_core::health::{Estimate, HealthReading, HealthStatus};
use serde::Serialize;

use dashpot_testbench::health::{doubts_in_words, stiffness_in_words};

/// Health estimates with status names.
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
    pub force_zero_n: Estimate,
    pub added_friction_n: Estimate,
    /// True if no status bit casts doubt on the intervals.
    pub trusted: bool,
    #[serde(skip)]
    bits: HealthStatus,
    /// Why the reading is not trusted.
    #[serde(skip)]
    pub doubts: Vec<String>,
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
            force_zero_n: reading.force_zero_n,
            added_friction_n: reading.added_friction_n,
            trusted: reading.is_trusted(),
            bits: reading.status,
            doubts: doubts_in_words(reading),
        }
    }
}

impl Told {
    /// Formats the stiffness in MN/m.
    pub fn stiffness_in_words(&self) -> String {
        stiffness_in_words(self.stiffness_n_per_m, self.compliance_m_per_n)
    }

    /// True if the status contains `status`.
    pub fn has(&self, status: HealthStatus) -> bool {
        self.bits.contains(status)
    }
}
