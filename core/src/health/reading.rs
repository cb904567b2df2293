//! What the estimator tells.

bitflags::bitflags! {
    /// Bits of an estimate. Alarms are latched until they are cleared.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct HealthStatus: u16 {
        /// Flow at the same force, and with it damping, has changed: alarm.
        const FLOW = 1;
        /// The mount's stiffness has changed: alarm.
        const STIFFNESS = 1 << 1;
        /// The clearance has changed: alarm.
        const CLEARANCE = 1 << 2;
        /// Not enough is known now for an alarm: too little motion in contact. Not latched.
        const LITTLE_EXCITATION = 1 << 3;
        /// A sample was not finite or not credible and was left out.
        const INPUT_REJECTED = 1 << 4;
        /// The estimate itself was damaged or contradicted for long, and began anew.
        const RESTARTED = 1 << 5;
        /// The damper moved and the force did not follow: no force, or one that never changes, where the model has
        /// force. A dead or stuck force channel, oil full of air, a clearance wider than the motion: alarm.
        const NO_FORCE = 1 << 6;
        /// The zero of the force sensor is off: alarm. The estimates are corrected for it.
        const FORCE_ZERO = 1 << 7;
        /// The channels are further apart in time than is known beforehand; stiffness and clearance are then wrong. Not
        /// latched.
        const LATE = 1 << 8;
        /// Two or three of flow, stiffness and clearance differ from the baseline: wear seldom does that, a wrong scale
        /// of a sensor, a stuck displacement or a reversed sign does. Not latched.
        const SEVERAL_CHANGED = 1 << 9;
        /// What is measured does not follow from the model whatever its parameters are, or the estimate is still on its
        /// way after a change. Not latched.
        const MISFIT = 1 << 10;
    }
}

/// On the wire a number of 16 bits; bits of later versions stay.
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

/// A number and the standard deviation with which it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "link", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct Estimate {
    /// The number.
    pub value: f32,
    /// Its standard deviation.
    pub sd: f32,
}

/// What is known of a damper now.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "link", derive(serde::Serialize, serde::Deserialize))]
#[repr(C)]
pub struct HealthReading {
    /// Flow over nominal flow at the same force (1). Its inverse is the damping factor.
    pub flow_factor: Estimate,
    /// Effective stiffness Ke of the mount (N/m), the nominal oil column taken out.
    pub stiffness_n_per_m: Estimate,
    /// Clearance 2a, the whole play (m).
    pub clearance_m: Estimate,
    /// Lag of the measured force behind the measured displacement (s).
    pub lag_s: Estimate,
    /// Compliance `1/Ke` (m/N), which is what is estimated.
    pub compliance_m_per_n: Estimate,
    /// Samples that told something: in contact, not yielding.
    pub samples: u32,
    /// Samples that were not finite or not credible.
    pub rejected: u32,
    /// Status.
    pub status: HealthStatus,
    /// Force that is measured where there is none (N): the zero of the force sensor. The other estimates are corrected
    /// for it.
    pub force_zero_n: Estimate,
    /// Friction of the seals beyond the nominal one (N). The other estimates are corrected for it.
    pub added_friction_n: Estimate,
}

impl HealthStatus {
    /// The bits that say that intervals may not contain the truth now.
    pub const DOUBTS: Self = Self::NO_FORCE
        .union(Self::LATE)
        .union(Self::SEVERAL_CHANGED)
        .union(Self::MISFIT);
}

impl HealthReading {
    /// Whether nothing says that its intervals may not contain the truth.
    pub fn is_trusted(&self) -> bool {
        !self.status.intersects(HealthStatus::DOUBTS)
    }

    /// Damping force over the nominal one at the same velocity were the law linear: the inverse of the flow factor.
    pub fn damping_factor(&self) -> Estimate {
        let value = 1.0 / self.flow_factor.value;
        Estimate {
            value,
            sd: self.flow_factor.sd * value * value,
        }
    }

    /// This reading as the baseline of the same damper.
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
