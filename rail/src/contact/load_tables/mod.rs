//! Elastic contact of one pair of profiles, precomputed over lateral shift, roll, yaw and load.
//!
//! A node has the depth of the wheel under each of several loads, and the patches at each. A wheel at a known depth
//! carries the load between the two depths that enclose its own, so one set of tables serves every load.

mod build;
mod record;
mod shift_axis;

pub use record::LoadedPatch;
use record::{FIELDS, Record, unpack};
use shift_axis::ShiftAxis;

use super::geometry::ContactGeometry;
use super::silhouette::WheelPose;
use super::zones::ZONES;

/// Normal loads of a wheel at which the contact is computed, N.
pub const LEVELS_N: [f64; LEVELS] = [5e3, 15e3, 35e3, 70e3, 120e3, 200e3, 400e3];
/// Number of loads.
pub const LEVELS: usize = 7;

/// Loads to the power 2/3, to which penetrations are nearly proportional; the first is no load.
const POWERS: usize = LEVELS + 1;

/// The tables of one pair of profiles.
#[derive(Debug, Clone)]
pub struct LoadTables {
    geometry: ContactGeometry,
    shifts: ShiftAxis,
    /// Rolls, rad, and squared yaws, rad^2.
    rolls: Vec<f64>,
    yaws_squared: Vec<f64>,
    /// Depths, m, at no load and at each of [`LEVELS_N`], for each node. The shift varies fastest, then the roll.
    depths: Vec<[f32; POWERS]>,
    /// Number of the first record of each node, and the zones that have patches as a bit mask in the low byte.
    starts: Vec<u32>,
    /// For each zone of a node, the records at all loads.
    records: Vec<[Record; LEVELS]>,
}

/// A wheel as read from the tables.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LoadedWheel {
    /// Normal load of all patches, N.
    pub load_n: f64,
    /// The patch of each zone.
    pub patches: [Option<LoadedPatch>; ZONES],
    /// True if the tables cover the pose.
    pub is_inside: bool,
}

impl LoadTables {
    /// The geometry that the tables were computed from.
    pub fn geometry(&self) -> &ContactGeometry {
        &self.geometry
    }

    /// Bytes in memory, without the geometry.
    pub fn bytes(&self) -> usize {
        self.shifts.bytes()
            + size_of_val(&self.depths[..])
            + size_of_val(&self.starts[..])
            + size_of_val(&self.records[..])
    }

    /// Number of nodes along shift, roll and yaw.
    pub fn nodes(&self) -> [usize; 3] {
        [
            self.shifts.nodes(),
            self.rolls.len(),
            self.yaws_squared.len(),
        ]
    }

    /// Interpolates the contact of a wheel whose tread datum is `depth_m` below the top of the rail.
    pub fn at(&self, pose: &WheelPose, depth_m: f64) -> LoadedWheel {
        let yaw_squared = pose.yaw_rad * pose.yaw_rad;
        let shift = pose.lateral_m + build::yaw_shift_m(&self.geometry) * yaw_squared;
        let (cell, s, shift_inside) = self.shifts.locate(shift);
        let (roll, r, roll_inside) = locate(&self.rolls, pose.roll_rad);
        let (yaw, y, yaw_inside) = locate(&self.yaws_squared, yaw_squared);
        let (shifts, rolls) = (self.shifts.nodes(), self.rolls.len());
        let corners: [(usize, f64); 8] = std::array::from_fn(|corner| {
            let at = |bit: usize, position: f64| {
                if corner >> bit & 1 == 0 {
                    (0, 1.0 - position)
                } else {
                    (1, position)
                }
            };
            let [(i, a), (j, b), (k, c)] = [at(0, s), at(1, r), at(2, y)];
            (
                cell + i + shifts * (roll + j + rolls * (yaw + k)),
                a * b * c,
            )
        });
        let mut depths = [0.0; POWERS];
        for (node, weight) in corners {
            for (sum, depth) in depths.iter_mut().zip(&self.depths[node]) {
                *sum += weight * f64::from(*depth);
            }
        }
        let mut wheel = LoadedWheel {
            load_n: 0.0,
            patches: [None; ZONES],
            is_inside: shift_inside && roll_inside && yaw_inside,
        };
        if depth_m <= depths[0] {
            return wheel;
        }
        let level = depths[1..LEVELS].partition_point(|depth| *depth < depth_m);
        let t = (depth_m - depths[level]) / (depths[level + 1] - depths[level]);
        let power = |level: usize| {
            level
                .checked_sub(1)
                .map_or(0.0, |k| LEVELS_N[k].powf(2.0 / 3.0))
        };
        let between = power(level) + t * (power(level + 1) - power(level));
        wheel.load_n = between.powf(1.5);
        // Below the lowest load, the patches are those at the lowest load; above the highest, those at the highest.
        let u = if level == 0 { 0.0 } else { t.min(1.0) };
        let records = [level.saturating_sub(1), level];
        for zone in 0..ZONES {
            let mut sums = [0.0; FIELDS];
            for (node, weight) in corners {
                let Some(at) = self.record(node, zone) else {
                    continue;
                };
                let [low, high] = records.map(|level| self.records[at][level]);
                for (k, sum) in sums.iter_mut().enumerate() {
                    *sum += weight * ((1.0 - u) * f64::from(low[k]) + u * f64::from(high[k]));
                }
            }
            wheel.patches[zone] = unpack(&sums);
        }
        wheel
    }

    /// Number of the records of a zone of a node.
    fn record(&self, node: usize, zone: usize) -> Option<usize> {
        let start = self.starts[node];
        let bit = 1 << zone;
        let before = (start & (bit - 1)).count_ones();
        (start & bit != 0).then_some((start >> ZONES) as usize + before as usize)
    }
}

/// The cell of `value` between rising nodes, the position in it, and true if it lies between the first and the last.
fn locate(nodes: &[f64], value: f64) -> (usize, f64, bool) {
    let last = nodes.len() - 1;
    let inside = value.clamp(nodes[0], nodes[last]);
    let cell = nodes[1..last].partition_point(|node| *node <= inside);
    let position = (inside - nodes[cell]) / (nodes[cell + 1] - nodes[cell]);
    (cell, position, inside == value)
}
