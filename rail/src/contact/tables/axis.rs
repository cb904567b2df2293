//! The axes of the tables: positions of the nodes, and the cell of a value.

use std::array::from_fn;

use fearless_simd::{Simd, SimdBase, f64x4};

use super::TablesError;
use crate::math::each::Each;
use crate::math::number::load;
use crate::setters::setters;

/// Nodes along one axis, in three parts: coarse, fine, coarse.
///
/// The fields are complete; none will be added.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// First value, start and end of the fine part, and last value, in the unit of the axis.
    pub ends: [f64; 4],
    /// Number of cells in each part; zero in a part without width.
    pub cells: [usize; 3],
}

impl Axis {
    /// Checks that the ends are finite and rise, that exactly the parts with a width have cells, and that there are at
    /// most `limit` nodes.
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

    /// Value at a node, counted from 0; beyond the last node, the last value.
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

/// Positions of values on an axis.
#[derive(Clone, Copy)]
pub(super) struct Located<S: Simd> {
    /// Index of the cell, a whole number.
    pub cell: f64x4<S>,
    /// Position within the cell, 0 to 1.
    pub position: f64x4<S>,
    /// Distance beyond the nearest end; zero inside.
    pub outside: f64x4<S>,
}

/// An axis prepared for lookup in four lanes, for the tables of one wheel or of two.
#[derive(Debug, Clone, Copy)]
pub(super) struct AxisReader {
    ends: [[f64; 4]; 4],
    cells_per_unit: [[f64; 4]; 3],
    /// Position of the first end, in cells, with the opposite sign.
    offset: [f64; 4],
    last_cell: [f64; 4],
}

/// 1.5 * 2^52: adding it to a much smaller number rounds that to a whole number, held in the low bits.
const WHOLE: f64 = 6_755_399_441_055_744.0;

impl AxisReader {
    pub fn new(axis: &Axis) -> Self {
        let cells_per_unit = [0, 1, 2].map(|part| {
            let width = axis.ends[part + 1] - axis.ends[part];
            if width > 0.0 {
                axis.cells[part] as f64 / width
            } else {
                0.0
            }
        });
        let ends = cells_per_unit.iter().zip(axis.ends);
        let offset: f64 = -ends.map(|(cells, end)| cells * end).sum::<f64>();
        Self {
            ends: axis.ends.map(|end| [end; 4]),
            cells_per_unit: cells_per_unit.map(|cells| [cells; 4]),
            offset: [offset; 4],
            last_cell: [axis.nodes() as f64 - 2.0; 4],
        }
    }

    /// Interleaves the axes of a left and a right wheel: left, right, left, right.
    pub fn of_two(left: &Self, right: &Self) -> Self {
        Self {
            ends: from_fn(|k| in_lanes(&left.ends[k], &right.ends[k])),
            cells_per_unit: from_fn(|k| {
                in_lanes(&left.cells_per_unit[k], &right.cells_per_unit[k])
            }),
            offset: in_lanes(&left.offset, &right.offset),
            last_cell: in_lanes(&left.last_cell, &right.last_cell),
        }
    }

    /// Locates values by adding up the cells passed in all three parts, which needs no branch.
    #[inline(always)]
    pub fn locate<S: Simd>(&self, x: f64x4<S>) -> Located<S> {
        let simd = x.simd;
        let [first, second, third, last] = self.ends.each(|end| load(simd, &end));
        let [before, fine, behind] = self.cells_per_unit.each(|cells| load(simd, &cells));
        let position = x.max(first).min(second) * before
            + x.max(second).min(third) * fine
            + x.max(third).min(last) * behind
            + load(simd, &self.offset);
        // Rounds down; at a node, either neighbouring cell is right.
        let cell = (position - 0.5 + WHOLE - WHOLE).min(load(simd, &self.last_cell));
        Located {
            cell,
            position: position - cell,
            outside: x - x.max(first).min(last),
        }
    }

    /// Derivative of the position in `cell` with respect to the value.
    pub fn cells_per_unit(&self, cell: f64) -> f64 {
        let ([first, second, third, _], [before, fine, behind]) = (
            self.ends.map(|end| end[0]),
            self.cells_per_unit.map(|cells| cells[0]),
        );
        // The ends of a part lie at whole numbers of cells, except for rounding errors.
        let cells_before = before * (second - first);
        if cell + 0.5 < cells_before {
            before
        } else if cell + 0.5 < cells_before + fine * (third - second) {
            fine
        } else {
            behind
        }
    }
}

/// Interleaves the first lanes of a left and a right wheel: left, right, left, right.
pub(in crate::contact) fn in_lanes(left: &[f64; 4], right: &[f64; 4]) -> [f64; 4] {
    [left[0], right[0], left[0], right[0]]
}

/// Converts a whole number below 2^32 to an index.
#[inline(always)]
pub(super) fn whole(number: f64) -> usize {
    (number + WHOLE).to_bits() as u32 as usize
}

/// Extent and spacing of the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Grid {
    /// Lateral shift of the wheel, field side positive, m.
    pub lateral_m: Axis,
    /// Roll, field side down positive, rad.
    pub roll_rad: Axis,
    /// Square of the yaw, rad^2; the silhouette is an even function of the yaw.
    pub yaw_squared_rad2: Axis,
}

impl Grid {
    setters! {
        with_lateral_m sets lateral_m: Axis;
        with_roll_rad sets roll_rad: Axis;
        with_yaw_squared_rad2 sets yaw_squared_rad2: Axis;
    }

    /// Number of nodes.
    pub(super) fn nodes(&self) -> usize {
        self.lateral_m.nodes() * self.roll_rad.nodes() * self.yaw_squared_rad2.nodes()
    }
}

impl Default for Grid {
    /// Shift from -20 mm (wheel towards the track centre) to 65 mm (flange past the rail's top), roll up to 24 mrad,
    /// yaw up to 50 mrad.
    ///
    /// The shift nodes are 0.03 mm apart from 0 to 12 mm and 0.1 mm apart below, the roll nodes 1.5 mrad apart within
    /// 12 mrad, the nodes of the squared yaw 1e-4 rad^2 apart within 30 mrad.
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
