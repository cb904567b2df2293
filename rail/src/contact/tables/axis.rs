//! The axes of the tables: nodes as close as the contact asks for.

/// Nodes that rise by multiples of one smallest spacing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    first: f64,
    spacing: f64,
    per_spacing: f64,
    /// Number of smallest spacings up to each node.
    steps: Vec<u32>,
    /// The cell that holds each smallest spacing.
    cells: Vec<u16>,
    /// Start of each cell, in smallest spacings, and the reciprocal of its width.
    spans: Vec<[f64; 2]>,
}

/// A value located on an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Located {
    pub cell: usize,
    /// Position in the cell, 0 to 1.
    pub position: f64,
    /// Derivative of the position with respect to the value; zero beyond the ends.
    pub per_unit: f64,
    /// True if the axis covers the value.
    pub is_inside: bool,
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
            spans.push([f64::from(ends[0]), 1.0 / f64::from(ends[1] - ends[0])]);
        }
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

    /// Locates a value. A value beyond an end is located at this end.
    #[inline(always)]
    pub fn locate(&self, value: f64) -> Located {
        let steps = (value - self.first) * self.per_spacing;
        let inside = steps.max(0.0).min(self.cells.len() as f64);
        let cell = usize::from(self.cells[(inside as usize).min(self.cells.len() - 1)]);
        let [start, per_width] = self.spans[cell];
        let is_inside = inside == steps;
        Located {
            cell,
            position: (inside - start) * per_width,
            per_unit: if is_inside {
                self.per_spacing * per_width
            } else {
                0.0
            },
            is_inside,
        }
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.steps[..]) + size_of_val(&self.cells[..]) + size_of_val(&self.spans[..])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_halved_where_asked_for() {
        let axis = Axis::halved([0.0, 4.0], 2, 2, |start, end| {
            start < 1.0 && end - start > 0.5
        });
        let nodes: Vec<f64> = (0..axis.nodes()).map(|node| axis.value(node)).collect();
        assert_eq!(nodes, [0.0, 0.5, 1.0, 2.0, 4.0]);
        let at = |value: f64| {
            let Located {
                cell,
                position,
                is_inside,
                ..
            } = axis.locate(value);
            (cell, position, is_inside)
        };
        assert_eq!(at(0.25), (0, 0.5, true));
        assert_eq!(at(1.0), (2, 0.0, true));
        assert_eq!(at(3.0), (3, 0.5, true));
        assert_eq!(at(4.0), (3, 1.0, true));
        assert_eq!(at(-1.0), (0, 0.0, false));
        assert_eq!(at(9.0), (3, 1.0, false));
        assert_eq!(
            [0.25, 3.0, 9.0].map(|value| axis.locate(value).per_unit),
            [2.0, 0.5, 0.0]
        );
    }
}
