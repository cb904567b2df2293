//! Makes the normal forces on the flange conserve energy.
//!
//! The elastic contact on strips gives the vertical force `V` well. Its lateral force follows from one normal for each
//! patch, as in the theory of half-spaces, and is not quite the gradient of the stored energy. On the flange the
//! difference pumps energy into the wheelset, which then bounces. So the lateral force of steep patches becomes the
//! gradient itself. Along the shift `y`, let `z` be the depth under a constant load and `E = integral of V dz` the
//! energy stored at this depth. Then the gradient at constant depth is `F = V dz/dy - dE/dy`.

use super::{LEVELS, ROOTS};
use crate::contact::elastic::ElasticPatch;
use crate::contact::zones::ZONES;

/// Minimum distance of the nodes between which depth and energy are differentiated, m. It exceeds the noise of the
/// depths, some tenths of a micrometre, by far.
const MIN_DISTANCE_M: f64 = 0.05e-3;
/// A depth of less than this below the first touch counts as this for the growth of the depth, m.
const MIN_APPROACH_M: f64 = 1e-6;
/// Slope at which a patch makes half of the turn.
const HALF_TURN_SLOPE: f64 = 0.4;
/// Maximum turn of a normal, rad, and the greatest angle to which a normal is turned: tan of it is 8.
const MAX_TURN_RAD: f64 = 0.2;
const MAX_ANGLE_RAD: f64 = 1.45;
/// Minimum growth of the depth from one load to the next, as a part of that in Hertz's contact.
const MIN_GROWTH: f64 = 0.05;

/// A node of a row: the contact under each load.
#[derive(Clone, Copy)]
pub(super) struct Solved {
    pub lateral_m: f64,
    /// Depth of the first touch, m.
    pub first_touch_m: f64,
    /// Depth and patches under each load.
    pub levels: [(f64, [ElasticPatch; ZONES]); LEVELS],
}

/// Vertical force of patches, N.
fn vertical_n(patches: &[ElasticPatch; ZONES]) -> f64 {
    patches
        .iter()
        .map(|patch| patch.load_n / libm::hypot(patch.slope, 1.0))
        .sum()
}

impl Solved {
    /// Energy stored under each load, J. As in the tables, the squared cube root of the load is linear between depths.
    fn energies_j(&self) -> [f64; LEVELS] {
        let mut energies = [0.0; LEVELS];
        let mut energy = 0.0;
        // Depth, squared cube root of the load, and vertical force per load at the level before.
        let mut before = (self.first_touch_m, 0.0_f64, None);
        for (level, (depth_m, patches)) in self.levels.iter().enumerate() {
            let square = ROOTS[level] * ROOTS[level];
            let part = vertical_n(patches) / libm::pow(square, 1.5);
            let (depth_before, square_before, part_before) = before;
            let mean_part = 0.5 * (part + part_before.unwrap_or(part));
            // The mean of the load, the integral of `square^1.5`.
            let mean_load = 0.4 * (libm::pow(square, 2.5) - libm::pow(square_before, 2.5))
                / (square - square_before);
            energy += (depth_m - depth_before) * mean_part * mean_load;
            energies[level] = energy;
            before = (*depth_m, square, Some(part));
        }
        energies
    }

    /// Changes each level by a few percent, as Hertz's contact would change with its load, so that the loads of the
    /// patches add up to the load of the level. Turning the normals changed the loads. The depths still rise with the
    /// loads.
    fn scale_to_loads(&mut self) {
        let mut least_m = self.first_touch_m;
        for (level, (depth_m, patches)) in self.levels.iter_mut().enumerate() {
            let sum_n: f64 = patches.iter().map(|patch| patch.load_n).sum();
            if sum_n <= 0.0 {
                continue;
            }
            let root = ROOTS[level] / libm::cbrt(sum_n);
            let scaled_m = self.first_touch_m + (*depth_m - self.first_touch_m) * root * root;
            *depth_m = scaled_m.max(least_m);
            let growth = ROOTS.get(level + 1).map_or(0.0, |next| {
                let ratio = next / ROOTS[level];
                ratio * ratio - 1.0
            });
            least_m = *depth_m
                + MIN_GROWTH * growth * (*depth_m - self.first_touch_m).max(MIN_APPROACH_M);
            for patch in patches {
                patch.load_n *= root * root * root;
                patch.whole_load_n *= root * root * root;
                patch.semi_axes_m = patch.semi_axes_m.map(|semi_axis| semi_axis * root);
                patch.peak_pressure_pa *= root;
            }
        }
    }
}

/// Derivative at the middle one of three positions.
fn derivative(positions: [f64; 3], values: [f64; 3]) -> f64 {
    let (before, after) = (positions[1] - positions[0], positions[2] - positions[1]);
    let (slope_before, slope_after) = (
        (values[1] - values[0]) / before,
        (values[2] - values[1]) / after,
    );
    (slope_before * after + slope_after * before) / (before + after)
}

/// Turns the normals of the patches of each node so that the lateral force is the gradient of the energy, and moves the
/// depths so that the loads of all patches together are that of the level.
pub(super) fn conserve_energy(row: &mut [Option<Solved>]) {
    let energies: Vec<[f64; LEVELS]> = row
        .iter()
        .map(|node| node.map_or([0.0; LEVELS], |node| node.energies_j()))
        .collect();
    let corrected: Vec<Option<Solved>> = (0..row.len())
        .map(|at| corrected(row, &energies, at))
        .collect();
    row.copy_from_slice(&corrected);
}

/// The node at the place `at` with turned normals; unchanged where a neighbour is beside the rail.
fn corrected(row: &[Option<Solved>], energies: &[[f64; LEVELS]], at: usize) -> Option<Solved> {
    let node = row[at]?;
    let distant = |step: isize| {
        let mut other = at;
        loop {
            other = other.checked_add_signed(step)?;
            let neighbour = row.get(other)?.as_ref()?;
            if (neighbour.lateral_m - node.lateral_m).abs() > MIN_DISTANCE_M {
                return Some((other, neighbour));
            }
        }
    };
    let (Some((k, before)), Some((l, after))) = (distant(-1), distant(1)) else {
        let mut scaled = node;
        scaled.scale_to_loads();
        return Some(scaled);
    };
    let positions = [before.lateral_m, node.lateral_m, after.lateral_m];
    let mut turned = node;
    for (level, (_, patches)) in turned.levels.iter_mut().enumerate() {
        let depths = [before, &node, after].map(|node| node.levels[level].0);
        let stored = [k, at, l].map(|node| energies[node][level]);
        let gradient =
            vertical_n(patches) * derivative(positions, depths) - derivative(positions, stored);
        turn(patches, gradient);
    }
    turned.scale_to_loads();
    Some(turned)
}

/// Turns the normals by one angle so that the lateral force becomes `lateral_n`, at the same vertical force of each
/// patch. Flat patches, for which half-spaces are a good theory, turn by less.
fn turn(patches: &mut [ElasticPatch; ZONES], lateral_n: f64) {
    let (mut missing, mut by_angle) = (lateral_n, 0.0);
    for patch in patches.iter() {
        let vertical = patch.load_n / libm::hypot(patch.slope, 1.0);
        missing -= vertical * patch.slope;
        by_angle += vertical * (1.0 + patch.slope * patch.slope);
    }
    if by_angle <= 0.0 {
        return;
    }
    let angle = (missing / by_angle).clamp(-MAX_TURN_RAD, MAX_TURN_RAD);
    for patch in patches.iter_mut() {
        let steepness = (patch.slope / HALF_TURN_SLOPE).powi(4);
        let before = libm::atan(patch.slope);
        let limit = before.abs().max(MAX_ANGLE_RAD);
        let turned = before + angle * steepness / (1.0 + steepness);
        let slope = libm::tan(turned.clamp(-limit, limit));
        let factor = libm::hypot(slope, 1.0) / libm::hypot(patch.slope, 1.0);
        patch.load_n *= factor;
        patch.whole_load_n *= factor;
        patch.slope = slope;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A flange of 81 degrees.
    const STEEP: f64 = 6.3;

    fn patches(load_n: f64) -> [ElasticPatch; ZONES] {
        let mut patches = [ElasticPatch::default(); ZONES];
        patches[0].load_n = load_n;
        patches[0].slope = STEEP;
        patches
    }

    #[test]
    fn no_normal_turns_over() {
        for lateral_n in [-1e6, 0.0, 1e4, 1e5, 1e6] {
            let mut turned = patches(100e3);
            let vertical = vertical_n(&turned);
            turn(&mut turned, lateral_n);
            let slope = turned[0].slope;
            assert!((1.0..8.3).contains(&slope), "{lateral_n}: {slope}");
            assert!((vertical_n(&turned) / vertical - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn depths_rise_with_the_loads() {
        let load_n = |level: usize| ROOTS[level].powi(3);
        let mut node = Solved {
            lateral_m: 0.0,
            first_touch_m: -1e-3,
            levels: std::array::from_fn(|level| {
                let depth_m = -1e-3 + 1e-7 * ROOTS[level].powi(2);
                // Every other level has lost much of its load.
                let part = if level % 2 == 0 { 1.0 } else { 0.4 };
                (depth_m, patches(part * load_n(level)))
            }),
        };
        node.scale_to_loads();
        let mut before_m = node.first_touch_m;
        for (level, (depth_m, patches)) in node.levels.iter().enumerate() {
            assert!(*depth_m > before_m, "{level}");
            assert!((patches[0].load_n / load_n(level) - 1.0).abs() < 1e-12);
            before_m = *depth_m;
        }
    }
}
