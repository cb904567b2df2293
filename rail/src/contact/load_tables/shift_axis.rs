//! The axis of the lateral shift: nodes as close as the contact asks for.

/// Nodes that rise by powers of two of one smallest spacing.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ShiftAxis {
    first_m: f64,
    spacing_m: f64,
    /// Number of smallest spacings up to each node.
    steps: Vec<u32>,
    /// The cell that holds each smallest spacing.
    cells: Vec<u16>,
}

impl ShiftAxis {
    /// Divides the range from `first_m` to `last_m` into `cells` equal cells, and halves each cell up to `halvings`
    /// times where `is_coarse(start, end)` says so.
    pub fn new(
        [first_m, last_m]: [f64; 2],
        cells: u32,
        halvings: u32,
        mut is_coarse: impl FnMut(f64, f64) -> bool,
    ) -> Self {
        let steps_each = 1 << halvings;
        let spacing_m = (last_m - first_m) / f64::from(cells * steps_each);
        let at = |step: u32| first_m + f64::from(step) * spacing_m;
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
        Self::from_steps(first_m, spacing_m, steps)
    }

    fn from_steps(first_m: f64, spacing_m: f64, steps: Vec<u32>) -> Self {
        let mut cells = Vec::new();
        for (cell, ends) in steps.windows(2).enumerate() {
            cells.resize(ends[1] as usize, cell as u16);
        }
        Self {
            first_m,
            spacing_m,
            steps,
            cells,
        }
    }

    pub fn nodes(&self) -> usize {
        self.steps.len()
    }

    pub fn value(&self, node: usize) -> f64 {
        self.first_m + f64::from(self.steps[node]) * self.spacing_m
    }

    /// The cell of a shift, the position in it, 0 to 1, and true if the axis covers the shift. A shift beyond an end is
    /// read at this end.
    #[inline]
    pub fn locate(&self, shift_m: f64) -> (usize, f64, bool) {
        let last = self.cells.len() as f64;
        let steps = (shift_m - self.first_m) / self.spacing_m;
        let inside = steps.clamp(0.0, last);
        let cell = usize::from(self.cells[(inside as usize).min(self.cells.len() - 1)]);
        let start = f64::from(self.steps[cell]);
        let width = f64::from(self.steps[cell + 1]) - start;
        (cell, (inside - start) / width, inside == steps)
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        4 * self.steps.len() + 2 * self.cells.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_halved_where_asked_for() {
        let axis = ShiftAxis::new([0.0, 4.0], 2, 2, |start, end| {
            start < 1.0 && end - start > 0.5
        });
        let nodes: Vec<f64> = (0..axis.nodes()).map(|node| axis.value(node)).collect();
        assert_eq!(nodes, [0.0, 0.5, 1.0, 2.0, 4.0]);
        assert_eq!(axis.locate(0.25), (0, 0.5, true));
        assert_eq!(axis.locate(1.0), (2, 0.0, true));
        assert_eq!(axis.locate(3.0), (3, 0.5, true));
        assert_eq!(axis.locate(4.0), (3, 1.0, true));
        assert_eq!(axis.locate(-1.0), (0, 0.0, false));
        assert_eq!(axis.locate(9.0), (3, 1.0, false));
    }
}
