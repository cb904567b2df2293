//! The ranges between the edges of a law: within one the law is smooth, and the solver stops where it is left.

/// Overlap of neighbouring ranges (m), so that a motion that has just entered a range is well within it. Its force, at a
/// stiffness of 1e9 N/m, is 10 mN.
pub(super) const OVERLAP_M: f64 = 1e-11;

/// Rising edges; range `i` is below edge `i`, the last one above all.
#[derive(Clone, Debug)]
pub(super) struct Ranges {
    pub(super) edges: Vec<f64>,
}

impl Ranges {
    /// Distances to the lower and the upper end of a range, positive within.
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

    /// The range of `x`, which was in `range` before.
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
    fn what_has_left_a_range_is_well_within_the_next() {
        let ranges = Ranges {
            edges: vec![-1e-3, -1e-3, 1e-3],
        };
        let past = 1e-3 + OVERLAP_M;
        assert_eq!(ranges.settled(2, past), 3);
        assert!(ranges.margins(3, past)[0] > OVERLAP_M);
        assert_eq!(ranges.settled(3, 1e-3), 3);
        assert_eq!(ranges.settled(3, 1e-3 - OVERLAP_M), 2);
        // an empty range is passed
        assert_eq!(ranges.settled(2, -1e-3 - OVERLAP_M), 0);
        assert_eq!(ranges.settled(0, -1e-3 + OVERLAP_M), 2);
    }
}
