//! The axes of the tables: where their nodes lie and how a value finds its cell.

use std::array::from_fn;

use fearless_simd::{Simd, f64x4};

use super::TablesError;
use crate::math::each::Each;
use crate::math::number::{Lanes, load};

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

/// Where values lie on an axis.
#[derive(Clone, Copy)]
pub(super) struct Located<S: Simd> {
    /// Number of the cell, a whole number.
    pub cell: f64x4<S>,
    /// Place within the cell, from 0 to 1.
    pub place: f64x4<S>,
    /// Distance to the nearest end, zero inside.
    pub outside: f64x4<S>,
}

/// An axis prepared for reading, in four lanes: of the tables of one wheel, or of two.
#[derive(Debug, Clone, Copy)]
pub(super) struct AxisReader {
    ends: [[f64; 4]; 4],
    cells_per_unit: [[f64; 4]; 3],
    /// What the position of the first end lacks of zero.
    offset: [f64; 4],
    last_cell: [f64; 4],
}

/// 1.5 2^52: a much smaller number added to it becomes whole, and stands in the lower bits.
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

    /// The axes of a left and of a right wheel, each in every other lane.
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

    /// Adds up the cells on the way through the three parts, so that no part need be chosen.
    #[inline(always)]
    pub fn locate<S: Simd>(&self, x: f64x4<S>) -> Located<S> {
        let simd = x.simd;
        let [first, second, third, last] = self.ends.each(|end| load(simd, &end));
        let [before, fine, behind] = self.cells_per_unit.each(|cells| load(simd, &cells));
        let position = x.at_least(first).at_most(second) * before
            + x.at_least(second).at_most(third) * fine
            + x.at_least(third).at_most(last) * behind
            + load(simd, &self.offset);
        // The nearest whole number below, or at a node either cell.
        let cell = (position - 0.5 + WHOLE - WHOLE).at_most(load(simd, &self.last_cell));
        Located {
            cell,
            place: position - cell,
            outside: x - x.at_least(first).at_most(last),
        }
    }

    /// Derivative of the place in `cell` by the value.
    pub fn cells_per_unit(&self, cell: f64) -> f64 {
        let ([first, second, third, _], [before, fine, behind]) = (
            self.ends.map(|end| end[0]),
            self.cells_per_unit.map(|cells| cells[0]),
        );
        // The ends of a part are whole numbers of cells but for rounding.
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

/// Numbers of a left and of a right wheel, each in every other lane.
pub(in crate::contact) fn in_lanes(left: &[f64; 4], right: &[f64; 4]) -> [f64; 4] {
    [left[0], right[0], left[0], right[0]]
}

/// A whole number from 0 to 2^32.
#[inline(always)]
pub(super) fn whole(number: f64) -> usize {
    (number + WHOLE).to_bits() as u32 as usize
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
