//! Parameters of a damper whose trends are computed.

use dashpot_core::health::{Estimate, HealthModel, HealthReading};

use super::fit::Interval;
use super::forecast::Limit;
use super::limits::Limits;

/// A parameter that ages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    /// Damping relative to nominal.
    DampingFactor,
    /// Effective stiffness Ke. Its line is fitted to the compliance, which is what the estimator estimates: for a mount
    /// that cannot be told from a rigid one, the stiffness has no finite deviation.
    Stiffness,
    /// Clearance 2a.
    Clearance,
}

/// Largest standard deviation of a usable reading, as a fraction of the alarm limit. Up to it the estimate does not
/// lean on what the estimator assumed at first; the same number sets `LITTLE_EXCITATION`.
const MAX_SD: f64 = 0.5;

impl Parameter {
    /// All parameters.
    pub const ALL: [Self; 3] = [Self::DampingFactor, Self::Stiffness, Self::Clearance];

    /// Returns the name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::DampingFactor => "damping",
            Self::Stiffness => "stiffness",
            Self::Clearance => "clearance",
        }
    }

    /// Returns the name of the column in tables, with its SI unit.
    pub fn column(self) -> &'static str {
        match self {
            Self::DampingFactor => "damping_factor",
            Self::Stiffness => "stiffness_n_per_m",
            Self::Clearance => "clearance_m",
        }
    }

    /// Returns the unit for people and the factor from the SI unit to it.
    pub fn display_unit(self) -> (&'static str, f64) {
        match self {
            Self::DampingFactor => ("", 1.0),
            Self::Stiffness => ("MN/m", 1e-6),
            Self::Clearance => ("mm", 1e3),
        }
    }

    /// Returns the quantity to which the line is fitted: damping factor (1), compliance (m/N) or clearance (m). `None`
    /// if the recording says too little about it.
    pub fn fitted(self, reading: &HealthReading, model: &HealthModel) -> Option<Estimate> {
        let limits = model.limits();
        let (estimate, max_sd) = match self {
            Self::DampingFactor => (reading.damping_factor(), f64::from(limits.flow_factor)),
            Self::Stiffness => {
                let nominal = f64::from(model.baseline().compliance_m_per_n);
                (
                    reading.compliance_m_per_n,
                    nominal * f64::from(limits.compliance),
                )
            }
            Self::Clearance => (reading.clearance_m, f64::from(limits.clearance_m)),
        };
        let is_usable = estimate.sd > 0.0 && f64::from(estimate.sd) <= MAX_SD * max_sd;
        (is_usable && estimate.value.is_finite()).then_some(estimate)
    }

    /// Returns the limit of the fitted quantity, if there is one.
    pub fn limit(self, limits: &Limits) -> Option<Limit> {
        let (value, is_upper) = match self {
            Self::DampingFactor => (limits.damping_factor, false),
            Self::Stiffness => (limits.stiffness_n_per_m.map(|limit| 1.0 / limit), true),
            Self::Clearance => (limits.clearance_m, true),
        };
        value.map(|value| Limit { value, is_upper })
    }

    /// Returns the parameter (SI) of a fitted quantity; a compliance that is not positive is an infinite stiffness.
    pub fn shown(self, fitted: f64) -> f64 {
        match self {
            Self::Stiffness if fitted <= 0.0 => f64::INFINITY,
            Self::Stiffness => 1.0 / fitted,
            _ => fitted,
        }
    }

    /// Returns the rate of the parameter (SI) where the fitted quantity has this value and this rate.
    pub fn shown_rate(self, value: f64, rate: Interval) -> Interval {
        match self {
            Self::Stiffness => rate.map(|rate| -rate / (value * value)),
            _ => rate,
        }
    }
}
