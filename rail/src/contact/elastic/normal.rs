//! The normal problem: line loads on the strips such that no strip enters the rail and none is pulled.

use super::equations::{columns, solve};
use super::half_space::HalfSpace;
use super::strips::Strip;
use crate::contact::hertz::Steel;

/// Maximum number of changes of the strips in contact or of their lengths.
const MAX_ROUNDS: usize = 200;
/// Number of rounds after which changes become cautious: one strip at a time, and half of the change of the lengths.
const CAUTIOUS: usize = 6;
/// Maximum number of changes of the lengths. In a few conformal contacts, a strip at an end takes load under some
/// lengths and none under the next ones; the depth then swings by up to half a micrometre.
const MAX_LENGTHS: usize = 16;
/// Relative change of the lengths of the strips below which they have converged. The depth changes by less than a
/// third of it.
const TOLERANCE: f64 = 5e-4;
/// Entering of a strip that is neglected, m.
const NEGLECTED_M: f64 = 1e-8;
/// Stiffness of a typical contact, N/m^1.5, for the first guess.
const TYPICAL_STIFFNESS: f64 = 1e11;

/// What is given of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Given {
    /// Total normal load, N. A load that is not positive and finite gives no patch.
    LoadN(f64),
    /// Depth of the tread datum below the top of the rail, m.
    DepthM(f64),
}

/// Line loads on the strips of a wheel. The next solution starts from the previous one.
#[derive(Debug, Clone, Default)]
pub struct NormalContact {
    /// Depth of the tread datum below the top of the rail, m.
    pub depth_m: f64,
    /// The strips that carry load, in rising order, and the load per width on each, N/m.
    pub(super) loaded: Vec<usize>,
    pub(super) line_loads: Vec<f64>,
    /// Half-length of every strip in the rolling direction, m.
    pub(super) half_lengths_m: Vec<f64>,
    /// Penetration of every strip along its normal, m; negative if wheel and rail are apart.
    pub(super) penetrations_m: Vec<f64>,
    matrix: Vec<f64>,
}

impl NormalContact {
    /// Solves the contact of `strips` at `heights` above the top of the rail.
    pub(super) fn solve(&mut self, strips: &[Strip], heights: &[f64], steel: &Steel, given: Given) {
        let is_positive = |number: f64| number > 0.0 && number.is_finite();
        if matches!(given, Given::LoadN(load_n) if !is_positive(load_n)) {
            self.loaded.clear();
            self.line_loads.clear();
            return self.update_penetrations(strips, heights);
        }
        self.begin(strips, heights, given);
        let modulus = std::f64::consts::PI * steel.contact_modulus_pa();
        let (mut lengths, mut rounds) = (0, 0);
        for _ in 0..MAX_ROUNDS {
            if self.loaded.is_empty() {
                break;
            }
            rounds += 1;
            let cautious = rounds > CAUTIOUS;
            self.solve_loaded(strips, heights, modulus, given);
            if self.drop_pulled(cautious) {
                continue;
            }
            self.update_penetrations(strips, heights);
            // The lengths follow only when the strips in contact are settled, or both might chase each other.
            if self.add_entering(strips, modulus, cautious) {
                continue;
            }
            (lengths, rounds) = (lengths + 1, 0);
            let part = if lengths > CAUTIOUS { 0.5 } else { 1.0 };
            let change = self.update_lengths(strips, modulus, part);
            if change < TOLERANCE || lengths == MAX_LENGTHS {
                break;
            }
        }
        self.update_penetrations(strips, heights);
        for load in &mut self.line_loads {
            *load = load.max(0.0);
        }
    }

    /// Chooses the strips to start with: those of the previous solution, or those that enter the rail.
    fn begin(&mut self, strips: &[Strip], heights: &[f64], given: Given) {
        let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if self.half_lengths_m.len() != strips.len() {
            self.half_lengths_m = vec![5e-3; strips.len()];
            self.loaded.clear();
        }
        self.loaded.retain(|&i| heights[i].is_finite());
        let depth_m = match given {
            Given::DepthM(depth_m) => depth_m,
            Given::LoadN(load_n) if self.loaded.is_empty() => {
                (load_n / TYPICAL_STIFFNESS).powf(2.0 / 3.0) - highest
            }
            Given::LoadN(_) => self.depth_m,
        };
        self.depth_m = depth_m;
        if self.loaded.is_empty() && highest.is_finite() {
            let part = 0.45 * (highest + depth_m);
            let entering = |i: &usize| part > 0.0 && heights[*i] + depth_m > part;
            self.loaded = (0..strips.len()).filter(entering).collect();
        }
        self.line_loads.clear();
        self.line_loads.resize(self.loaded.len(), 0.0);
    }

    /// Solves for the loads on the strips in contact, of any sign, and for the depth if the load is given.
    fn solve_loaded(&mut self, strips: &[Strip], heights: &[f64], modulus: f64, given: Given) {
        let tables = HalfSpace::tables();
        let count = self.loaded.len();
        let columns = columns(count);
        self.matrix.clear();
        self.matrix.resize(count * columns, 0.0);
        for (column, &j) in self.loaded.iter().enumerate() {
            let (source, reciprocal) = (&strips[j], 1.0 / self.half_lengths_m[j]);
            let factor = reciprocal / modulus;
            for (row, &i) in self.loaded.iter().enumerate() {
                let deflection = if i == j {
                    tables.own(source.width_m * reciprocal)
                } else {
                    tables.beside((strips[i].arc_m - source.arc_m).abs() * reciprocal)
                };
                self.matrix[row * columns + column] = factor * deflection;
            }
        }
        for (row, &i) in self.loaded.iter().enumerate() {
            self.matrix[row * columns + count] = heights[i] * strips[i].cos;
            self.matrix[row * columns + count + 1] = strips[i].cos;
        }
        solve(&mut self.matrix, count);
        let sides = |row: usize| {
            let at = row * columns + count;
            (self.matrix[at], self.matrix[at + 1])
        };
        if let Given::LoadN(load_n) = given {
            let (mut at_zero, mut per_depth) = (0.0, 0.0);
            for row in 0..count {
                let (height, cos) = sides(row);
                at_zero += height;
                per_depth += cos;
            }
            self.depth_m = (load_n - at_zero) / per_depth;
        }
        let depth_m = self.depth_m;
        self.line_loads.clear();
        self.line_loads.extend((0..count).map(|row| {
            let (height, cos) = sides(row);
            (height + depth_m * cos) / strips[self.loaded[row]].width_m
        }));
    }

    /// Removes the strips that would be pulled, or the one pulled most; false if there is none.
    fn drop_pulled(&mut self, only_one: bool) -> bool {
        let before = self.loaded.len();
        let least = self.line_loads.iter().copied().fold(0.0, f64::min);
        let is_kept = |load: f64| load > 0.0 || only_one && load > least;
        let mut loads = self.line_loads.iter();
        self.loaded
            .retain(|_| loads.next().is_some_and(|load| is_kept(*load)));
        self.line_loads.retain(|load| is_kept(*load));
        self.loaded.len() < before
    }

    fn update_penetrations(&mut self, strips: &[Strip], heights: &[f64]) {
        let depth_m = self.depth_m;
        self.penetrations_m.clear();
        let penetrations = strips.iter().zip(heights);
        self.penetrations_m
            .extend(penetrations.map(|(strip, height)| (height + depth_m) * strip.cos));
    }

    /// Adds the strips that would enter the deflected rail, or the deepest of them; false if there is none. Strips
    /// enter at the ends of a patch, or first where the overlap is greatest.
    fn add_entering(&mut self, strips: &[Strip], modulus: f64, only_one: bool) -> bool {
        let tables = HalfSpace::tables();
        let overlaps = &self.penetrations_m;
        let mut entering = Vec::new();
        let mut next = 0;
        for i in 0..strips.len() {
            while next < self.loaded.len() && self.loaded[next] < i {
                next += 1;
            }
            let is_loaded = |j: usize| self.loaded.get(next) == Some(&j);
            if overlaps[i] <= 0.0 || is_loaded(i) {
                continue;
            }
            let after_loaded = next > 0 && self.loaded[next - 1] + 1 == i;
            let is_end = after_loaded || is_loaded(i + 1);
            let below = |j: Option<usize>| {
                j.and_then(|j| overlaps.get(j))
                    .is_none_or(|d| *d <= overlaps[i])
            };
            if !(is_end || below(i.checked_sub(1)) && below(Some(i + 1))) {
                continue;
            }
            let mut deflection = 0.0;
            for (&j, load) in self.loaded.iter().zip(&self.line_loads) {
                let reciprocal = 1.0 / self.half_lengths_m[j];
                let distance = (strips[i].arc_m - strips[j].arc_m).abs() * reciprocal;
                deflection += load * strips[j].width_m * reciprocal * tables.beside(distance);
            }
            let depth = overlaps[i] - deflection / modulus;
            if depth > NEGLECTED_M {
                entering.push((i, depth));
            }
        }
        if only_one {
            entering.sort_by(|(_, a), (_, b)| b.total_cmp(a));
            entering.truncate(1);
        }
        for &(i, _) in &entering {
            let at = self.loaded.partition_point(|j| *j < i);
            self.loaded.insert(at, i);
            self.line_loads.insert(at, 0.0);
        }
        !entering.is_empty()
    }
}
