//! Contact patches, Hertz and Kalker of one pair, precomputed over lateral shift, roll and yaw.

mod axis;
mod cache;
mod patch;

use std::array::from_fn;

use axis::AxisReader;
pub use axis::{Axis, Grid};
pub use cache::CacheError;
pub(super) use patch::NUMBERS;
pub use patch::{MIN_CURVATURE_PER_M, TabulatedPatch};

use super::geometry::ContactGeometry;
use super::silhouette::WheelPose;
use super::source::{PatchReader, sealed};
use super::zones::ZONES;

/// Greatest number of nodes of the tables: 224 bytes each, a gigabyte in all.
pub const MAX_NODES: usize = 5_000_000;

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
}

/// Four numbers of a node, which one vector instruction reads.
type Quad = [f32; 4];
/// Quads of one patch.
const QUADS: usize = NUMBERS / 4;

/// One node: interpenetrations and stiffnesses of all patches, which decide what is loaded, then the numbers of each patch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(16))]
struct Node([Quad; 2 + QUADS * ZONES]);

const INTERPENETRATIONS: usize = 0;
const STIFFNESSES: usize = 1;
/// First quad of the numbers of a patch.
const fn first_quad(zone: usize) -> usize {
    2 + QUADS * zone
}

/// The tables of one pair; they serve the right wheel and, mirrored, the left wheel.
#[derive(Debug, Clone)]
pub struct Tables {
    geometry: ContactGeometry,
    grid: Grid,
    nodes: Vec<Node>,
    readers: [AxisReader; 3],
    /// Nodes from one roll to the next and from one yaw to the next.
    strides: [usize; 2],
    /// Shift by which a squared yaw moves the contact on the flange, m/rad^2.
    yaw_shift_m: f64,
}

/// Slope of the flange whose silhouette, which yaw moves outwards by `r slope yaw^2`, stays at its place on the axis of the
/// shift: between the root's, where contact jumps, and the face's. Without this a table would need twice as many yaws.
const FLANGE_SLOPE: f64 = 1.8;

impl Tables {
    /// Computes every node of `grid`, on as many threads as the machine offers.
    ///
    /// # Errors
    /// An axis that does not rise or has no cells, or more than [`MAX_NODES`] nodes.
    pub fn new(geometry: ContactGeometry, grid: Grid) -> Result<Self, TablesError> {
        check_grid(&grid)?;
        let empty = Node([[0.0; 4]; 2 + QUADS * ZONES]);
        let mut nodes = vec![empty; grid.nodes()];
        // A row has one roll and one yaw: its wheel is turned once.
        let shifts = grid.lateral_m.nodes();
        let rows = nodes.len() / shifts;
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let rows_each = rows.div_ceil(threads);
        std::thread::scope(|scope| {
            for (part, nodes) in nodes.chunks_mut(rows_each * shifts).enumerate() {
                let (geometry, grid) = (&geometry, &grid);
                scope.spawn(move || {
                    let mut scratch = Vec::new();
                    for (row, nodes) in nodes.chunks_exact_mut(shifts).enumerate() {
                        let first = (part * rows_each + row) * shifts;
                        let turned = pose(geometry, grid, first);
                        let wheel = geometry.pair().turned(turned.roll_rad, turned.yaw_rad);
                        for (i, node) in nodes.iter_mut().enumerate() {
                            let lateral_m = pose(geometry, grid, first + i).lateral_m;
                            *node = Node::new(geometry.patches_of(&wheel, lateral_m, &mut scratch));
                        }
                    }
                });
            }
        });
        Ok(Self::of_nodes(geometry, grid, nodes))
    }

    /// The tables of nodes that are already computed.
    fn of_nodes(geometry: ContactGeometry, grid: Grid, nodes: Vec<Node>) -> Self {
        let shifts = grid.lateral_m.nodes();
        Self {
            yaw_shift_m: yaw_shift_m(&geometry),
            geometry,
            grid,
            nodes,
            readers: [grid.lateral_m, grid.roll_rad, grid.yaw_squared_rad2].map(AxisReader::new),
            strides: [shifts, shifts * grid.roll_rad.nodes()],
        }
    }

    /// What the tables were computed from.
    pub fn geometry(&self) -> &ContactGeometry {
        &self.geometry
    }

    /// Extent and spacing.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The patch of each zone at `pose`, linear in shift, roll and squared yaw, and whether `pose` lies within
    /// the grid; outside it they are those of its nearest edge.
    pub fn at(&self, pose: &WheelPose) -> ([TabulatedPatch; ZONES], bool) {
        let reader = sealed::Source::locate(self, pose);
        let [interpenetrations, stiffnesses] = [reader.interpenetrations_m(), reader.stiffnesses()];
        let patches = from_fn(|zone| {
            let numbers = reader.numbers(zone);
            TabulatedPatch::from_numbers(interpenetrations[zone], stiffnesses[zone], numbers)
        });
        (patches, reader.is_inside())
    }
}

/// Shift by which a squared yaw moves the contact on the flange, m/rad^2.
fn yaw_shift_m(geometry: &ContactGeometry) -> f64 {
    FLANGE_SLOPE * geometry.pair().installation().wheel_radius_m
}

/// Pose of a node, counted over the shift first, then the roll, then the yaw.
fn pose(geometry: &ContactGeometry, grid: &Grid, node: usize) -> WheelPose {
    let (shifts, rolls) = (grid.lateral_m.nodes(), grid.roll_rad.nodes());
    let yaw_squared = grid.yaw_squared_rad2.value(node / (shifts * rolls));
    WheelPose {
        lateral_m: grid.lateral_m.value(node % shifts) - yaw_shift_m(geometry) * yaw_squared,
        roll_rad: grid.roll_rad.value(node / shifts % rolls),
        yaw_rad: yaw_squared.sqrt(),
    }
}

impl Node {
    fn new(patches: [TabulatedPatch; ZONES]) -> Self {
        let mut quads = [[0.0; 4]; 2 + QUADS * ZONES];
        for (zone, patch) in patches.iter().enumerate() {
            quads[INTERPENETRATIONS][zone] = patch.interpenetration_m as f32;
            quads[STIFFNESSES][zone] = patch.hertz.stiffness_n_per_m_1_5 as f32;
            for (n, number) in patch.to_numbers().into_iter().enumerate() {
                quads[first_quad(zone) + n / 4][n % 4] = number as f32;
            }
        }
        Self(quads)
    }
}

/// A cell of the tables and the weights of its eight nodes.
pub struct TabulatedPose<'a> {
    nodes: [&'a Node; 8],
    /// Position within the cell along each axis, from 0 to 1.
    position: [f64; 3],
    /// Derivatives of the position by the value on each axis.
    cells_per_unit: [f64; 3],
    /// Derivatives of the first and the last value by the yaw.
    yaw_slopes: [f64; 2],
    weights: Weights,
    is_inside: bool,
}

impl sealed::Source for Tables {
    type Reader<'a> = TabulatedPose<'a>;

    fn geometry(&self) -> &ContactGeometry {
        &self.geometry
    }

    // Always inlined: passed through memory, the pose and the weights stall the step.
    #[inline(always)]
    fn locate(&self, pose: &WheelPose) -> TabulatedPose<'_> {
        let yaw_squared = pose.yaw_rad * pose.yaw_rad;
        let shifted = pose.lateral_m + self.yaw_shift_m * yaw_squared;
        let values = [shifted, pose.roll_rad, yaw_squared];
        let located: [_; 3] = from_fn(|axis| self.readers[axis].locate(values[axis]));
        let [i, j, k] = located.map(|place| place.cell);
        let [roll_stride, yaw_stride] = self.strides;
        let start = k * yaw_stride + j * roll_stride + i;
        let position = located.map(|place| place.position);
        TabulatedPose {
            nodes: from_fn(|corner| {
                let offset = (corner & 1)
                    + ((corner >> 1) & 1) * roll_stride
                    + (corner >> 2) * yaw_stride;
                &self.nodes[start + offset]
            }),
            position,
            cells_per_unit: located.map(|place| place.cells_per_unit),
            yaw_slopes: [self.yaw_shift_m, 1.0].map(|slope| 2.0 * pose.yaw_rad * slope),
            weights: Weights::new(position.map(|t| [1.0 - t, t])),
            is_inside: located.iter().all(|place| place.is_inside),
        }
    }
}

/// Weights of the eight nodes of a cell.
struct Weights {
    double: [f64; 8],
    single: [f32; 8],
}

impl Weights {
    /// Products of the weights of both ends along each axis, the first axis fastest.
    #[inline(always)]
    fn new([lateral, roll, yaw]: [[f64; 2]; 3]) -> Self {
        let double: [f64; 8] =
            from_fn(|corner| lateral[corner & 1] * (roll[(corner >> 1) & 1] * yaw[corner >> 2]));
        Self {
            double,
            single: double.map(|weight| weight as f32),
        }
    }
}

impl TabulatedPose<'_> {
    /// The weighted sum of one quad over the nodes.
    #[inline(always)]
    fn sum(&self, weights: &Weights, quad: usize) -> [f64; 4] {
        let mut sum = [0.0; 4];
        for (node, weight) in self.nodes.iter().zip(&weights.single) {
            for (sum, number) in sum.iter_mut().zip(&node.0[quad]) {
                *sum += weight * number;
            }
        }
        sum.map(f64::from)
    }

    /// The weighted sum of the interpenetrations, in double precision: a contact of 1e9 N/m answers an error in the
    /// seventh digit with a tenth of a newton.
    #[inline(always)]
    fn sum_of_interpenetrations(&self, weights: &Weights) -> [f64; ZONES] {
        let mut sum = [0.0; ZONES];
        for (node, weight) in self.nodes.iter().zip(&weights.double) {
            for (sum, number) in sum.iter_mut().zip(&node.0[INTERPENETRATIONS]) {
                *sum += weight * f64::from(*number);
            }
        }
        sum
    }

    /// The weights whose sum is the derivative by the position along `axis`.
    #[inline(always)]
    fn slope_weights(&self, axis: usize) -> Weights {
        let mut ends = self.position.map(|t| [1.0 - t, t]);
        ends[axis] = [-1.0, 1.0];
        Weights::new(ends)
    }

    /// The derivatives by shift, roll and yaw of what `read` sums up with weights.
    #[inline(always)]
    fn by_pose<const N: usize>(&self, read: impl Fn(&Weights) -> [f64; N]) -> [[f64; N]; 3] {
        let [by_shift, by_roll, by_yaw_squared]: [[f64; N]; 3] = from_fn(|axis| {
            read(&self.slope_weights(axis)).map(|slope| slope * self.cells_per_unit[axis])
        });
        let [shift, squared] = self.yaw_slopes;
        let by_yaw = from_fn(|n| shift * by_shift[n] + squared * by_yaw_squared[n]);
        [by_shift, by_roll, by_yaw]
    }

    #[inline(always)]
    fn quads(&self, weights: &Weights, zone: usize) -> [f64; NUMBERS] {
        let quads: [_; QUADS] = from_fn(|quad| self.sum(weights, first_quad(zone) + quad));
        from_fn(|n| quads[n / 4][n % 4])
    }
}

impl PatchReader for TabulatedPose<'_> {
    #[inline(always)]
    fn is_inside(&self) -> bool {
        self.is_inside
    }

    #[inline(always)]
    fn interpenetrations_m(&self) -> [f64; ZONES] {
        self.sum_of_interpenetrations(&self.weights)
    }

    #[inline(always)]
    fn stiffnesses(&self) -> [f64; ZONES] {
        self.sum(&self.weights, STIFFNESSES)
    }

    #[inline(always)]
    fn load_slopes(&self, zone: usize) -> [[f64; 2]; 3] {
        self.by_pose(|weights| {
            let interpenetrations = self.sum_of_interpenetrations(weights);
            let stiffnesses = self.sum(weights, STIFFNESSES);
            [interpenetrations[zone], stiffnesses[zone]]
        })
    }

    #[inline(always)]
    fn numbers(&self, zone: usize) -> [f64; NUMBERS] {
        self.quads(&self.weights, zone)
    }

    #[inline(always)]
    fn number_slopes(&self, zone: usize) -> [[f64; NUMBERS]; 3] {
        self.by_pose(|weights| self.quads(weights, zone))
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
