//! The axes of the tables: where their nodes lie and how a value finds its cell.

use super::TablesError;

/// Nodes along one axis in three parts: coarse, fine, coarse.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// First value, beginning and end of the fine part, last value, in the unit of the axis.
    pub ends: [f64; 4],
    /// Number of cells in each part; a part without width has zero cells.
    pub cells: [usize; 3],
}

impl Axis {
    /// Checks that the ends are finite and rise, and that exactly the parts with a width have cells.
    ///
    /// The number of nodes is at most `limit`.
    pub(super) fn check(&self, name: &'static str, limit: usize) -> Result<(), TablesError> {
        let part = |k: usize| {
            let width = self.ends[k + 1] - self.ends[k];
            width >= 0.0 && width.is_finite() && (width > 0.0) == (self.cells[k] > 0)
        };
        let cells = self
            .cells
            .iter()
            .try_fold(0_usize, |sum, cells| sum.checked_add(*cells));
        match cells {
            Some(cells) if (1..limit).contains(&cells) && (0..3).all(part) => Ok(()),
            _ => Err(TablesError::Axis { name, axis: *self }),
        }
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.cells.iter().sum::<usize>() + 1
    }

    /// Value at a node, counted from 0; beyond the last node its value.
    pub fn value(&self, node: usize) -> f64 {
        let mut first = 0;
        for part in 0..3 {
            let cells = self.cells[part];
            if node <= first + cells && cells > 0 {
                let t = (node - first) as f64 / cells as f64;
                return self.ends[part] + t * (self.ends[part + 1] - self.ends[part]);
            }
            first += cells;
        }
        self.ends[3]
    }
}

/// Where a value lies on an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Located {
    pub cell: usize,
    /// Place within the cell, from 0 to 1.
    pub place: f64,
    /// Derivative of the place by the value; zero outside, where the nearest end is read.
    pub cells_per_unit: f64,
    pub is_inside: bool,
}

/// An axis prepared for reading: cells per unit in place of cell widths.
#[derive(Debug, Clone, Copy)]
pub(super) struct AxisReader {
    ends: [f64; 4],
    first: [f64; 3],
    per_unit: [f64; 3],
    last_cell: u32,
}

impl AxisReader {
    pub fn new(axis: Axis) -> Self {
        let [a, b, _] = axis.cells;
        let per_unit = [0, 1, 2].map(|part| {
            let width = axis.ends[part + 1] - axis.ends[part];
            if width > 0.0 {
                axis.cells[part] as f64 / width
            } else {
                0.0
            }
        });
        Self {
            ends: axis.ends,
            first: [0.0, a as f64, (a + b) as f64],
            per_unit,
            last_cell: axis.nodes() as u32 - 2,
        }
    }

    #[inline(always)]
    pub fn locate(&self, x: f64) -> Located {
        let ends = &self.ends;
        // Plain comparisons: one instruction each, unlike the maximum and minimum that mind NaN.
        let raised = if x > ends[0] { x } else { ends[0] };
        let limited = if raised < ends[3] { raised } else { ends[3] };
        let part = usize::from(limited >= ends[1]) + usize::from(limited > ends[2]);
        let position = self.first[part] + (limited - ends[part]) * self.per_unit[part];
        let cell = (position as u32).min(self.last_cell);
        let is_inside = x == limited;
        Located {
            cell: cell as usize,
            place: position - f64::from(cell),
            cells_per_unit: if is_inside { self.per_unit[part] } else { 0.0 },
            is_inside,
        }
    }
}

/// Extent and spacing of the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Lateral shift of the wheel, field side positive, m.
    pub lateral_m: Axis,
    /// Roll, field side down positive, rad.
    pub roll_rad: Axis,
    /// Square of the yaw, rad^2: the silhouette depends on the yaw by its square.
    pub yaw_squared_rad2: Axis,
}

impl Grid {
    /// Number of nodes.
    pub(super) fn nodes(&self) -> usize {
        self.lateral_m.nodes() * self.roll_rad.nodes() * self.yaw_squared_rad2.nodes()
    }
}

impl Default for Grid {
    /// Shift from -20 mm (wheel towards the track centre) to 65 mm (flange past the rail's top), roll to 24 mrad, yaw
    /// to 50 mrad; nodes 0.03 mm apart up to 12 mm (0.1 mm below zero), 1.5 mrad within 12 mrad and 1e-4 rad^2 within 30 mrad.
    fn default() -> Self {
        Self {
            lateral_m: Axis {
                ends: [-0.020, 0.0, 0.012, 0.065],
                cells: [200, 400, 160],
            },
            roll_rad: Axis {
                ends: [-0.024, -0.012, 0.012, 0.024],
                cells: [2, 16, 2],
            },
            yaw_squared_rad2: Axis {
                ends: [0.0, 0.0, 9e-4, 25e-4],
                cells: [0, 9, 2],
            },
        }
    }
}
