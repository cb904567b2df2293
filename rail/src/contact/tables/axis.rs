//! The axes of the tables: nodes as close as the contact asks for.

use std::array::from_fn;
use std::ops::Deref;

use fearless_simd::Simd;

use crate::math::each::Each;
use crate::math::number::{Number, WHOLE, load};

/// Nodes that rise by multiples of one smallest spacing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    first: f64,
    spacing: f64,
    per_spacing: f64,
    /// Number of smallest spacings up to each node.
    steps: Vec<u32>,
    /// The cell that holds each smallest spacing, and once more the last cell.
    cells: Vec<u16>,
    spans: Vec<Span>,
}

/// Extent of a cell in smallest spacings.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Span {
    start: f64,
    /// Reciprocal of the width.
    per_width: f64,
}

/// Three values, each located on its axis. A value beyond an end is located at this end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Located {
    pub cells: [usize; 3],
    /// Positions in the cells, 0 to 1.
    pub positions: [f64; 3],
    /// True if the axes cover all values.
    pub is_inside: bool,
}

/// Three axes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axes {
    axes: [Axis; 3],
    /// First values, numbers of smallest spacings in a unit and in the whole axis.
    firsts: [f64; 4],
    per_spacings: [f64; 4],
    lasts: [f64; 4],
}

impl Axes {
    pub fn new(axes: [Axis; 3]) -> Self {
        let in_lanes = |number: fn(&Axis) -> f64| {
            let [a, b, c] = axes.each_ref().map(number);
            [a, b, c, c]
        };
        Self {
            firsts: in_lanes(|axis| axis.first),
            per_spacings: in_lanes(|axis| axis.per_spacing),
            lasts: in_lanes(|axis| f64::from(axis.last_step())),
            axes,
        }
    }

    /// Locates a value on each axis.
    #[inline(always)]
    pub fn locate<S: Simd>(&self, simd: S, [a, b, c]: [f64; 3]) -> Located {
        let values = load(simd, &[a, b, c, c]);
        let steps = (values - load(simd, &self.firsts)) * load(simd, &self.per_spacings);
        let inside = steps.not_negative();
        let inside = simd.min_f64x4(inside, load(simd, &self.lasts));
        let is_inside = simd.all_true_mask64x4(simd.simd_eq_f64x4(inside, steps));
        let whole = <[f64; 4]>::from(inside + -0.5 + WHOLE);
        let inside = <[f64; 4]>::from(inside);
        let mut located = Located {
            cells: [0; 3],
            positions: [0.0; 3],
            is_inside,
        };
        for (k, axis) in self.axes.iter().enumerate() {
            let (cell, span) = axis.cell_at(whole[k].to_bits() as u32 as usize);
            located.cells[k] = cell;
            located.positions[k] = (inside[k] - span.start) * span.per_width;
        }
        located
    }

    /// Derivatives of the positions with respect to the `values` that were located; zero beyond the ends.
    pub fn per_unit(&self, values: [f64; 3], located: &Located) -> [f64; 3] {
        from_fn(|k| {
            let axis = &self.axes[k];
            let step = (values[k] - axis.first) * axis.per_spacing;
            if (0.0..=self.lasts[k]).contains(&step) {
                axis.per_spacing * axis.spans[located.cells[k]].per_width
            } else {
                0.0
            }
        })
    }
}

/// The axes in falling order of their positions.
#[inline(always)]
pub(super) fn falling_order([shift, roll, yaw]: [f64; 3]) -> [u8; 3] {
    /// For each outcome of the comparisons below; two of them contradict each other.
    const ORDERS: [[u8; 3]; 8] = [
        [2, 1, 0],
        [2, 0, 1],
        [1, 2, 0],
        [0, 1, 2],
        [2, 1, 0],
        [0, 2, 1],
        [1, 0, 2],
        [0, 1, 2],
    ];
    let shift_is_before = [shift >= roll, shift >= yaw].each(usize::from);
    let outcome = shift_is_before[0] | usize::from(roll >= yaw) << 1 | shift_is_before[1] << 2;
    ORDERS[outcome]
}

impl Deref for Axes {
    type Target = [Axis; 3];

    fn deref(&self) -> &[Axis; 3] {
        &self.axes
    }
}

impl Axis {
    /// Divides the range from `first` to `last` into `cells` equal cells, and halves each cell up to `halvings` times
    /// where `is_coarse(start, end)` says so.
    pub fn halved(
        [first, last]: [f64; 2],
        cells: u32,
        halvings: u32,
        mut is_coarse: impl FnMut(f64, f64) -> bool,
    ) -> Self {
        let steps_each = 1 << halvings;
        let spacing = (last - first) / f64::from(cells * steps_each);
        let at = |step: u32| first + f64::from(step) * spacing;
        let mut steps = vec![0];
        for cell in 0..cells {
            let mut open = vec![[cell * steps_each, (cell + 1) * steps_each]];
            while let Some([start, end]) = open.pop() {
                if end - start > 1 && is_coarse(at(start), at(end)) {
                    let middle = start.midpoint(end);
                    open.push([middle, end]);
                    open.push([start, middle]);
                } else {
                    steps.push(end);
                }
            }
        }
        Self::new(first, spacing, steps)
    }

    /// An axis whose nodes are `steps` smallest spacings above `first`. The first of the rising steps is 0, and there
    /// are two or more.
    pub fn new(first: f64, spacing: f64, steps: Vec<u32>) -> Self {
        let (mut cells, mut spans) = (Vec::new(), Vec::new());
        for (cell, ends) in steps.windows(2).enumerate() {
            cells.resize(ends[1] as usize, cell as u16);
            spans.push(Span {
                start: f64::from(ends[0]),
                per_width: 1.0 / f64::from(ends[1] - ends[0]),
            });
        }
        cells.extend(cells.last().copied());
        Self {
            first,
            spacing,
            per_spacing: 1.0 / spacing,
            steps,
            cells,
            spans,
        }
    }

    /// The nodes as multiples of the smallest spacing.
    pub fn steps(&self) -> &[u32] {
        &self.steps
    }

    pub fn nodes(&self) -> usize {
        self.steps.len()
    }

    pub fn value(&self, node: usize) -> f64 {
        self.first + f64::from(self.steps[node]) * self.spacing
    }

    /// Number of smallest spacings in the whole axis.
    fn last_step(&self) -> u32 {
        self.steps.last().copied().unwrap_or_default()
    }

    /// The cell that holds a smallest spacing.
    #[inline(always)]
    fn cell_at(&self, step: usize) -> (usize, Span) {
        let cell = self.cells.get(step).map_or(0, |cell| usize::from(*cell));
        (cell, self.spans.get(cell).copied().unwrap_or_default())
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.steps[..]) + size_of_val(&self.cells[..]) + size_of_val(&self.spans[..])
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::Level;

    use crate::math::dispatch::dispatch;

    use super::*;

    #[test]
    fn cells_are_halved_where_asked_for() {
        let axis = Axis::halved([0.0, 4.0], 2, 2, |start, end| {
            start < 1.0 && end - start > 0.5
        });
        let nodes: Vec<f64> = (0..axis.nodes()).map(|node| axis.value(node)).collect();
        assert_eq!(nodes, [0.0, 0.5, 1.0, 2.0, 4.0]);
        let axes = Axes::new([axis.clone(), axis.clone(), axis]);
        let at = |value: f64| {
            let values = [value, 1.5, 1.5];
            let located = dispatch!(Level::new(), simd => axes.locate(simd, values));
            assert_eq!((located.cells[1], located.positions[2]), (2, 0.5));
            let per_unit = axes.per_unit(values, &located)[0];
            (
                located.cells[0],
                located.positions[0],
                per_unit,
                located.is_inside,
            )
        };
        assert_eq!(at(0.25), (0, 0.5, 2.0, true));
        assert_eq!(at(1.25), (2, 0.25, 1.0, true));
        assert_eq!(at(3.0), (3, 0.5, 0.5, true));
        assert_eq!(at(4.0), (3, 1.0, 0.5, true));
        assert_eq!(at(-1.0), (0, 0.0, 0.0, false));
        assert_eq!(at(9.0), (3, 1.0, 0.0, false));
        // On a node, either cell gives the same.
        assert!([(1, 1.0, 2.0, true), (2, 0.0, 1.0, true)].contains(&at(1.0)));
    }
}
