//! Computes the nodes of the tables.

use std::array::from_fn;

use super::axis::{Axes, Axis};
use super::conservation::{Solved, conserve_energy};
use super::record::{Record, pack};
use super::row::{Row, load_n};
use super::shear::Shear;
use super::{DEPTH_UNIT_M, LEVELS, Node, Tables};
use crate::contact::geometry::ContactGeometry;
use crate::contact::zones::ZONES;

/// Range of the lateral shift, m: from a wheel towards the track centre to a flange past the rail's top.
const SHIFTS_M: [f64; 2] = [-0.020, 0.065];
/// Number of cells before they are halved, and how often.
const SHIFT_CELLS: u32 = 85;
const HALVINGS: u32 = 6;
/// Smallest spacing of the nodes of the shift, m.
const SHIFT_SPACING_M: f64 = (SHIFTS_M[1] - SHIFTS_M[0]) / (SHIFT_CELLS << HALVINGS) as f64;
/// Rolls and squared yaws: first value, smallest spacing (rad, rad^2), and the nodes as multiples of the spacing.
const ROLLS: (f64, f64, [u32; 13]) = (
    -24e-3,
    1e-3,
    [0, 8, 14, 17, 20, 22, 24, 26, 28, 31, 34, 40, 48],
);
const YAWS_SQUARED: (f64, f64, [u32; 6]) = (0.0, 0.5e-4, [0, 2, 5, 10, 18, 50]);
/// Error of the interpolated depth, m, above which a cell of the shift is halved, and loads and rolls at which it is
/// computed.
const DEPTH_ERROR_M: f64 = 2.3e-6;
/// The same for the lateral force, as a fraction of the load, and for the position on the wheel, m.
const FORCE_ERROR: f64 = 0.02;
const POSITION_ERROR_M: f64 = 0.15e-3;
const PROBED_LEVELS: [usize; 2] = [1, 4];
const PROBED_ROLLS_RAD: [f64; 3] = [-6e-3, 0.0, 6e-3];
/// Depths of a wheel that is nowhere over the rail: multiples of this one, m.
const ABSENT_M: f64 = 0.05;

/// The axes of all tables whose shift has these nodes.
pub(super) fn axes(shifts: Axis) -> [Axis; 3] {
    [
        shifts,
        Axis::new(ROLLS.0, ROLLS.1, ROLLS.2.to_vec()),
        Axis::new(YAWS_SQUARED.0, YAWS_SQUARED.1, YAWS_SQUARED.2.to_vec()),
    ]
}

/// The axis of the shift whose nodes are `steps` smallest spacings above the first; `None` if they do not rise from one
/// end of the range to the other.
pub(super) fn shift_axis_of(steps: Vec<u32>) -> Option<Axis> {
    let rises = steps.is_sorted_by(|a, b| a < b) && steps.len() > 1;
    let ends = steps.first().zip(steps.last());
    (rises && ends == Some((&0, &(SHIFT_CELLS << HALVINGS))))
        .then(|| Axis::new(SHIFTS_M[0], SHIFT_SPACING_M, steps))
}

/// A depth as the tables store it.
fn rounded(depth_m: f64) -> f32 {
    ((depth_m / DEPTH_UNIT_M).round() * DEPTH_UNIT_M) as f32
}

/// Some rows of nodes. The records of each node are numbered from the first one of these rows.
#[derive(Default)]
struct Part {
    nodes: Vec<Node>,
    records: Vec<[Record; LEVELS]>,
}

impl Tables {
    /// Computes the tables of a pair on all cores.
    ///
    /// ```
    /// use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel, Tables};
    /// let pair = Pair::standard(Installation::default())?;
    /// let tables = Tables::new(ContactGeometry::new(pair, Steel::default())?);
    /// assert!(tables.bytes() < 5_000_000);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(geometry: ContactGeometry) -> Self {
        let shear = Shear::of(&geometry);
        let axes = axes(shift_axis(&geometry, &shear));
        let [shifts, rolls, yaws] = &axes;
        let rows: Vec<[f64; 2]> = (0..yaws.nodes() * rolls.nodes())
            .map(|row| {
                [
                    rolls.value(row % rolls.nodes()),
                    yaws.value(row / rolls.nodes()),
                ]
            })
            .collect();
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let rows_each = rows.len().div_ceil(threads);
        let compute = |rows: &'_ [[f64; 2]]| {
            let mut part = Part::default();
            for row in rows {
                part.add_row(&geometry, shifts, &shear, *row);
            }
            part
        };
        // WebAssembly has one thread and cannot start another.
        let all = match threads {
            1 => compute(&rows),
            _ => std::thread::scope(|scope| {
                let parts: Vec<_> = rows
                    .chunks(rows_each)
                    .map(|rows| scope.spawn(|| compute(rows)))
                    .collect();
                let mut all = Part::default();
                for part in parts {
                    match part.join() {
                        Ok(part) => all.append(part),
                        Err(panic) => std::panic::resume_unwind(panic),
                    }
                }
                all
            }),
        };
        Self::from_parts(geometry, axes, &shear, all.nodes, all.records)
    }

    pub(super) fn from_parts(
        geometry: ContactGeometry,
        axes: [Axis; 3],
        shear: &Shear,
        nodes: Vec<Node>,
        records: Vec<[Record; LEVELS]>,
    ) -> Self {
        let [shifts, rolls, _] = axes.each_ref().map(Axis::nodes);
        Self {
            strides: [1, shifts, shifts * rolls],
            movements: shear.movements(),
            shear: *shear,
            geometry,
            axes: Axes::new(axes),
            nodes,
            records,
        }
    }
}

impl Part {
    /// Adds the nodes at a roll (rad) and a squared yaw (rad^2).
    fn add_row(
        &mut self,
        geometry: &ContactGeometry,
        shifts: &Axis,
        shear: &Shear,
        [roll, yaw_squared]: [f64; 2],
    ) {
        let mut row = Row::new(geometry, roll, yaw_squared.sqrt());
        let [per_roll, per_squared_yaw] = shear.movements();
        let mut solved: Vec<Option<Solved>> = (0..shifts.nodes())
            .map(|node| {
                let lateral_m =
                    shifts.value(node) + per_roll * roll + per_squared_yaw * yaw_squared;
                row.solve_all(lateral_m)
            })
            .collect();
        conserve_energy(&mut solved);
        for node in &solved {
            let mut depths = from_fn(|k| ABSENT_M * (1 + k) as f64);
            let mut records = [[Record::default(); LEVELS]; ZONES];
            if let Some(node) = node {
                depths[0] = node.first_touch_m;
                for (level, (depth_m, patches)) in node.levels.iter().enumerate() {
                    depths[level + 1] = *depth_m;
                    for (zone, patch) in patches.iter().enumerate() {
                        records[zone][level] = pack(patch, load_n(level));
                    }
                }
            }
            let (mut zones, mut loaded) = (0, 0);
            let start = self.records.len() as u32;
            for (zone, records) in records.into_iter().enumerate() {
                let has_load = |level: &usize| records[*level][0] > 0;
                if (0..LEVELS).any(|level| has_load(&level)) {
                    zones |= 1 << zone;
                    self.records.push(records);
                }
                for level in (0..LEVELS).filter(has_load) {
                    loaded |= 1 << (level * ZONES + zone);
                }
            }
            self.nodes.push(Node {
                depths_m: depths.map(rounded),
                start: start << ZONES | zones,
                loaded,
            });
        }
    }

    fn append(&mut self, other: Self) {
        let before = (self.records.len() as u32) << ZONES;
        self.nodes.extend(other.nodes.into_iter().map(|node| Node {
            start: node.start + before,
            ..node
        }));
        self.records.extend(other.records);
    }
}

/// Places the nodes of the shift where depth, lateral force and position are not straight between them.
fn shift_axis(geometry: &ContactGeometry, shear: &Shear) -> Axis {
    let [per_roll, _] = shear.movements();
    let mut rows =
        PROBED_ROLLS_RAD.map(|roll_rad| (Row::new(geometry, roll_rad, 0.0), per_roll * roll_rad));
    let allowed = [DEPTH_ERROR_M, FORCE_ERROR, POSITION_ERROR_M];
    Axis::halved(SHIFTS_M, SHIFT_CELLS, HALVINGS, |start, end| {
        rows.iter_mut().any(|(row, moved_m)| {
            PROBED_LEVELS.iter().any(|level| {
                let [before, middle, after] = [start, 0.5 * (start + end), end]
                    .map(|shift_m| row.depth_force_and_position(shift_m + *moved_m, *level));
                let is_off =
                    |k: usize| (middle[k] - 0.5 * (before[k] + after[k])).abs() > allowed[k];
                (0..allowed.len()).any(is_off)
            })
        })
    })
}
