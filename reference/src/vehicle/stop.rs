//! A bump stop with a piecewise linear law.

use super::ranges::Ranges;

/// Ranges of a stop, and the line of each.
#[derive(Clone, Debug)]
pub(super) struct Stop {
    pub(super) ranges: Ranges,
    /// Line of each range: a displacement (m), the force there (N) and the slope (N/m).
    lines: Vec<[f64; 3]>,
}

impl Stop {
    /// Builds a stop from points (displacement, force) of one side.
    pub(super) fn new(points: &[[f64; 2]]) -> Self {
        let line = |pair: &[[f64; 2]]| {
            let slope = (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]);
            [pair[0][0], pair[0][1], slope]
        };
        let outward: Vec<[f64; 3]> = points.windows(2).map(line).collect();
        let edges = outward.iter().map(|[corner, ..]| *corner);
        let inward = outward.iter().rev();
        Self {
            ranges: Ranges {
                edges: edges.clone().rev().map(|edge| -edge).chain(edges).collect(),
            },
            lines: inward
                .map(|[corner, force, slope]| [-corner, -force, *slope])
                .chain([[0.0; 3]])
                .chain(outward.iter().copied())
                .collect(),
        }
    }

    /// Force that resists a displacement (N).
    pub(super) fn force(&self, range: usize, displacement: f64) -> f64 {
        let [corner, force, slope] = self.lines[range];
        force + slope * (displacement - corner)
    }

    pub(super) fn slope(&self, range: usize) -> f64 {
        self.lines[range][2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stop_is_odd_and_goes_through_its_points() {
        let stop = Stop::new(&[[0.02, 0.0], [0.03, 1e3], [0.04, 5e3]]);
        for (displacement, expected) in [
            (0.01, 0.0),
            (0.025, 500.0),
            (0.035, 3e3),
            (0.05, 9e3),
            (-0.035, -3e3),
        ] {
            let range = stop.ranges.settled(2, displacement);
            let force = stop.force(range, displacement);
            assert!((force - expected).abs() < 1e-9, "{displacement}: {force}");
        }
    }
}
