//! Contact geometry, Hertz and Kalker of one pair, precomputed over lateral shift, roll and yaw.

use super::geometry::{Patch, Patches, SOFTNESS};
use super::hertz::{Hertz, Steel};
use super::kalker::KalkerTable;
use super::pair::{Pair, Place};

/// Numbers of one patch at one node, in the order of [`Entry`]'s fields.
const NUMBERS: usize = 12;
/// One node: tread, then flange.
type Node = [[f32; NUMBERS]; 2];

/// Flattest transverse contact told by curvatures alone, 1/m: a root closer fitted than this spreads
/// its load over its whole width, as an ellipse of this curvature does.
pub const LEAST_CURVATURE: f64 = 0.5;

/// Extent and spacing of the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Least and greatest lateral shift, field side positive, m.
    pub lateral: [f64; 2],
    /// Steps over the lateral shift.
    pub lateral_steps: usize,
    /// Greatest roll, rad.
    pub roll: f64,
    /// Steps from the least to the greatest roll.
    pub roll_steps: usize,
    /// Greatest yaw, rad; the nodes are evenly spaced in its square.
    pub yaw: f64,
    /// Steps over the square of the yaw.
    pub yaw_steps: usize,
}

impl Default for Grid {
    /// -20 mm (wheel towards the track centre) to 65 mm (flange past the rail's top), 0.1 mm apart; roll to 24 mrad, yaw to 50 mrad.
    fn default() -> Self {
        Self {
            lateral: [-0.020, 0.065],
            lateral_steps: 850,
            roll: 0.024,
            roll_steps: 6,
            yaw: 0.05,
            yaw_steps: 5,
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
    /// Kalker's `C11`, `C22`, `C23`, `C33`.
    pub kalker: [f64; 4],
}

/// The tables of one pair; the same for the right wheel and, mirrored, the left.
#[derive(Debug, Clone)]
pub struct Tables {
    pair: Pair,
    steel: Steel,
    grid: Grid,
    nodes: Vec<Node>,
    per_step: [f64; 3],
}

impl Tables {
    /// Computes every node of `grid`; on as many threads as the machine offers.
    pub fn new(pair: Pair, steel: Steel, grid: Grid) -> Self {
        let kalker = KalkerTable::new(steel.poisson);
        let columns = grid.lateral_steps + 1;
        let empty: Node = [[0.0; NUMBERS]; 2];
        let mut nodes = vec![empty; columns * (grid.roll_steps + 1) * (grid.yaw_steps + 1)];
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
                        *node = [tread, flange]
                            .map(|patch| store(&entry(pair, steel, kalker, &patch, place.roll)));
                    }
                });
            }
        });
        let per_step = [
            grid.lateral_steps as f64 / (grid.lateral[1] - grid.lateral[0]),
            grid.roll_steps as f64 / (2.0 * grid.roll),
            grid.yaw_steps as f64 / (grid.yaw * grid.yaw),
        ];
        Self {
            pair,
            steel,
            grid,
            nodes,
            per_step,
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
    #[inline]
    pub fn at(&self, place: &Place) -> ([Entry; 2], bool) {
        let grid = &self.grid;
        let (i, t, inside_lateral) = locate(
            (place.lateral - grid.lateral[0]) * self.per_step[0],
            grid.lateral_steps,
        );
        let (j, u, inside_roll) =
            locate((place.roll + grid.roll) * self.per_step[1], grid.roll_steps);
        let (k, v, inside_yaw) = locate(place.yaw * place.yaw * self.per_step[2], grid.yaw_steps);
        let column = grid.lateral_steps + 1;
        let sheet = column * (grid.roll_steps + 1);
        let mut sum: Node = [[0.0; NUMBERS]; 2];
        for (dk, wk) in [(0, 1.0 - v), (1, v)] {
            for (dj, wj) in [(0, 1.0 - u), (1, u)] {
                let start = (k + dk) * sheet + (j + dj) * column + i;
                let two: &[Node] = &self.nodes[start..start + 2];
                let (low, high) = (wk * wj * (1.0 - t), wk * wj * t);
                for part in 0..2 {
                    for n in 0..NUMBERS {
                        sum[part][n] += low * two[0][part][n] + high * two[1][part][n];
                    }
                }
            }
        }
        (
            sum.map(|numbers| load(&numbers)),
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

/// Cell, share within it and whether `x` lies within `steps` cells.
#[inline]
fn locate(x: f64, steps: usize) -> (usize, f32, bool) {
    let held = x.max(0.0).min(steps as f64);
    let cell = (held as usize).min(steps - 1);
    (cell, (held - cell as f64) as f32, x == held)
}

/// Place of a node by its running number.
fn place_of(grid: &Grid, node: usize) -> Place {
    let column = grid.lateral_steps + 1;
    let (i, rest) = (node % column, node / column);
    let (j, k) = (rest % (grid.roll_steps + 1), rest / (grid.roll_steps + 1));
    let share = |i: usize, steps: usize| i as f64 / steps as f64;
    let [low, high] = grid.lateral;
    Place {
        lateral: low + (high - low) * share(i, grid.lateral_steps),
        roll: grid.roll * (2.0 * share(j, grid.roll_steps) - 1.0),
        yaw: grid.yaw * share(k, grid.yaw_steps).sqrt(),
    }
}

/// Hertz and Kalker of a patch; `roll` turns the contact's slope back into the wheel's axes.
fn entry(pair: &Pair, steel: &Steel, kalker: &KalkerTable, patch: &Patch, roll: f64) -> Entry {
    let radius = pair.installation.wheel_radius + patch.z;
    let rolling = (patch.slope.atan() - roll).cos().max(0.01) / radius;
    let hertz = Hertz::new(steel, rolling, patch.curvature.max(LEAST_CURVATURE));
    let c = kalker.at(hertz.rolling / hertz.across);
    let narrowing = patch.share.cbrt();
    Entry {
        rise: patch.rise,
        s: patch.s,
        z: patch.z,
        slope: patch.slope,
        share: patch.share,
        stiffness: hertz.stiffness * patch.share,
        rolling: hertz.rolling * narrowing,
        across: hertz.across * narrowing,
        kalker: [c.c11, c.c22, c.c23, c.c33],
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
        e.kalker[0],
        e.kalker[1],
        e.kalker[2],
        e.kalker[3],
    ]
    .map(|number| number as f32)
}

#[inline]
fn load(numbers: &[f32; NUMBERS]) -> Entry {
    let [
        rise,
        s,
        z,
        slope,
        share,
        stiffness,
        rolling,
        across,
        c11,
        c22,
        c23,
        c33,
    ] = numbers.map(f64::from);
    Entry {
        rise,
        s,
        z,
        slope,
        share,
        stiffness,
        rolling,
        across,
        kalker: [c11, c22, c23, c33],
    }
}
