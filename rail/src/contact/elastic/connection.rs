//! Which strips belong to one patch: a matter of degree, so that patches merge and part smoothly.

/// Neighbouring strips with a height each, such as their loads.
#[derive(Debug, Clone, Copy)]
pub(super) struct Connection<'a> {
    /// Numbers of the strips, rising; strips with a gap between their numbers are not connected.
    pub strips: &'a [usize],
    pub heights: &'a [f64],
    /// Lowest valley between two summits that does not begin to divide them, and the valley that divides them fully,
    /// both as fractions of the lower summit.
    pub valleys: [f64; 2],
}

impl Connection<'_> {
    /// True if every strip is fully connected with every other.
    pub fn is_one_patch(&self) -> bool {
        let count = self.strips.len();
        if count == 0 || self.strips[count - 1] - self.strips[0] + 1 != count {
            return false;
        }
        // On the way to the highest strip, the lower summit beside a valley is the highest one passed so far.
        let highest = (0..count).max_by(|&i, &j| self.heights[i].total_cmp(&self.heights[j]));
        let highest = highest.unwrap_or(0);
        self.rises(0..=highest) && self.rises((highest..count).rev())
    }

    /// True if no valley divides the entries on the `way` to the highest one.
    fn rises(&self, mut way: impl Iterator<Item = usize>) -> bool {
        let (mut summit, mut valley) = (f64::NEG_INFINITY, f64::INFINITY);
        way.all(|k| {
            let height = self.heights[k];
            if height >= summit {
                (summit, valley) = (height, f64::INFINITY);
            }
            valley = valley.min(height);
            valley >= self.valleys[0] * summit
        })
    }

    /// Calls `visit` with every entry that is connected with entry `k`, and the degree of their connection: a smooth
    /// step of the lowest height between them. Without a valley it is 1.
    pub fn each(&self, k: usize, mut visit: impl FnMut(usize, f64)) {
        visit(k, 1.0);
        self.towards(k, k + 1..self.strips.len(), &mut visit);
        self.towards(k, (0..k).rev(), &mut visit);
    }

    fn towards(
        &self,
        k: usize,
        others: impl Iterator<Item = usize>,
        visit: &mut impl FnMut(usize, f64),
    ) {
        let [full, none] = self.valleys;
        let own = self.heights[k];
        let (mut valley, mut last) = (own, k);
        for other in others {
            let height = self.heights[other];
            valley = valley.min(height);
            if self.strips[other].abs_diff(self.strips[last]) > 1 || valley <= none * own {
                break;
            }
            let part = (valley / own.min(height) - none) / (full - none);
            if height > 0.0 && part > 0.0 {
                let part = part.min(1.0);
                visit(other, part * part * (3.0 - 2.0 * part));
            }
            last = other;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(heights: &[f64], k: usize) -> Vec<f64> {
        let strips: Vec<usize> = (0..heights.len()).collect();
        let connection = Connection {
            strips: &strips,
            heights,
            valleys: [0.5, 0.0],
        };
        let mut degrees = vec![0.0; heights.len()];
        connection.each(k, |other, degree| degrees[other] = degree);
        let one = (0..heights.len()).all(|k| {
            let mut full = 0;
            connection.each(k, |_, degree| full += usize::from(degree == 1.0));
            full == heights.len()
        });
        assert_eq!(connection.is_one_patch(), one, "{heights:?}");
        degrees
    }

    #[test]
    fn one_hill_is_one_patch() {
        assert_eq!(degrees(&[1.0, 2.0, 3.0, 2.0, 0.1], 0), [1.0; 5]);
        assert_eq!(degrees(&[3.0, 2.0, 1.0], 2), [1.0; 3]);
    }

    #[test]
    fn a_valley_divides_two_hills_by_its_depth() {
        assert_eq!(degrees(&[2.0, 1.0, 2.0], 0), [1.0; 3]);
        assert_eq!(degrees(&[2.0, 0.5, 2.0], 0), [1.0, 1.0, 0.5]);
        assert_eq!(degrees(&[2.0, 0.0, 2.0], 0), [1.0, 0.0, 0.0]);
        // A strip low on the other hill is above the valley's water, but no lower than the valley.
        assert_eq!(degrees(&[2.0, 0.5, 4.0, 0.5], 3), [1.0, 1.0, 1.0, 1.0]);
    }

    #[test]
    fn a_missing_strip_divides() {
        let connection = Connection {
            strips: &[3, 4, 6],
            heights: &[1.0; 3],
            valleys: [0.5, 0.0],
        };
        let mut seen = Vec::new();
        connection.each(0, |other, degree| seen.push((other, degree)));
        assert_eq!(seen, [(0, 1.0), (1, 1.0)]);
        assert!(!connection.is_one_patch());
    }

    #[test]
    fn random_hills_are_one_patch_if_every_degree_is_full() {
        let mut state = 1_u64;
        for _ in 0..2000 {
            let heights: Vec<f64> = (0..6)
                .map(|_| {
                    state = state
                        .wrapping_mul(6_364_136_223_846_793_005)
                        .wrapping_add(1);
                    0.01 + (state >> 40) as f64 / (1_u64 << 24) as f64
                })
                .collect();
            degrees(&heights, 0);
        }
    }
}
