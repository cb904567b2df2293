//! Contact geometry, Hertz and Kalker of one pair, precomputed over lateral shift, roll and yaw.

use super::geometry::{Patch, Patches, SOFTNESS};
use super::hertz::{Hertz, Steel};
use super::pair::{Pair, Place};
use crate::creep::kalker::{Coefficients, KalkerTable};

/// Numbers of one patch at one node, in the order of [`Entry`]'s fields.
const NUMBERS: usize = 12;
/// One node: the tread's numbers, then the flange's; aligned for whole vectors.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
struct Node([f32; 2 * NUMBERS]);

/// Flattest transverse contact told by curvatures alone, 1/m: a root closer fitted than this spreads
/// its load over its whole width, as an ellipse of this curvature does.
pub const LEAST_CURVATURE: f64 = 0.5;

/// Nodes along one axis: close together in the middle, wider apart beyond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// Least value, ends of the close part, greatest value.
    pub ends: [f64; 4],
    /// Cells of the three parts; the outer two may be none.
    pub cells: [usize; 3],
}

impl Axis {
    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.cells.iter().sum::<usize>() + 1
    }

    /// Value of a node.
    pub fn value(&self, node: usize) -> f64 {
        let mut first = 0;
        for part in 0..3 {
            let cells = self.cells[part];
            if node <= first + cells && cells > 0 {
                let share = (node - first) as f64 / cells as f64;
                return self.ends[part] + share * (self.ends[part + 1] - self.ends[part]);
            }
            first += cells;
        }
        self.ends[3]
    }
}

/// An axis with its cells' widths inverted, for reading.
#[derive(Debug, Clone, Copy)]
struct Reader {
    ends: [f64; 4],
    first: [f64; 3],
    per_unit: [f64; 3],
    last_cell: u32,
}

impl Reader {
    fn new(axis: Axis) -> Self {
        let [a, b, _] = axis.cells;
        let per_unit = [0, 1, 2].map(|part| {
            let width = axis.ends[part + 1] - axis.ends[part];
            if width > 0.0 {
                axis.cells[part] as f64 / width
            } else {
                0.0
            }
        });
        Self {
            ends: axis.ends,
            first: [0.0, a as f64, (a + b) as f64],
            per_unit,
            last_cell: axis.nodes() as u32 - 2,
        }
    }

    /// Cell, share within it and whether `x` lies on the axis.
    #[inline(always)]
    fn locate(&self, x: f64) -> (usize, f32, bool) {
        let ends = &self.ends;
        let held = x.max(ends[0]).min(ends[3]);
        let part = usize::from(held >= ends[1]) + usize::from(held > ends[2]);
        let position = self.first[part] + (held - ends[part]) * self.per_unit[part];
        let cell = (position as u32).min(self.last_cell);
        (
            cell as usize,
            (position - f64::from(cell)) as f32,
            x == held,
        )
    }
}

/// Extent and spacing of the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Lateral shift, field side positive, m.
    pub lateral: Axis,
    /// Roll, field side down positive, rad.
    pub roll: Axis,
    /// Square of the yaw, rad^2: the outline depends on nothing else.
    pub yaw_square: Axis,
}

impl Default for Grid {
    /// Shift from -20 mm (wheel towards the track centre) to 65 mm (flange past the rail's top), roll to 24 mrad, yaw to 50 mrad;
    /// 0.1 mm, 1 mrad and 1e-4 rad^2 apart within -12 to 12 mm, 12 mrad and 30 mrad.
    fn default() -> Self {
        Self {
            lateral: Axis {
                ends: [-0.020, -0.012, 0.012, 0.065],
                cells: [32, 240, 212],
            },
            roll: Axis {
                ends: [-0.024, -0.012, 0.012, 0.024],
                cells: [4, 24, 4],
            },
            yaw_square: Axis {
                ends: [0.0, 0.0, 9e-4, 25e-4],
                cells: [0, 9, 4],
            },
        }
    }
}

/// One patch as read from the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// As [`Patch::rise`], m.
    pub rise: f64,
    /// As [`Patch::s`], m.
    pub s: f64,
    /// As [`Patch::z`], m.
    pub z: f64,
    /// As [`Patch::slope`].
    pub slope: f64,
    /// As [`Patch::share`].
    pub share: f64,
    /// Load over normal penetration to 1.5, with the share, N/m^1.5.
    pub stiffness: f64,
    /// Semi-axis in the rolling direction over the root of the penetration, m^0.5.
    pub rolling: f64,
    /// Semi-axis across over the root of the penetration, m^0.5.
    pub across: f64,
    /// Kalker's coefficients of the ellipse.
    pub kalker: Coefficients,
}

/// The tables of one pair; the same for the right wheel and, mirrored, the left.
#[derive(Debug, Clone)]
pub struct Tables {
    pair: Pair,
    steel: Steel,
    grid: Grid,
    nodes: Vec<Node>,
    readers: [Reader; 3],
    /// Nodes from one roll to the next and from one yaw to the next.
    strides: [usize; 2],
}

impl Tables {
    /// Computes every node of `grid`; on as many threads as the machine offers.
    ///
    /// # Panics
    /// An axis without a cell.
    pub fn new(pair: Pair, steel: Steel, grid: Grid) -> Self {
        let axes = [grid.lateral, grid.roll, grid.yaw_square];
        assert!(
            axes.iter().all(|axis| axis.nodes() >= 2),
            "an axis of the tables has no cell"
        );
        let kalker = KalkerTable::new(steel.poisson);
        let empty = Node([0.0; 2 * NUMBERS]);
        let count = grid.lateral.nodes() * grid.roll.nodes() * grid.yaw_square.nodes();
        let mut nodes = vec![empty; count];
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let chunk = nodes.len().div_ceil(threads);
        std::thread::scope(|scope| {
            for (part, nodes) in nodes.chunks_mut(chunk).enumerate() {
                let (pair, steel, kalker, grid) = (&pair, &steel, &kalker, &grid);
                scope.spawn(move || {
                    let mut room = Vec::new();
                    for (i, node) in nodes.iter_mut().enumerate() {
                        let place = place_of(grid, part * chunk + i);
                        let Patches { tread, flange } = pair.patches(&place, SOFTNESS, &mut room);
                        for (patch, numbers) in
                            [tread, flange].iter().zip(node.0.chunks_exact_mut(NUMBERS))
                        {
                            let entry = entry(pair, steel, kalker, patch, place.roll);
                            numbers.copy_from_slice(&store(&entry));
                        }
                    }
                });
            }
        });
        Self {
            pair,
            steel,
            grid,
            nodes,
            readers: axes.map(Reader::new),
            strides: [
                grid.lateral.nodes(),
                grid.lateral.nodes() * grid.roll.nodes(),
            ],
        }
    }

    /// The pair the tables were made of.
    pub fn pair(&self) -> &Pair {
        &self.pair
    }

    /// The steel the tables were made for.
    pub fn steel(&self) -> &Steel {
        &self.steel
    }

    /// Extent and spacing.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Tread and flange entry at `place`, linear in shift, roll and squared yaw; outside the grid
    /// its edge, told by `false`.
    // Inlined always: passed through memory, the place and the entries stall the step.
    #[inline(always)]
    pub fn at(&self, place: &Place) -> ([Entry; 2], bool) {
        let [lateral, roll, yaw] = &self.readers;
        let (i, t, inside_lateral) = lateral.locate(place.lateral);
        let (j, u, inside_roll) = roll.locate(place.roll);
        let (k, v, inside_yaw) = yaw.locate(place.yaw * place.yaw);
        let [column, sheet] = self.strides;
        let start = k * sheet + j * column + i;
        let nodes = [0, column, sheet, sheet + column].map(|offset| {
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
            [load(tread), load(flange)],
            inside_lateral && inside_roll && inside_yaw,
        )
    }

    /// The entry computed anew at `place`, without the tables: what [`Tables::at`] approximates.
    pub fn computed(&self, place: &Place) -> [Entry; 2] {
        let kalker = KalkerTable::new(self.steel.poisson);
        let patches = self.pair.patches(place, SOFTNESS, &mut Vec::new());
        [patches.tread, patches.flange]
            .map(|patch| entry(&self.pair, &self.steel, &kalker, &patch, place.roll))
    }
}

/// Place of a node by its running number.
fn place_of(grid: &Grid, node: usize) -> Place {
    let (i, rest) = (node % grid.lateral.nodes(), node / grid.lateral.nodes());
    let (j, k) = (rest % grid.roll.nodes(), rest / grid.roll.nodes());
    Place {
        lateral: grid.lateral.value(i),
        roll: grid.roll.value(j),
        yaw: grid.yaw_square.value(k).sqrt(),
    }
}

/// Hertz and Kalker of a patch; `roll` turns the contact's slope back into the wheel's axes.
fn entry(pair: &Pair, steel: &Steel, kalker: &KalkerTable, patch: &Patch, roll: f64) -> Entry {
    let radius = pair.installation.wheel_radius + patch.z;
    let rolling = (patch.slope.atan() - roll).cos().max(0.01) / radius;
    let hertz = Hertz::new(steel, rolling, patch.curvature.max(LEAST_CURVATURE));
    // Numbers below f32's normal range would slow the step; a millionth of a load is none.
    let share = if patch.share < 1e-6 { 0.0 } else { patch.share };
    let narrowing = share.cbrt();
    Entry {
        rise: patch.rise,
        s: patch.s,
        z: patch.z,
        slope: patch.slope,
        share,
        stiffness: hertz.stiffness * share,
        rolling: hertz.rolling * narrowing,
        across: hertz.across * narrowing,
        kalker: kalker.at(hertz.rolling / hertz.across),
    }
}

fn store(e: &Entry) -> [f32; NUMBERS] {
    [
        e.rise,
        e.s,
        e.z,
        e.slope,
        e.share,
        e.stiffness,
        e.rolling,
        e.across,
        e.kalker.c11,
        e.kalker.c22,
        e.kalker.c23,
        e.kalker.c33,
    ]
    .map(|number| number as f32)
}

#[inline]
fn load(numbers: &[f32]) -> Entry {
    let number = |i: usize| f64::from(numbers[i]);
    Entry {
        rise: number(0),
        s: number(1),
        z: number(2),
        slope: number(3),
        share: number(4),
        stiffness: number(5),
        rolling: number(6),
        across: number(7),
        kalker: Coefficients {
            c11: number(8),
            c22: number(9),
            c23: number(10),
            c33: number(11),
        },
    }
}
