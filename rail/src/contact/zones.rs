//! Division of a wheel into zones with at most one contact patch each, along the valleys between summits.

use super::pair::Pair;
use super::silhouette::SilhouettePoint;

/// Number of zones of a wheel: the flange, and three on the tread and its root.
pub const ZONES: usize = 4;
/// Number of cuts within the tread; the boundary between flange and tread is a property of the wheel.
const CUTS: usize = ZONES - 2;

/// Lateral shifts at which the cuts are determined, m: first shift, spacing and number. Beyond these shifts, the cuts
/// are constant.
const FIRST_SHIFT_M: f64 = -0.025;
const SHIFT_STEP_M: f64 = 0.2e-3;
const SHIFTS: usize = 476;
/// Roll angles considered, rad; the roll changes which summits are near contact at a given shift.
const ROLLS_RAD: [f64; 3] = [-6e-3, 0.0, 6e-3];
/// Spacing of the possible positions of a cut on the wheel, m.
const POSITION_STEP_M: f64 = 0.5e-3;
/// Maximum movement of a cut from one shift to the next, in positions.
const REACH: usize = 4;
/// Cost of a movement by one position, m.
const MOVEMENT_COST_M: f64 = 0.5e-6;

/// Depth of a valley that fully separates two summits under usual loads, m.
const VALLEY_M: f64 = 60e-6;
/// Height below the maximum interpenetration at which a summit no longer matters, m: twice a large penetration.
const RELEVANT_M: f64 = 0.4e-3;
/// Height over which the penalty for cutting a loaded summit falls to 1/e, m.
const AVOIDED_M: f64 = 25e-6;

/// The cuts between the zones of a wheel, as functions of the lateral shift.
///
/// Neighbouring zones without a valley between them share one patch, so there the position of a cut does not matter. A
/// cut only has to follow a valley if there is one, and to move continuously, so that neighbouring nodes of the tables
/// have the same zones.
#[derive(Debug, Clone)]
pub struct Zones {
    flange_end: f64,
    cuts: Vec<[f64; CUTS]>,
}

impl Zones {
    /// Determines the cuts of `pair` by dynamic programming. Each cut is the path over the shift that follows the
    /// deepest valleys with the least movement; the second cut takes the first into account.
    pub fn new(pair: &Pair) -> Self {
        let landscape = Landscape::new(pair);
        let flange_end = pair.tread_end_m();
        if landscape.positions.len() < 2 {
            let cuts = vec![[flange_end; CUTS]; SHIFTS];
            return Self { flange_end, cuts };
        }
        let mut paths: Vec<Vec<usize>> = Vec::new();
        for _ in 0..CUTS {
            paths.push(landscape.best_path(&paths));
        }
        let cuts = (0..SHIFTS)
            .map(|row| {
                let mut cuts: [f64; CUTS] =
                    std::array::from_fn(|k| landscape.positions[paths[k][row]]);
                cuts.sort_by(f64::total_cmp);
                cuts
            })
            .collect();
        Self { flange_end, cuts }
    }

    /// Field-side ends of the zones at a lateral shift, m from the tread datum, from the flange outwards. The last zone
    /// extends to the end of the wheel.
    pub fn ends_m(&self, lateral_m: f64) -> [f64; ZONES - 1] {
        let row = ((lateral_m - FIRST_SHIFT_M) / SHIFT_STEP_M).clamp(0.0, (SHIFTS - 1) as f64);
        let first = (row as usize).min(SHIFTS - 2);
        let t = row - first as f64;
        let (from, to) = (self.cuts[first], self.cuts[first + 1]);
        let cut = |k: usize| from[k] + t * (to[k] - from[k]);
        [self.flange_end, cut(0), cut(1)]
    }
}

/// Interpenetration of the tread as a function of the position on the wheel, for each shift and roll.
struct Landscape {
    positions: Vec<f64>,
    /// Indexed by shift, roll and position.
    heights: Vec<[Vec<f64>; ROLLS_RAD.len()]>,
}

impl Landscape {
    fn new(pair: &Pair) -> Self {
        let points = pair.wheel().points();
        let (first, last) = (pair.tread_end_m(), points[points.len() - 1].y_m);
        let count = ((last - first) / POSITION_STEP_M).max(0.0) as usize;
        let positions: Vec<f64> = (1..count)
            .map(|i| first + i as f64 * POSITION_STEP_M)
            .collect();
        let mut scratch = Vec::new();
        let wheels = ROLLS_RAD.map(|roll_rad| pair.turned(roll_rad, 0.0));
        let heights = (0..SHIFTS)
            .map(|row| {
                let lateral_m = FIRST_SHIFT_M + row as f64 * SHIFT_STEP_M;
                [0, 1, 2].map(|roll| {
                    wheels[roll].silhouette(lateral_m, &mut scratch);
                    heights_at(&positions, &scratch, pair)
                })
            })
            .collect();
        Self { positions, heights }
    }

    /// Finds the path with the maximum total reward, given that the wheel is already cut along `paths`.
    fn best_path(&self, paths: &[Vec<usize>]) -> Vec<usize> {
        let count = self.positions.len();
        let mut total = vec![0.0; count];
        let mut from: Vec<Vec<u8>> = Vec::with_capacity(SHIFTS);
        for row in 0..SHIFTS {
            let cuts: Vec<usize> = paths.iter().map(|path| path[row]).collect();
            let reward = self.reward(row, &cuts);
            let mut next = vec![f64::MIN; count];
            let mut origins = vec![0; count];
            for (i, (next, origin)) in next.iter_mut().zip(&mut origins).enumerate() {
                for movement in 0..=2 * REACH {
                    let Some(j) = (i + movement).checked_sub(REACH).filter(|&j| j < count) else {
                        continue;
                    };
                    let distance = movement.abs_diff(REACH) as f64;
                    let value = total[j] - MOVEMENT_COST_M * distance * distance;
                    if value > *next {
                        (*next, *origin) = (value, movement as u8);
                    }
                }
                *next += reward[i];
            }
            total = next;
            from.push(origins);
        }
        let mut position = (0..count)
            .max_by(|&i, &j| total[i].total_cmp(&total[j]))
            .unwrap_or(0);
        let mut path = vec![position; SHIFTS];
        for row in (1..SHIFTS).rev() {
            position = position + usize::from(from[row][position]) - REACH;
            path[row - 1] = position;
        }
        path
    }

    /// Reward of a cut at each position for one shift, m: the depth of the valley between two relevant summits, minus a
    /// penalty for cutting a loaded summit.
    fn reward(&self, row: usize, cuts: &[usize]) -> Vec<f64> {
        let mut reward = vec![0.0; self.positions.len()];
        for heights in &self.heights[row] {
            let top = heights.iter().copied().fold(f64::MIN, f64::max);
            let mut ends = cuts.to_vec();
            ends.extend([0, heights.len()]);
            ends.sort_unstable();
            for zone in ends.windows(2) {
                let zone = zone[0]..zone[1];
                let mut after = vec![f64::MIN; zone.len() + 1];
                for i in (0..zone.len()).rev() {
                    after[i] = after[i + 1].max(heights[zone.start + i]);
                }
                let mut before = f64::MIN;
                for (i, position) in zone.enumerate() {
                    let height = heights[position];
                    before = before.max(height);
                    let lower = before.min(after[i]);
                    let relevance = (1.0 - (top - lower) / RELEVANT_M).max(0.0);
                    let valley = (lower - height).min(VALLEY_M) * relevance;
                    let penalty = VALLEY_M * libm::exp((height - top) / AVOIDED_M);
                    reward[position] += valley - penalty;
                }
            }
        }
        reward
    }
}

/// Interpenetration at each of the rising `positions` on the wheel, m; -1, far out of contact, where there is no rail.
fn heights_at(positions: &[f64], silhouette: &[SilhouettePoint], pair: &Pair) -> Vec<f64> {
    let on_wheel = |point: &SilhouettePoint| pair.wheel().points()[point.index].y_m;
    let mut i = 0;
    positions
        .iter()
        .map(|&position| {
            while i + 1 < silhouette.len() && on_wheel(&silhouette[i + 1]) <= position {
                i += 1;
            }
            match silhouette.get(i..i + 2) {
                Some([p, q]) if on_wheel(p) <= position => {
                    let t = (position - on_wheel(p)) / (on_wheel(q) - on_wheel(p));
                    p.interpenetration_m + t * (q.interpenetration_m - p.interpenetration_m)
                }
                _ => -1.0,
            }
        })
        .collect()
}
