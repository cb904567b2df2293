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

    /// The same wear, averaged with the window `1 + cos(pi s / l)` over the distances `s` up to `l = length_m` along
    /// the surface. Each cell spreads its depth over the cells in its window, so the area is kept, at the ends too. A
    /// length below a cell, and NaN, leave the wear as it is.
    pub fn averaged(mut self, length_m: f64) -> Self {
        if length_m.is_nan() || length_m < CELL_M {
            return self;
        }
        let weight = |distance: usize| {
            let part = distance as f64 * CELL_M / length_m;
            if part < 1.0 {
                1.0 + libm::cos(std::f64::consts::PI * part)
            } else {
                0.0
            }
        };
        let count = self.cells.len();
        let reach = (length_m / CELL_M).min(count as f64) as usize;
        let mut depths = vec![0.0; count];
        for (cell, wear) in self.cells.iter().enumerate() {
            let window = cell.saturating_sub(reach)..(cell + reach + 1).min(count);
            let weights = |other: usize| weight(cell.abs_diff(other));
            let total: f64 = window.clone().map(weights).sum();
            for other in window {
                depths[other] += wear.depth_m * weights(other) / total;
            }
        }
        for (cell, depth_m) in self.cells.iter_mut().zip(depths) {
            cell.depth_m = depth_m;
        }
        self.max_depth_m = self
            .cells
            .iter()
            .map(|cell| cell.depth_m)
            .fold(0.0, f64::max);
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
