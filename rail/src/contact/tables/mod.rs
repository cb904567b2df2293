//! Contact patches of one pair of profiles, precomputed over lateral shift, roll and yaw.

mod axis;
mod cache;
mod cell;
mod jump;
mod node;

use std::array::from_fn;

pub use axis::{Axis, Grid};
use axis::{AxisReader, in_lanes};
pub use cache::CacheError;
use cell::{Cell, LocatedPoses};
use fearless_simd::{Simd, dispatch, f64x4};
pub use jump::{Jump, MAX_JUMP};
use node::Node;

use super::geometry::ContactGeometry;
use super::silhouette::WheelPose;
use super::source::{PatchReader, sealed};
use super::tabulated_patch::TabulatedPatch;
use super::zones::ZONES;
use crate::math::each::Each;

/// Maximum number of nodes of the tables; at 224 bytes each, about a gigabyte.
pub const MAX_NODES: usize = 4_000_000;

/// Errors from computing tables.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TablesError {
    /// An axis of the grid has no cells, too many, or ends that do not rise.
    #[error(
        "axis {name}: ends {:?}, cells {:?}; allowed: finite rising ends, cells in every part that has a width \
         and in no other part, fewer than {MAX_NODES} cells in all, a squared yaw of 0 or more",
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
    /// The contact force jumps between neighbouring poses.
    #[error(
        "{wheel} on {rail}: at a lateral shift of {:.6} m of the wheel over its rail (roll {:.4} rad, yaw {:.4} rad), \
         the force jumps by {:.0} N under a load of {:.0} N. The stiffness of the contact explains {:.0} N of the \
         jump; the rest must be at most {} % of the load",
        .jump.pose.lateral_m, .jump.pose.roll_rad, .jump.pose.yaw_rad, .jump.jump_n, .jump.load_n,
        .jump.allowed_n, 100.0 * MAX_JUMP
    )]
    Jump {
        /// Name of the wheel's profile.
        wheel: String,
        /// Name of the rail's profile.
        rail: String,
        /// The largest jump.
        jump: Jump,
    },
}

/// The tables of one pair of profiles, for the right wheel and, mirrored, for the left wheel.
#[derive(Debug, Clone)]
pub struct Tables {
    geometry: ContactGeometry,
    grid: Grid,
    nodes: Vec<Node>,
    /// Number of nodes from one roll to the next and from one yaw to the next.
    strides: [usize; 2],
    finder: Finder,
}

/// Finds the cells of poses in four lanes, in the tables of one wheel or of two.
#[derive(Debug, Clone, Copy)]
pub struct Finder {
    /// The axes of shift, roll and squared yaw.
    axes: [AxisReader; 3],
    /// Number of nodes from one roll to the next and from one yaw to the next.
    strides: [[f64; 4]; 2],
    /// Shift of the contact on the flange per squared yaw, m/rad^2.
    yaw_shift: [f64; 4],
}

/// Slope of the part of the flange for which the tables correct the effect of the yaw. The yaw moves the silhouette of
/// this part outwards by `r slope yaw^2`; the correction keeps it at the same node. The value lies between the slope of
/// the root, where the contact jumps, and that of the face. Without the correction, the tables would need twice as many
/// yaw nodes.
const FLANGE_SLOPE: f64 = 1.8;

impl Tables {
    /// Computes every node of `grid`, on all cores.
    ///
    /// # Errors
    /// An axis does not rise or has no cells; there are more than [`MAX_NODES`] nodes; the contact force of the
    /// profiles jumps between neighbouring poses ([`Jump`]).
    pub fn new(geometry: ContactGeometry, grid: Grid) -> Result<Self, TablesError> {
        check_grid(&grid)?;
        let mut nodes = vec![Node::default(); grid.nodes()];
        match compute(&geometry, &grid, &mut nodes) {
            Some(jump) if jump.excess() > MAX_JUMP => Err(TablesError::Jump {
                wheel: geometry.pair().wheel().name().to_owned(),
                rail: geometry.pair().rail().name().to_owned(),
                jump,
            }),
            _ => Ok(Self::from_nodes(geometry, grid, nodes)),
        }
    }

    /// Returns the largest jump of the force between neighbouring nodes of `grid`, or `None` if the stiffness of the
    /// contact explains every change of the force.
    ///
    /// [`Tables::new`] rejects profiles with a [`Jump::excess`] above [`MAX_JUMP`].
    ///
    /// # Errors
    /// [`Tables::new`] would reject the grid.
    pub fn greatest_jump(
        geometry: &ContactGeometry,
        grid: &Grid,
    ) -> Result<Option<Jump>, TablesError> {
        check_grid(grid)?;
        let mut nodes = vec![Node::default(); grid.nodes()];
        Ok(compute(geometry, grid, &mut nodes))
    }

    /// Builds the tables from nodes that are already computed.
    fn from_nodes(geometry: ContactGeometry, grid: Grid, nodes: Vec<Node>) -> Self {
        let shifts = grid.lateral_m.nodes();
        let strides = [shifts, shifts * grid.roll_rad.nodes()];
        let axes = [&grid.lateral_m, &grid.roll_rad, &grid.yaw_squared_rad2];
        Self {
            finder: Finder {
                axes: axes.map(AxisReader::new),
                strides: strides.map(|stride| [stride as f64; 4]),
                yaw_shift: [yaw_shift_m(&geometry); 4],
            },
            geometry,
            grid,
            nodes,
            strides,
        }
    }

    /// The geometry that the tables were computed from.
    pub fn geometry(&self) -> &ContactGeometry {
        &self.geometry
    }

    /// Extent and spacing of the tables.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Interpolates the patch of each zone at `pose`, linearly in shift, roll and squared yaw.
    ///
    /// The boolean is true if `pose` lies within the grid. Outside, the patches are those at the nearest edge.
    pub fn at(&self, pose: &WheelPose) -> ([TabulatedPatch; ZONES], bool) {
        let reader = sealed::Source::locate(self, pose);
        let interpenetrations = reader.interpenetrations_m();
        let patches = from_fn(|zone| {
            let numbers = reader.numbers(zone);
            TabulatedPatch::from_numbers(interpenetrations[zone], numbers)
        });
        (patches, reader.is_inside())
    }
}

/// Computes all nodes and returns the largest jump of the force between them.
fn compute(geometry: &ContactGeometry, grid: &Grid, nodes: &mut [Node]) -> Option<Jump> {
    // All nodes of a row have the same roll and yaw, so the wheel is turned once.
    let shifts = grid.lateral_m.nodes();
    let rows = nodes.len() / shifts;
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let rows_each = rows.div_ceil(threads);
    std::thread::scope(|scope| {
        let parts = nodes.chunks_mut(rows_each * shifts).enumerate();
        let parts: Vec<_> = parts
            .map(|(part, nodes)| {
                scope.spawn(move || {
                    let (mut scratch, mut patches) = (Vec::new(), Vec::with_capacity(shifts));
                    let rows = nodes.chunks_exact_mut(shifts).enumerate();
                    let jumps = rows.filter_map(|(row, nodes)| {
                        let first = (part * rows_each + row) * shifts;
                        let turned = pose(geometry, grid, first);
                        let wheel = geometry.pair().turned(turned.roll_rad, turned.yaw_rad);
                        patches.clear();
                        for (i, node) in nodes.iter_mut().enumerate() {
                            let lateral_m = pose(geometry, grid, first + i).lateral_m;
                            let here = geometry.patches_of(&wheel, lateral_m, &mut scratch);
                            *node = Node::new(here);
                            patches.push((lateral_m, here));
                        }
                        Jump::largest(geometry, &wheel, turned.yaw_rad, &patches, &mut scratch)
                    });
                    jumps.reduce(Jump::larger)
                })
            })
            .collect();
        let jumps = parts.into_iter().filter_map(|part| match part.join() {
            Ok(jump) => jump,
            Err(panic) => std::panic::resume_unwind(panic),
        });
        jumps.reduce(Jump::larger)
    })
}

/// Shift of the contact on the flange per squared yaw, m/rad^2.
fn yaw_shift_m(geometry: &ContactGeometry) -> f64 {
    FLANGE_SLOPE * geometry.pair().installation().wheel_radius_m
}

/// Pose of a node; the shift varies fastest, then the roll, then the yaw.
fn pose(geometry: &ContactGeometry, grid: &Grid, node: usize) -> WheelPose {
    let (shifts, rolls) = (grid.lateral_m.nodes(), grid.roll_rad.nodes());
    let yaw_squared = grid.yaw_squared_rad2.value(node / (shifts * rolls));
    WheelPose {
        lateral_m: grid.lateral_m.value(node % shifts) - yaw_shift_m(geometry) * yaw_squared,
        roll_rad: grid.roll_rad.value(node / shifts % rolls),
        yaw_rad: yaw_squared.sqrt(),
    }
}

impl sealed::Source for Tables {
    type Reader<'a> = Cell<'a>;
    type Finder = Finder;

    fn geometry(&self) -> &ContactGeometry {
        &self.geometry
    }

    fn locate(&self, pose: &WheelPose) -> Cell<'_> {
        dispatch!(crate::math::level(), simd => locate(simd, self, pose))
    }

    fn finder([left, right]: [&Self; 2]) -> Finder {
        let (left, right) = (&left.finder, &right.finder);
        Finder {
            axes: from_fn(|axis| AxisReader::of_two(&left.axes[axis], &right.axes[axis])),
            strides: from_fn(|k| in_lanes(&left.strides[k], &right.strides[k])),
            yaw_shift: in_lanes(&left.yaw_shift, &right.yaw_shift),
        }
    }

    #[inline(always)]
    fn locate_both<'a, S: Simd>(
        _: S,
        finder: &Finder,
        [left, right]: [&'a Self; 2],
        pose: [f64x4<S>; 3],
    ) -> [Cell<'a>; 2] {
        let poses = LocatedPoses::new(finder, pose);
        [Cell::new(left, &poses, 0), Cell::new(right, &poses, 1)]
    }
}

#[inline(always)]
fn locate<'a, S: Simd>(simd: S, tables: &'a Tables, pose: &WheelPose) -> Cell<'a> {
    let pose = [pose.lateral_m, pose.roll_rad, pose.yaw_rad];
    let pose = pose.each(|number| simd.splat_f64x4(number));
    Cell::new(tables, &LocatedPoses::new(&tables.finder, pose), 0)
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
