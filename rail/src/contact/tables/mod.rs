//! Contact patches, Hertz and Kalker of one pair, precomputed over lateral shift, roll and yaw.

mod axis;
mod patch;

use axis::AxisReader;
pub use axis::{Axis, Grid};
use patch::NUMBERS;
pub use patch::{MIN_CURVATURE_PER_M, TabulatedPatch};

use super::hertz::Steel;
use super::pair::Pair;
use super::patches::{Patches, REGULARIZATION_M};
use super::silhouette::{SilhouettePoint, WheelPose};
use crate::creep::{KalkerError, KalkerTable};

/// Greatest number of nodes of the tables: 96 bytes each, a gigabyte in all.
pub const MAX_NODES: usize = 10_000_000;

/// Why tables cannot be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TablesError {
    /// An axis of the grid has no cells, too many, or ends that do not rise.
    #[error(
        "axis {name}: ends {:?}, cells {:?}; allowed: finite rising ends, cells in exactly the parts that have a width, \
         fewer than {MAX_NODES} in all, a square of the yaw from 0",
        .axis.ends, .axis.cells
    )]
    Axis {
        /// Name of the axis.
        name: &'static str,
        /// The axis.
        axis: Axis,
    },
    /// The grid has more than [`MAX_NODES`] nodes.
    #[error("grid: {nodes} nodes, allowed: {MAX_NODES} or fewer")]
    TooManyNodes {
        /// Number of nodes.
        nodes: u128,
    },
    /// Young's modulus is not a positive number.
    #[error("Young's modulus: {young_modulus_pa} Pa, allowed: a positive number")]
    YoungModulus {
        /// Young's modulus, Pa.
        young_modulus_pa: f64,
    },
    /// Poisson's ratio is out of bounds.
    #[error(transparent)]
    Kalker(#[from] KalkerError),
}

/// One node: the numbers of the tread's patch, then those of the flange's; aligned for vector loads.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
struct Node([f32; 2 * NUMBERS]);

/// The tables of one pair; they serve the right wheel and, mirrored, the left wheel.
#[derive(Debug, Clone)]
pub struct Tables {
    pair: Pair,
    steel: Steel,
    kalker: KalkerTable,
    grid: Grid,
    nodes: Vec<Node>,
    readers: [AxisReader; 3],
    /// Nodes from one roll to the next and from one yaw to the next.
    strides: [usize; 2],
}

impl Tables {
    /// Computes every node of `grid`, on as many threads as the machine offers.
    ///
    /// # Errors
    /// An axis that does not rise or has no cells, more than [`MAX_NODES`] nodes, or elastic constants out of bounds.
    pub fn new(pair: Pair, steel: Steel, grid: Grid) -> Result<Self, TablesError> {
        check_grid(&grid)?;
        let young_modulus_pa = steel.young_modulus_pa;
        if !(young_modulus_pa > 0.0 && young_modulus_pa.is_finite()) {
            return Err(TablesError::YoungModulus { young_modulus_pa });
        }
        let kalker = KalkerTable::new(steel.poisson_ratio)?;
        let empty = Node([0.0; 2 * NUMBERS]);
        let count = grid.lateral_m.nodes() * grid.roll_rad.nodes() * grid.yaw_squared_rad2.nodes();
        let mut tables = Self {
            nodes: Vec::new(),
            readers: [grid.lateral_m, grid.roll_rad, grid.yaw_squared_rad2].map(AxisReader::new),
            strides: [
                grid.lateral_m.nodes(),
                grid.lateral_m.nodes() * grid.roll_rad.nodes(),
            ],
            pair,
            steel,
            kalker,
            grid,
        };
        let mut nodes = vec![empty; count];
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let chunk = nodes.len().div_ceil(threads);
        std::thread::scope(|scope| {
            for (part, nodes) in nodes.chunks_mut(chunk).enumerate() {
                let tables = &tables;
                scope.spawn(move || {
                    let mut scratch = Vec::new();
                    for (i, node) in nodes.iter_mut().enumerate() {
                        let pose = tables.pose(part * chunk + i);
                        let patches = tables.patches(&pose, &mut scratch);
                        for (patch, numbers) in
                            patches.into_iter().zip(node.0.chunks_exact_mut(NUMBERS))
                        {
                            numbers.copy_from_slice(&patch.to_numbers());
                        }
                    }
                });
            }
        });
        tables.nodes = nodes;
        Ok(tables)
    }

    /// The pair that the tables were computed for.
    pub fn pair(&self) -> &Pair {
        &self.pair
    }

    /// The steel that the tables were computed for.
    pub fn steel(&self) -> &Steel {
        &self.steel
    }

    /// Extent and spacing.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The patches of tread and flange at `pose`, linear in shift, roll and squared yaw, and whether `pose` lies within
    /// the grid; outside it they are those of its nearest edge.
    // Always inlined: passed through memory, the pose and the patches stall the step.
    #[inline(always)]
    pub fn at(&self, pose: &WheelPose) -> ([TabulatedPatch; 2], bool) {
        let [lateral, roll, yaw_squared] = &self.readers;
        let (i, t, inside_lateral) = lateral.locate(pose.lateral_m);
        let (j, u, inside_roll) = roll.locate(pose.roll_rad);
        let (k, v, inside_yaw) = yaw_squared.locate(pose.yaw_rad * pose.yaw_rad);
        let [roll_stride, yaw_stride] = self.strides;
        let start = k * yaw_stride + j * roll_stride + i;
        let nodes = [0, roll_stride, yaw_stride, yaw_stride + roll_stride].map(|offset| {
            let at = start + offset;
            [&self.nodes[at].0, &self.nodes[at + 1].0]
        });
        let (v0, v1) = (1.0 - v, v);
        let weights = [v0 * (1.0 - u), v0 * u, v1 * (1.0 - u), v1 * u];
        let mut sum = [0.0_f32; 2 * NUMBERS];
        for (n, sum) in sum.iter_mut().enumerate() {
            let along = |row: usize| (1.0 - t) * nodes[row][0][n] + t * nodes[row][1][n];
            *sum = weights[0] * along(0)
                + weights[1] * along(1)
                + weights[2] * along(2)
                + weights[3] * along(3);
        }
        let (tread, flange) = sum.split_at(NUMBERS);
        (
            [
                TabulatedPatch::from_numbers(tread),
                TabulatedPatch::from_numbers(flange),
            ],
            inside_lateral && inside_roll && inside_yaw,
        )
    }

    /// The patches of tread and flange at `pose` computed without the tables: what [`Tables::at`] approximates.
    pub fn computed(&self, pose: &WheelPose) -> [TabulatedPatch; 2] {
        self.patches(pose, &mut Vec::new())
    }

    fn patches(&self, pose: &WheelPose, scratch: &mut Vec<SilhouettePoint>) -> [TabulatedPatch; 2] {
        let Patches { tread, flange } = self.pair.patches(pose, REGULARIZATION_M, scratch);
        [tread, flange].map(|patch| {
            TabulatedPatch::new(&self.pair, &self.steel, &self.kalker, &patch, pose.roll_rad)
        })
    }

    /// Pose at a node, counted over the lateral shift first, then the roll, then the yaw.
    fn pose(&self, node: usize) -> WheelPose {
        let [roll_stride, yaw_stride] = self.strides;
        WheelPose {
            lateral_m: self.grid.lateral_m.value(node % roll_stride),
            roll_rad: self.grid.roll_rad.value(node % yaw_stride / roll_stride),
            yaw_rad: self.grid.yaw_squared_rad2.value(node / yaw_stride).sqrt(),
        }
    }
}

fn check_grid(grid: &Grid) -> Result<(), TablesError> {
    let yaw_squared = grid.yaw_squared_rad2;
    let axes = [
        ("lateral_m", grid.lateral_m),
        ("roll_rad", grid.roll_rad),
        ("yaw_squared_rad2", yaw_squared),
    ];
    for (name, axis) in axes {
        axis.check(name, MAX_NODES)?;
    }
    if yaw_squared.ends[0] < 0.0 {
        return Err(TablesError::Axis {
            name: "yaw_squared_rad2",
            axis: yaw_squared,
        });
    }
    let nodes = axes.map(|(_, axis)| axis.nodes() as u128).iter().product();
    if nodes > MAX_NODES as u128 {
        return Err(TablesError::TooManyNodes { nodes });
    }
    Ok(())
}
