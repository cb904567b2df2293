//! A quarter of a disc in solid elements (C3D20R), one element thick, under pressure on parts of its surface.

use std::f64::consts::FRAC_PI_2;

use super::deck::{Deck, Geometry};

/// Number of elements outwards and around the quarter.
const OUT: usize = 30;
const ROUND: usize = 60;
/// Nodes that refine the first element next to the clamp, as fractions of its length: there a solid has a boundary
/// layer about as wide as the thickness of the disc.
const LAYER: [f64; 5] = [0.0, 0.1, 0.2, 0.4, 0.7];

/// Von Mises equivalent stress (MPa) due to bending at a point within the disc.
pub struct Point {
    pub radius: f64,
    pub angle: f64,
    /// Height above the middle plane (mm).
    pub height: f64,
    pub von_mises: f64,
}

/// Edge deflection (mm) by angle (rad), and stress at the integration points.
pub struct Quarter {
    pub edge: Vec<(f64, f64)>,
    pub points: Vec<Point>,
}

/// Solves a disc (mm) under pressure (MPa) on the elements whose centre (radius, angle) satisfies `loaded`.
pub fn quarter(
    [clamp, free]: [f64; 2],
    thickness: f64,
    pressure_mpa: f64,
    loaded: impl Fn(f64, f64) -> bool,
) -> Quarter {
    let width = (free - clamp) / (OUT - LAYER.len() + 1) as f64;
    let end = |i: usize| match LAYER.get(i) {
        Some(part) => clamp + part * width,
        None => clamp + width * (i - LAYER.len() + 1) as f64,
    };
    let radius = |i: usize| 0.5 * (end(i / 2) + end(i.div_ceil(2)));
    let angle = |j: usize| FRAC_PI_2 * j as f64 / (2 * ROUND) as f64;
    let mut deck = Deck::new();
    let mut nodes = vec![[[0; 3]; 2 * ROUND + 1]; 2 * OUT + 1];
    let mut edge_angles = Vec::new();
    for (i, column) in nodes.iter_mut().enumerate() {
        for (j, line) in column.iter_mut().enumerate() {
            for (k, node) in line.iter_mut().enumerate() {
                if i % 2 + j % 2 + k % 2 < 2 {
                    let (sine, cosine) = angle(j).sin_cos();
                    let height = 0.5 * thickness * (k as f64 - 1.0);
                    *node = deck.node([radius(i) * cosine, radius(i) * sine, height]);
                }
            }
        }
    }
    deck.elements("C3D20R");
    let mut pressed = Vec::new();
    for i in (0..2 * OUT).step_by(2) {
        for j in (0..2 * ROUND).step_by(2) {
            let element = deck.element(&brick(&nodes, i, j));
            if loaded(radius(i + 1), angle(j + 1)) {
                pressed.push(element);
            }
        }
    }
    let all = |pick: &dyn Fn(usize, usize) -> bool| -> Vec<u32> {
        let places = (0..=2 * OUT).flat_map(|i| (0..=2 * ROUND).map(move |j| (i, j)));
        let picked = places.filter(|(i, j)| pick(*i, *j));
        let lines = picked.flat_map(|(i, j)| nodes[i][j]);
        lines.filter(|node| *node > 0).collect()
    };
    deck.node_set("CLAMP", &all(&|i, _| i == 0));
    deck.node_set("START", &all(&|i, j| i > 0 && j == 0));
    deck.node_set("END", &all(&|i, j| i > 0 && j == 2 * ROUND));
    let mut edge_nodes = Vec::new();
    for j in (0..=2 * ROUND).step_by(2) {
        // Mid-height, at the mid-side node of a vertical edge.
        edge_nodes.push(nodes[2 * OUT][j][1]);
        edge_angles.push(angle(j));
    }
    deck.node_set("EDGE", &edge_nodes);
    deck.steel();
    deck.line("*BOUNDARY\nCLAMP, 1, 3\nSTART, 2\nEND, 1");
    let printed = deck.solve(
        &pressed,
        pressure_mpa,
        Geometry::Linear,
        "*NODE PRINT, NSET=EDGE\nU\n*EL PRINT, ELSET=PLATE\nS, COORD",
    );
    let edge = edge_angles.into_iter().zip(&printed["displacements"]);
    let stresses = printed["stresses"]
        .iter()
        .zip(&printed["global coordinates"]);
    Quarter {
        edge: edge.map(|(angle, row)| (angle, row[3])).collect(),
        points: stresses.map(|(stress, at)| point(stress, at)).collect(),
    }
}

fn point(stress: &[f64], at: &[f64]) -> Point {
    let [sxx, syy, szz, sxy, sxz, syz] = [2, 3, 4, 5, 6, 7].map(|i| stress[i]);
    let normal = (sxx - syy).powi(2) + (syy - szz).powi(2) + (szz - sxx).powi(2);
    let shear = sxy * sxy + sxz * sxz + syz * syz;
    let (x, y) = (at[2], at[3]);
    Point {
        radius: x.hypot(y),
        angle: y.atan2(x),
        height: at[4],
        von_mises: (0.5 * normal + 3.0 * shear).sqrt(),
    }
}

/// Returns the 20 nodes of the element that starts at half elements `i` outwards and `j` around.
fn brick(n: &[[[u32; 3]; 2 * ROUND + 1]], i: usize, j: usize) -> Vec<u32> {
    let corners = [(0, 0), (2, 0), (2, 2), (0, 2)];
    let sides = [(1, 0), (2, 1), (1, 2), (0, 1)];
    let layer = |places: [(usize, usize); 4], k: usize| places.map(|(a, b)| n[i + a][j + b][k]);
    [
        layer(corners, 0),
        layer(corners, 2),
        layer(sides, 0),
        layer(sides, 2),
        layer(corners, 1),
    ]
    .concat()
}
