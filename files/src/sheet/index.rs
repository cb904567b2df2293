//! Indices of a bench test that a sheet reports and limits.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Characteristic value (index) of a periodic cycle, such as its maximum force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Index {
    /// Maximum force in extension (N).
    MaxExtensionForceN,
    /// Maximum magnitude of the force in compression (N).
    MaxCompressionForceN,
    /// Force in extension at the peak velocity, at mid-stroke (N).
    ExtensionForceAtPeakVelocityN,
    /// Magnitude of the force in compression at the peak velocity, at mid-stroke (N).
    CompressionForceAtPeakVelocityN,
    /// Difference of the maximum forces divided by their sum (1); undefined without force.
    AsymmetryRate,
    /// Energy dissipated per cycle (J).
    EnergyPerCycleJ,
    /// Mean of the two maximum forces, divided by the peak velocity (N s/m).
    DampingCoefficientNSPerM,
    /// First harmonic of the force divided by the amplitude (N/m).
    DynamicStiffnessNPerM,
    /// Phase by which the first harmonic of the force leads the displacement (degrees); undefined without force.
    LossAngleDeg,
}

/// Unit in which an index is displayed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplayUnit {
    /// Symbol of the unit.
    pub symbol: &'static str,
    /// One display unit, in the unit of the index's key, such as 1000 for kN.
    pub size: f64,
}

impl Index {
    /// All indices, in the order in which a sheet lists them.
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

    /// Key in a sheet file.
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

    /// Name in words.
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

    /// Returns the unit in which the index is displayed.
    ///
    /// ```
    /// use dashpot_files::sheet::Index;
    /// assert_eq!(Index::DynamicStiffnessNPerM.display_unit().size, 1e6);
    /// ```
    pub fn display_unit(self) -> DisplayUnit {
        let (symbol, size) = match self {
            Self::MaxExtensionForceN
            | Self::MaxCompressionForceN
            | Self::ExtensionForceAtPeakVelocityN
            | Self::CompressionForceAtPeakVelocityN => ("kN", 1e3),
            Self::AsymmetryRate => ("%", 1e-2),
            Self::EnergyPerCycleJ => ("J", 1.0),
            Self::DampingCoefficientNSPerM => ("kN s/m", 1e3),
            Self::DynamicStiffnessNPerM => ("MN/m", 1e6),
            Self::LossAngleDeg => ("°", 1.0),
        };
        DisplayUnit { symbol, size }
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
    fn each_key_deserializes_to_its_index() {
        for index in Index::ALL {
            let key = format!("\"{index}\"");
            assert_eq!(serde_json::from_str::<Index>(&key).unwrap(), index);
        }
    }
}
