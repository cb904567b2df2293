//! Tables of the source paper, for comparison with the results.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::TestbenchError;
use super::bench_test::Indices;

/// Table 2: piston extension valve.
pub(crate) const TABLE_2: &str = include_str!("../data/published/table2_piston_extension.csv");
/// Table 3: piston compression valve.
pub(crate) const TABLE_3: &str = include_str!("../data/published/table3_piston_compression.csv");
/// Table 4: foot compression valve.
pub(crate) const TABLE_4: &str = include_str!("../data/published/table4_foot_compression.csv");
const TABLE_5: &str = include_str!("../data/published/table5_nominal_characteristic.csv");

/// Row of Tables 2-4: edge deflection of a shim pack under pressure.
#[derive(Clone, Debug, Deserialize)]
pub struct Deflection {
    /// Pressure (MPa).
    pub pressure_mpa: f64,
    /// Deflection by theory under uniform pressure (mm).
    pub theory_uniform_mm: f64,
    /// Deflection by finite elements under the actual pressure distribution (mm).
    pub fea_real_mm: f64,
}

impl Deflection {
    /// Returns the pressure (Pa).
    pub fn pressure_pa(&self) -> f64 {
        self.pressure_mpa * 1e6
    }

    /// Returns the deflection by theory under uniform pressure (m).
    pub fn theory_uniform_m(&self) -> f64 {
        self.theory_uniform_mm * 1e-3
    }

    /// Returns the deflection by finite elements under the actual pressure distribution (m).
    pub fn fea_real_m(&self) -> f64 {
        self.fea_real_mm * 1e-3
    }
}

/// Row of Table 5: an index of the bench test, with its values as printed.
#[derive(Clone, Debug, Deserialize)]
pub struct NominalIndex {
    /// Name of the index.
    pub index: String,
    /// Unit of the values.
    pub unit: String,
    /// Value from the paper's simulation.
    pub simulation: String,
    /// Value from the paper's bench test.
    pub test: String,
}

impl NominalIndex {
    /// Formats the same index of `indices` in this row's unit.
    ///
    /// # Errors
    /// Returns an error if [`Indices`] has no index with this name.
    pub fn format_value(&self, indices: &Indices) -> Result<String, TestbenchError> {
        Ok(match self.index.as_str() {
            "damping coefficient" => format!("{:.2}", indices.damping_coefficient_n_s_per_m * 1e-3),
            "maximum extension force" => format!("{:.0}", indices.max_extension_force_n),
            "maximum compression force" => format!("{:.0}", indices.max_compression_force_n),
            "asymmetry rate" => indices
                .asymmetry_rate
                .map_or_else(|| "no force".into(), |rate| format!("{:.2}", rate * 1e2)),
            "energy per cycle" => format!("{:.2}", indices.energy_per_cycle_j),
            other => return Err(TestbenchError::Table5(format!("unknown index {other}"))),
        })
    }
}

/// Table 5 in SI units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct NominalCharacteristic {
    /// Indices of the paper's simulation.
    pub simulation: Indices,
    /// Indices measured in the paper's bench test.
    pub test: Indices,
}

/// Parses Table 2, 3 or 4.
///
/// # Errors
/// Returns an error if the built-in table is corrupt.
pub(crate) fn deflections(table: &str) -> Result<Vec<Deflection>, TestbenchError> {
    rows(table)
}

/// Parses Table 5.
///
/// # Errors
/// Returns an error if the built-in table is corrupt.
pub fn nominal_indices() -> Result<Vec<NominalIndex>, TestbenchError> {
    rows(TABLE_5)
}

/// Returns Table 5 in SI units.
///
/// # Errors
/// Returns an error if the built-in table is corrupt.
pub fn nominal_characteristic() -> Result<NominalCharacteristic, TestbenchError> {
    let rows = nominal_indices()?;
    let column = |printed: fn(&NominalIndex) -> &str| -> Result<Indices, TestbenchError> {
        let value = |name: &str| {
            let row = rows.iter().find(|row| row.index == name);
            row.and_then(|row| printed(row).parse::<f64>().ok())
                .ok_or_else(|| TestbenchError::Table5(format!("no value for the {name}")))
        };
        Ok(Indices {
            max_extension_force_n: value("maximum extension force")?,
            max_compression_force_n: value("maximum compression force")?,
            asymmetry_rate: Some(value("asymmetry rate")? * 1e-2),
            energy_per_cycle_j: value("energy per cycle")?,
            damping_coefficient_n_s_per_m: value("damping coefficient")? * 1e3,
        })
    };
    Ok(NominalCharacteristic {
        simulation: column(|row| &row.simulation)?,
        test: column(|row| &row.test)?,
    })
}

fn rows<T: DeserializeOwned>(table: &str) -> Result<Vec<T>, TestbenchError> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    Ok(reader.deserialize().collect::<Result<_, _>>()?)
}
