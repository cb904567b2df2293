//! Computes the nodes of load tables.

use super::record::{Record, pack};
use super::shift_axis::ShiftAxis;
use super::{LEVELS, LEVELS_N, LoadTables, POWERS};
use crate::contact::elastic::{ElasticPatch, Fineness, Given, NormalContact, TurnedStrips};
use crate::contact::geometry::ContactGeometry;
use crate::contact::zones::ZONES;

/// Range of the lateral shift, m: from a wheel towards the track centre to a flange past the rail's top.
const SHIFTS_M: [f64; 2] = [-0.020, 0.065];
/// Number of cells before they are halved, and how often.
const SHIFT_CELLS: u32 = 85;
const HALVINGS: u32 = 6;
/// Rolls, rad.
const ROLLS_RAD: [f64; 17] = [
    -24e-3, -18e-3, -12e-3, -10e-3, -8e-3, -6e-3, -4e-3, -2e-3, 0.0, 2e-3, 4e-3, 6e-3, 8e-3, 10e-3,
    12e-3, 18e-3, 24e-3,
];
/// Squared yaws, rad^2.
const YAWS_SQUARED: [f64; 6] = [0.0, 1.0e-4, 2.5e-4, 5e-4, 9e-4, 25e-4];
/// Strips for each load.
const FINENESS: [Fineness; LEVELS] = [
    Fineness::Fine,
    Fineness::Fine,
    Fineness::Medium,
    Fineness::Medium,
    Fineness::Coarse,
    Fineness::Coarse,
    Fineness::Coarse,
];

/// Error of the interpolated depth, m, above which a cell of the shift is halved, and loads and rolls at which it is
/// computed.
const DEPTH_ERROR_M: f64 = 2e-6;
/// The same for the lateral force, as a fraction of the load.
const FORCE_ERROR: f64 = 0.02;
const PROBED_LEVELS: [usize; 2] = [1, 4];
const PROBED_ROLLS_RAD: [f64; 3] = [-6e-3, 0.0, 6e-3];
/// Slope of the part of the flange for which the tables correct the effect of the yaw.
const FLANGE_SLOPE: f64 = 1.8;

/// Shift of the contact on the flange per squared yaw, m/rad^2. The yaw moves the silhouette outwards by
/// `r slope yaw^2`; shifting the nodes by as much keeps the flange at the same node.
pub(super) fn yaw_shift_m(geometry: &ContactGeometry) -> f64 {
    FLANGE_SLOPE * geometry.pair().installation().wheel_radius_m
}

/// A turned wheel divided into fine, medium and coarse strips, and its last solutions.
struct Row<'a> {
    geometry: &'a ContactGeometry,
    wheels: [TurnedStrips<'a>; 3],
    contacts: [NormalContact; LEVELS],
}

impl<'a> Row<'a> {
    fn new(geometry: &'a ContactGeometry, roll_rad: f64, yaw_rad: f64) -> Self {
        let strips = |fineness| TurnedStrips::new(geometry.pair(), roll_rad, yaw_rad, fineness);
        Self {
            geometry,
            wheels: [Fineness::Fine, Fineness::Medium, Fineness::Coarse].map(strips),
            contacts: std::array::from_fn(|_| NormalContact::default()),
        }
    }

    /// Depth and patches under a load.
    fn solve(&mut self, lateral_m: f64, level: usize) -> (f64, [ElasticPatch; ZONES]) {
        let wheel = &self.wheels[FINENESS[level] as usize];
        let contact = &mut self.contacts[level];
        let given = Given::LoadN(LEVELS_N[level]);
        let patches = self
            .geometry
            .elastic_patches(wheel, lateral_m, given, contact);
        (contact.depth_m, patches)
    }
}

/// The nodes of some rows.
#[derive(Default)]
struct Nodes {
    depths: Vec<[f32; POWERS]>,
    masks: Vec<u32>,
    records: Vec<[Record; LEVELS]>,
}

impl LoadTables {
    /// Computes the tables of a pair on all cores.
    pub fn new(geometry: ContactGeometry) -> Self {
        let shifts = shift_axis(&geometry);
        let turns: Vec<[f64; 2]> = YAWS_SQUARED
            .iter()
            .flat_map(|yaw_squared| ROLLS_RAD.map(|roll| [roll, *yaw_squared]))
            .collect();
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let rows_each = turns.len().div_ceil(threads);
        let nodes = std::thread::scope(|scope| {
            let compute = |turns: &'_ [[f64; 2]]| {
                let mut nodes = Nodes::default();
                for [roll_rad, yaw_squared] in turns {
                    nodes.add_row(&geometry, &shifts, *roll_rad, *yaw_squared);
                }
                nodes
            };
            let parts: Vec<_> = turns
                .chunks(rows_each)
                .map(|turns| scope.spawn(move || compute(turns)))
                .collect();
            let mut all = Nodes::default();
            for part in parts {
                match part.join() {
                    Ok(nodes) => all.append(nodes),
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
            all
        });
        let mut start = 0;
        let starts = nodes.masks.iter().map(|mask| {
            let at = start << ZONES | mask;
            start += mask.count_ones();
            at
        });
        Self {
            starts: starts.collect(),
            shifts,
            rolls: ROLLS_RAD.to_vec(),
            yaws_squared: YAWS_SQUARED.to_vec(),
            depths: nodes.depths,
            records: nodes.records,
            geometry,
        }
    }
}

impl Nodes {
    fn add_row(
        &mut self,
        geometry: &ContactGeometry,
        shifts: &ShiftAxis,
        roll: f64,
        yaw_squared: f64,
    ) {
        let mut row = Row::new(geometry, roll, yaw_squared.sqrt());
        for node in 0..shifts.nodes() {
            let lateral_m = shifts.value(node) - yaw_shift_m(geometry) * yaw_squared;
            let mut depths = [0.0; POWERS];
            let mut records = [[Record::default(); LEVELS]; ZONES];
            for level in 0..LEVELS {
                let (depth_m, patches) = row.solve(lateral_m, level);
                depths[level + 1] = depth_m;
                for (zone, patch) in patches.iter().enumerate() {
                    records[zone][level] = pack(patch, LEVELS_N[level]);
                }
            }
            // Continues the lowest loads to no load, with a penetration proportional to the load to the power 2/3.
            let [low, high] = [LEVELS_N[0], LEVELS_N[1]].map(|load: f64| load.powf(2.0 / 3.0));
            depths[0] = depths[1] - (depths[2] - depths[1]) * low / (high - low);
            let mut mask = 0;
            for (zone, records) in records.into_iter().enumerate() {
                if records.iter().any(|record| record[0] > 0) {
                    mask |= 1 << zone;
                    self.records.push(records);
                }
            }
            self.masks.push(mask);
            self.depths.push(depths.map(|depth| depth as f32));
        }
    }

    fn append(&mut self, other: Self) {
        self.depths.extend(other.depths);
        self.masks.extend(other.masks);
        self.records.extend(other.records);
    }
}

/// Places the nodes of the shift where the depth and the lateral force are not straight between them.
fn shift_axis(geometry: &ContactGeometry) -> ShiftAxis {
    let mut rows = PROBED_ROLLS_RAD.map(|roll_rad| Row::new(geometry, roll_rad, 0.0));
    ShiftAxis::new(SHIFTS_M, SHIFT_CELLS, HALVINGS, |start, end| {
        rows.iter_mut().any(|row| {
            PROBED_LEVELS.iter().any(|level| {
                let [before, middle, after] =
                    [start, 0.5 * (start + end), end].map(|at| depth_and_force(row, at, *level));
                (0..2).any(|k| {
                    let allowed = [DEPTH_ERROR_M, FORCE_ERROR][k];
                    (middle[k] - 0.5 * (before[k] + after[k])).abs() > allowed
                })
            })
        })
    })
}

/// Depth, m, and lateral force divided by the load.
fn depth_and_force(row: &mut Row<'_>, lateral_m: f64, level: usize) -> [f64; 2] {
    let (depth_m, patches) = row.solve(lateral_m, level);
    let lateral = |patch: &ElasticPatch| patch.load_n * patch.slope / patch.slope.hypot(1.0);
    [
        depth_m,
        patches.iter().map(lateral).sum::<f64>() / LEVELS_N[level],
    ]
}
