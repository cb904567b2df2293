//! Results of the estimator.

bitflags::bitflags! {
    /// Status bits of an estimate. Alarms are latched until they are cleared.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct HealthStatus: u16 {
        /// Alarm: the flow at the same force, and thus the damping, has changed.
        const FLOW = 1;
        /// Alarm: the stiffness of the mount has changed.
        const STIFFNESS = 1 << 1;
        /// Alarm: the clearance has changed.
        const CLEARANCE = 1 << 2;
        /// There is too little motion in contact for an alarm. Not latched.
        const LITTLE_EXCITATION = 1 << 3;
        /// A sample was not finite or not credible and was left out.
        const INPUT_REJECTED = 1 << 4;
        /// The estimate was damaged, or contradicted the samples for a long time, and was restarted.
        const RESTARTED = 1 << 5;
        /// Alarm: the damper moved, but the force is zero or does not change. Possible causes are a dead or stuck force
        /// channel, oil full of air, or a clearance wider than the motion.
        const NO_FORCE = 1 << 6;
        /// Alarm: the force sensor has a zero offset. The estimates are corrected for it.
        const FORCE_ZERO = 1 << 7;
        /// The lag between the channels is larger than assumed, so stiffness and clearance are wrong. Not latched.
        const LATE = 1 << 8;
        /// Two or three of flow, stiffness and clearance differ from the baseline. A wrong scale, a stuck displacement
        /// or a reversed sign of a sensor is a likelier cause than wear. Not latched.
        const SEVERAL_CHANGED = 1 << 9;
        /// The model cannot explain the samples with any parameters, or the estimate is still converging after a
        /// change. Not latched.
        const MISFIT = 1 << 10;
    }
}

/// Serialised as a 16-bit number. Unknown bits of later versions are kept.
#[cfg(feature = "link")]
impl serde::Serialize for HealthStatus {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u16(self.bits())
    }
}

#[cfg(feature = "link")]
impl<'de> serde::Deserialize<'de> for HealthStatus {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        u16::deserialize(deserializer).map(Self::from_bits_retain)
    }
}

/// A value and its standard deviation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "link", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Estimate {
    /// Estimated value.
    pub value: f32,
    /// Standard deviation of the value.
    pub sd: f32,
}

/// Present estimates of a damper.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "link", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
#[repr(C)]
pub struct HealthReading {
    /// Ratio of the flow to the nominal flow at the same force (1). Its inverse is the damping factor.
    pub flow_factor: Estimate,
    /// Effective stiffness Ke of the mount without the nominal oil column (N/m).
    pub stiffness_n_per_m: Estimate,
    /// Clearance 2a: the total play (m).
    pub clearance_m: Estimate,
    /// Lag of the measured force behind the measured displacement (s).
    pub lag_s: Estimate,
    /// Compliance `1/Ke` (m/N), the quantity that the filter estimates.
    pub compliance_m_per_n: Estimate,
    /// Number of usable samples, taken in contact and without yielding.
    pub samples: u32,
    /// Number of samples that were not finite or not credible.
    pub rejected: u32,
    /// Status bits.
    pub status: HealthStatus,
    /// Zero offset of the force sensor (N). The other estimates are corrected for it.
    pub force_zero_n: Estimate,
    /// Friction of the seals in excess of the nominal friction (N). The other estimates are corrected for it.
    pub added_friction_n: Estimate,
}

impl HealthStatus {
    /// Bits that warn that the intervals may not contain the true values.
    pub const DOUBTS: Self = Self::NO_FORCE
        .union(Self::LATE)
        .union(Self::SEVERAL_CHANGED)
        .union(Self::MISFIT);
}

impl HealthReading {
    /// True if no bit of [`HealthStatus::DOUBTS`] is set, and no more samples were rejected than were used.
    pub fn is_trusted(&self) -> bool {
        !self.status.intersects(HealthStatus::DOUBTS) && self.rejected <= self.samples
    }

    /// Ratio of the damping force to the nominal force at the same velocity (1), assuming a linear law: the inverse of
    /// the flow factor.
    pub fn damping_factor(&self) -> Estimate {
        let value = 1.0 / self.flow_factor.value;
        Estimate {
            value,
            sd: self.flow_factor.sd * value * value,
        }
    }

    /// Returns this reading as a baseline for the same damper.
    pub fn as_baseline(&self) -> super::Baseline {
        super::Baseline {
            flow_factor: self.flow_factor.value,
            compliance_m_per_n: self.compliance_m_per_n.value,
            clearance_m: self.clearance_m.value,
            flow_factor_sd: self.flow_factor.sd,
            compliance_sd_m_per_n: self.compliance_m_per_n.sd,
            clearance_sd_m: self.clearance_m.sd,
        }
    }
}

#[cfg(test)]
mod tests;
