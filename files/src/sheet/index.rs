//! The indices of a bench test by their names: what a sheet tells and limits.

use std::fmt;

use serde::{Deserialize, Serialize};

/// An index of a periodic cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Index {
    /// Largest force in extension (N).
    MaxExtensionForceN,
    /// Largest force in compression (N), as a magnitude.
    MaxCompressionForceN,
    /// Force in extension at the peak velocity, midway of the stroke (N).
    ExtensionForceAtPeakVelocityN,
    /// Force in compression at the peak velocity, midway of the stroke (N), as a magnitude.
    CompressionForceAtPeakVelocityN,
    /// Difference of the largest forces over their sum (1); there is none without force.
    AsymmetryRate,
    /// Energy taken from the motion in a cycle (J).
    EnergyPerCycleJ,
    /// Mean of both largest forces over the peak velocity (N s/m).
    DampingCoefficientNSPerM,
    /// First harmonic of the force over the amplitude (N/m).
    DynamicStiffnessNPerM,
    /// Phase by which the first harmonic of the force leads the displacement (degrees); there is none without force.
    LossAngleDeg,
}

impl Index {
    /// All of them, in the order of a sheet.
    pub const ALL: [Self; 9] = [
        Self::MaxExtensionForceN,
        Self::MaxCompressionForceN,
        Self::ExtensionForceAtPeakVelocityN,
        Self::CompressionForceAtPeakVelocityN,
        Self::AsymmetryRate,
        Self::EnergyPerCycleJ,
        Self::DampingCoefficientNSPerM,
        Self::DynamicStiffnessNPerM,
        Self::LossAngleDeg,
    ];

    /// Its key in a sheet file.
    pub fn key(self) -> &'static str {
        match self {
            Self::MaxExtensionForceN => "max_extension_force_n",
            Self::MaxCompressionForceN => "max_compression_force_n",
            Self::ExtensionForceAtPeakVelocityN => "extension_force_at_peak_velocity_n",
            Self::CompressionForceAtPeakVelocityN => "compression_force_at_peak_velocity_n",
            Self::AsymmetryRate => "asymmetry_rate",
            Self::EnergyPerCycleJ => "energy_per_cycle_j",
            Self::DampingCoefficientNSPerM => "damping_coefficient_n_s_per_m",
            Self::DynamicStiffnessNPerM => "dynamic_stiffness_n_per_m",
            Self::LossAngleDeg => "loss_angle_deg",
        }
    }

    /// What it is, in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::MaxExtensionForceN => "largest force, extension",
            Self::MaxCompressionForceN => "largest force, compression",
            Self::ExtensionForceAtPeakVelocityN => "force at peak velocity, extension",
            Self::CompressionForceAtPeakVelocityN => "force at peak velocity, compression",
            Self::AsymmetryRate => "asymmetry rate",
            Self::EnergyPerCycleJ => "energy per cycle",
            Self::DampingCoefficientNSPerM => "damping coefficient",
            Self::DynamicStiffnessNPerM => "dynamic stiffness",
            Self::LossAngleDeg => "loss angle",
        }
    }

    /// The unit it is told in, and that unit over the one of its key.
    pub fn told_in(self) -> (&'static str, f64) {
        match self {
            Self::MaxExtensionForceN
            | Self::MaxCompressionForceN
            | Self::ExtensionForceAtPeakVelocityN
            | Self::CompressionForceAtPeakVelocityN => ("kN", 1e3),
            Self::AsymmetryRate => ("%", 1e-2),
            Self::EnergyPerCycleJ => ("J", 1.0),
            Self::DampingCoefficientNSPerM => ("kN s/m", 1e3),
            Self::DynamicStiffnessNPerM => ("MN/m", 1e6),
            Self::LossAngleDeg => ("°", 1.0),
        }
    }
}

impl fmt::Display for Index {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_reads_as_its_index() {
        for index in Index::ALL {
            let key = format!("\"{index}\"");
            assert_eq!(serde_json::from_str::<Index>(&key).unwrap(), index);
        }
    }
}
