//! Ranges between the edges of a law. The law is smooth within a range; the solver restarts at its ends.

/// Overlap of neighbouring ranges (m), so that a motion that has just entered a range is well within it. At a stiffness
/// of 1e9 N/m it corresponds to 10 mN.
pub(super) const OVERLAP_M: f64 = 1e-11;

/// Edges of a law, in increasing order. Range `i` is below edge `i`; the last range is above all edges.
#[derive(Clone, Debug)]
pub(super) struct Ranges {
    pub(super) edges: Vec<f64>,
}

impl Ranges {
    /// Distances to the lower and the upper end of a range, positive inside.
    pub(super) fn margins(&self, range: usize, x: f64) -> [f64; 2] {
        let below = range
            .checked_sub(1)
            .map_or(1.0, |edge| x - self.edges[edge] + OVERLAP_M);
        let above = self
            .edges
            .get(range)
            .map_or(1.0, |edge| edge + OVERLAP_M - x);
        [below, above]
    }

    /// Returns the new range of a motion at `x` that was in `range`.
    pub(super) fn settled(&self, range: usize, x: f64) -> usize {
        let mut settled = range;
        while settled < self.edges.len() && self.margins(settled, x)[1] < 0.5 * OVERLAP_M {
            settled += 1;
        }
        while settled > 0 && self.margins(settled, x)[0] < 0.5 * OVERLAP_M {
            settled -= 1;
        }
        settled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_that_leaves_a_range_is_well_within_the_next() {
        let ranges = Ranges {
            edges: vec![-1e-3, -1e-3, 1e-3],
        };
        let past = 1e-3 + OVERLAP_M;
        assert_eq!(ranges.settled(2, past), 3);
        assert!(ranges.margins(3, past)[0] > OVERLAP_M);
        assert_eq!(ranges.settled(3, 1e-3), 3);
        assert_eq!(ranges.settled(3, 1e-3 - OVERLAP_M), 2);
        // An empty range is skipped.
        assert_eq!(ranges.settled(2, -1e-3 - OVERLAP_M), 0);
        assert_eq!(ranges.settled(0, -1e-3 + OVERLAP_M), 2);
    }
}
