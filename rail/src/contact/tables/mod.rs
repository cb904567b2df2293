//! Elastic contact of one pair of profiles, precomputed over lateral shift, roll, yaw and load.
//!
//! A node has the depth of the wheel under each of several loads, and the patches at each. A wheel at a known depth
//! carries the load between the two depths that enclose its own, so one set of tables serves every load.

mod axis;
mod build;
mod cache;
mod cell;
mod conservation;
mod derivatives;
mod file;
mod load;
mod record;
mod row;
mod shear;
mod unpacked;

use axis::{Axes, Axis};
pub use cache::{Cached, NotKept};
use cell::Cell;
use fearless_simd::Simd;
pub use file::NotTheseTables;
use record::Record;
use shear::Shear;

use super::geometry::ContactGeometry;
use super::silhouette::WheelPose;
use super::source::sealed;
use super::zones::ZONES;

/// Number of loads at which the contact is computed.
const LEVELS: usize = 7;
/// Cube roots of these loads, N^(1/3): from 4.9 kN to 1 MN, one of them 200 kN. Penetrations are nearly proportional to
/// their squares.
const ROOTS: [f64; LEVELS] = [17.0, 25.0, 33.0, 41.0, 49.0, 58.5, 100.0];

/// Depths are whole multiples of 2^-27 m, 7.5 nm, so that files are short.
const DEPTH_UNIT_M: f64 = 1.0 / (1 << 27) as f64;

/// Depths of a node: without load, and at each load.
const DEPTHS: usize = LEVELS + 1;

/// The tables of one pair of profiles, for the right wheel and, mirrored, for the left wheel.
#[derive(Debug, Clone)]
pub struct Tables {
    geometry: ContactGeometry,
    /// Lateral shift (m), roll (rad), and squared yaw (rad^2), because the silhouette is an even function of the yaw.
    axes: Axes,
    /// The shift varies fastest, then the roll.
    nodes: Vec<Node>,
    /// The records at all loads, for each zone of each node that has patches.
    records: Vec<[Record; LEVELS]>,
    shear: Shear,
    /// Number of nodes from one shift, roll and yaw to the next.
    strides: [usize; 3],
    /// Movement of the nodes of the shift per roll, m/rad, and per squared yaw, m/rad^2.
    movements: [f64; 2],
}

/// One node of the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    /// Depths of the tread datum below the top of the rail, m.
    depths_m: [f32; DEPTHS],
    /// Number of the first record, and in the lowest bits the zones that have records.
    start: u32,
    /// The zones that have patches at each load, from the lowest bits on.
    loaded: u32,
}

impl Node {
    /// Number of the record of a zone.
    #[inline(always)]
    fn record(&self, zone: usize) -> Option<usize> {
        let bit = 1 << zone;
        let before = (self.start & (bit - 1)).count_ones();
        (self.start & bit != 0).then(|| (self.start >> ZONES) as usize + before as usize)
    }
}

impl Tables {
    /// The geometry that the tables were computed from.
    pub fn geometry(&self) -> &ContactGeometry {
        &self.geometry
    }

    /// Bytes in memory, without the geometry.
    pub fn bytes(&self) -> usize {
        let axes = self.axes.iter().map(Axis::bytes);
        axes.sum::<usize>() + size_of_val(&self.nodes[..]) + size_of_val(&self.records[..])
    }

    /// Number of nodes along shift, roll and yaw.
    pub fn nodes(&self) -> [usize; 3] {
        self.axes.each_ref().map(Axis::nodes)
    }
}

/// Tables are equal if they were computed from the same geometry and are the same bit for bit.
impl PartialEq for Tables {
    fn eq(&self, other: &Self) -> bool {
        Self::file_name(&self.geometry) == Self::file_name(&other.geometry)
            && self.axes == other.axes
            && self.shear == other.shear
            && self.nodes == other.nodes
            && self.records == other.records
    }
}

impl sealed::Source for Tables {
    type Reader<'a> = Cell<'a>;

    fn geometry(&self) -> &ContactGeometry {
        &self.geometry
    }

    #[inline(always)]
    fn locate<S: Simd>(&self, simd: S, pose: &WheelPose, depth_m: f64) -> Cell<'_> {
        Cell::new(simd, self, pose, depth_m)
    }
}
