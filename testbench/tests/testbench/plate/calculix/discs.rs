//! Stacks of discs under uniform pressure, axisymmetric (CAX8).

use super::deck::{Deck, Geometry};

/// Contact between discs.
#[derive(Clone, Copy, PartialEq)]
pub enum Contact {
    /// Frictionless.
    Sliding,
    /// Bonded: adjacent discs share nodes.
    Bonded,
}

const RADIAL: usize = 40;
const THROUGH: usize = 2;

/// Returns the edge deflection (mm) of each disc of a stack between two radii (mm), with pressure (MPa) on the first
/// disc.
pub fn edge_deflections(
    [clamp, free]: [f64; 2],
    discs: &[f64],
    contact: Contact,
    pressure_mpa: f64,
    geometry: Geometry,
) -> Vec<f64> {
    let mut deck = Deck::new();
    let mut bottom = 0.0;
    let mut grids: Vec<Grid> = Vec::new();
    for thickness in discs {
        let below = grids.last().filter(|_| contact == Contact::Bonded);
        let grid = grid(&mut deck, [clamp, free], bottom, *thickness, below);
        grids.push(grid);
        bottom += thickness;
    }
    deck.elements("CAX8");
    let rows: Vec<[Vec<u32>; THROUGH]> =
        grids.iter().map(|grid| elements(&mut deck, grid)).collect();
    let clamped: Vec<u32> = grids.iter().flat_map(|grid| grid[0].clone()).collect();
    let edges: Vec<u32> = grids
        .iter()
        .map(|grid| grid[2 * RADIAL][2 * THROUGH])
        .collect();
    deck.node_set("CLAMP", &clamped);
    deck.node_set("EDGES", &edges);
    deck.steel();
    for (i, [low, .., high]) in rows.iter().enumerate() {
        deck.surface(&format!("LOW{i}"), low, 1);
        deck.surface(&format!("HIGH{i}"), high, 3);
    }
    if contact == Contact::Sliding && discs.len() > 1 {
        deck.line("*SURFACE INTERACTION, NAME=OIL");
        deck.line("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e7");
    }
    for i in 1..discs.len() {
        if contact == Contact::Sliding {
            deck.line("*CONTACT PAIR, INTERACTION=OIL, TYPE=SURFACE TO SURFACE");
            deck.line(&format!("HIGH{}, LOW{i}", i - 1));
        }
    }
    deck.line("*BOUNDARY\nCLAMP, 1, 2");
    let printed = deck.solve(
        &rows[0][0],
        pressure_mpa,
        geometry,
        "*NODE PRINT, NSET=EDGES\nU",
    );
    printed["displacements"].iter().map(|row| row[2]).collect()
}

/// Node numbers, indexed by half elements outwards and upwards; 0 at element centres, which have no node.
type Grid = Vec<Vec<u32>>;

/// Creates the nodes of a disc; a bonded disc shares the top nodes of the disc below.
fn grid(
    deck: &mut Deck,
    [clamp, free]: [f64; 2],
    bottom: f64,
    thickness: f64,
    below: Option<&Grid>,
) -> Grid {
    let mut at = |i: usize, j: usize| {
        if i % 2 + j % 2 == 2 {
            return 0;
        }
        if let Some(below) = below
            && j == 0
        {
            return below[i][2 * THROUGH];
        }
        let out = i as f64 / (2 * RADIAL) as f64;
        let up = j as f64 / (2 * THROUGH) as f64;
        deck.node([clamp + (free - clamp) * out, bottom + thickness * up, 0.0])
    };
    let columns = 0..=2 * RADIAL;
    columns
        .map(|i| (0..=2 * THROUGH).map(|j| at(i, j)).collect())
        .collect()
}

/// Creates the elements of a disc, in rows from the bottom.
fn elements(deck: &mut Deck, n: &Grid) -> [Vec<u32>; THROUGH] {
    std::array::from_fn(|row| {
        let (b, m, t) = (2 * row, 2 * row + 1, 2 * row + 2);
        (0..RADIAL)
            .map(|column| {
                let (l, c, r) = (2 * column, 2 * column + 1, 2 * column + 2);
                let corners = [n[l][b], n[r][b], n[r][t], n[l][t]];
                let sides = [n[c][b], n[r][m], n[c][t], n[l][m]];
                deck.element(&[corners, sides].concat())
            })
            .collect()
    })
}
