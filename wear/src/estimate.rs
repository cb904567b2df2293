//! Estimated wear of a profile.

use std::fmt;

use serde::Serialize;

use crate::grid::CELL_M;
use crate::law::WearLaw;

/// Depth of wear at one cell of a profile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CellWear {
    /// Lateral position of the middle of the cell in the axes of the profile, m.
    pub y_m: f64,
    /// Depth of the surface there in the axes of the profile, m.
    pub z_m: f64,
    /// Depth of the material lost along the normal, m.
    pub depth_m: f64,
}

/// Estimated wear of a profile. `Display` states that it is an estimate, and by which law.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WearEstimate {
    /// Name of the law.
    pub law: &'static str,
    /// Publication of the law.
    pub source: &'static str,
    /// Depth at each cell, from the first sample of the profile on.
    pub cells: Vec<CellWear>,
    /// Maximum depth, m.
    pub max_depth_m: f64,
    /// Area lost from the profile, m^2.
    pub area_m2: f64,
    /// Volume lost, m^3.
    pub volume_m3: f64,
}

impl WearEstimate {
    pub(crate) fn new(
        law: &WearLaw,
        cells: impl Iterator<Item = ([f64; 2], f64)>,
        volume_m3: f64,
    ) -> Self {
        let cells: Vec<CellWear> = cells
            .map(|([y_m, z_m], depth_m)| CellWear { y_m, z_m, depth_m })
            .collect();
        let depths_m = || cells.iter().map(|cell| cell.depth_m);
        Self {
            law: law.name(),
            source: law.source(),
            max_depth_m: depths_m().fold(0.0, f64::max),
            area_m2: depths_m().sum::<f64>() * CELL_M,
            volume_m3,
            cells,
        }
    }

    /// The same wear multiplied by `factor`, as over a longer distance.
    pub fn scaled(mut self, factor: f64) -> Self {
        for cell in &mut self.cells {
            cell.depth_m *= factor;
        }
        self.max_depth_m *= factor;
        self.area_m2 *= factor;
        self.volume_m3 *= factor;
        self
    }

    /// Sum of this wear and that of the same cells by `other`.
    pub fn plus(mut self, other: &Self) -> Self {
        for (cell, other) in self.cells.iter_mut().zip(&other.cells) {
            cell.depth_m += other.depth_m;
        }
        self.max_depth_m = self.cells.iter().map(|cell| cell.depth_m).fold(0.0, f64::max);
        self.area_m2 += other.area_m2;
        self.volume_m3 += other.volume_m3;
        self
    }
}

impl fmt::Display for WearEstimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "estimate by {} ({}): {:.3} um deep, {:.4} mm^2 lost",
            self.law,
            self.source,
            1e6 * self.max_depth_m,
            1e6 * self.area_m2
        )
    }
}
