//! The normal problem: line loads on the strips such that no strip enters the rail and none is pulled.

use super::connection::Connection;
use super::equations::{columns, solve};
use super::half_space::HalfSpace;
use super::strips::Strip;
use crate::contact::hertz::Steel;

/// Maximum number of changes of the strips in contact and of their lengths.
const MAX_ROUNDS: usize = 60;
/// Change of the depth below which the lengths of the strips have converged, m.
const TOLERANCE_M: f64 = 1e-8;
/// The same for a change of the load, relative to it.
const TOLERANCE: f64 = 1e-4;
/// Minimum half-length of a strip as a fraction of that in the middle of its patch. It keeps the deflection finite at
/// the ends of a patch.
const MIN_LENGTH: f64 = 0.15;
/// Valleys of the load that leave two summits one patch, and that divide them.
const VALLEYS: [f64; 2] = [0.5, 0.0];
/// Stiffness of a typical contact, N/m^1.5, for the first guess.
const TYPICAL_STIFFNESS: f64 = 1e11;

/// What is given of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Given {
    /// Total normal load, N; it must be positive.
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
        self.begin(strips, heights, given);
        let modulus = std::f64::consts::PI * steel.contact_modulus_pa();
        for _ in 0..MAX_ROUNDS {
            if self.loaded.is_empty() {
                break;
            }
            let before = (self.depth_m, self.load_n(strips));
            self.solve_loaded(strips, heights, modulus, given);
            if self.drop_pulled() {
                continue;
            }
            self.update_lengths(strips, modulus);
            self.update_penetrations(strips, heights);
            let load_n = self.load_n(strips);
            let added = self.add_entering(strips, modulus);
            let has_settled = (self.depth_m - before.0).abs() < TOLERANCE_M
                && (load_n - before.1).abs() <= TOLERANCE * load_n;
            if !added && has_settled {
                break;
            }
        }
        self.update_penetrations(strips, heights);
        for load in &mut self.line_loads {
            *load = load.max(0.0);
        }
    }

    /// Total normal load, N.
    fn load_n(&self, strips: &[Strip]) -> f64 {
        let loads = self.loaded.iter().zip(&self.line_loads);
        loads.map(|(&i, load)| load * strips[i].width_m).sum()
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
            let (source, length) = (&strips[j], self.half_lengths_m[j]);
            let factor = source.width_m / (modulus * length);
            for (row, &i) in self.loaded.iter().enumerate() {
                let deflection = if i == j {
                    tables.own(source.width_m / length)
                } else {
                    tables.beside((strips[i].arc_m - source.arc_m).abs() / length)
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
            for (row, &i) in self.loaded.iter().enumerate() {
                let (height, cos) = sides(row);
                at_zero += height * strips[i].width_m;
                per_depth += cos * strips[i].width_m;
            }
            self.depth_m = (load_n - at_zero) / per_depth;
        }
        let depth_m = self.depth_m;
        self.line_loads.clear();
        self.line_loads.extend((0..count).map(|row| {
            let (height, cos) = sides(row);
            height + depth_m * cos
        }));
    }

    /// Removes the strips that would be pulled; false if there is none.
    fn drop_pulled(&mut self) -> bool {
        let before = self.loaded.len();
        let mut loads = self.line_loads.iter();
        self.loaded
            .retain(|_| loads.next().is_some_and(|load| *load > 0.0));
        self.line_loads.retain(|load| *load > 0.0);
        self.loaded.len() < before
    }

    fn update_penetrations(&mut self, strips: &[Strip], heights: &[f64]) {
        let depth_m = self.depth_m;
        self.penetrations_m.clear();
        let penetrations = strips.iter().zip(heights);
        self.penetrations_m
            .extend(penetrations.map(|(strip, height)| (height + depth_m) * strip.cos));
    }

    /// Adds the strips that would enter the deflected rail; false if there is none. Strips enter at the ends of a patch,
    /// or first where the overlap is greatest.
    fn add_entering(&mut self, strips: &[Strip], modulus: f64) -> bool {
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
                let (source, length) = (&strips[j], self.half_lengths_m[j]);
                let distance = (strips[i].arc_m - source.arc_m).abs() / length;
                deflection += load * source.width_m / length * tables.beside(distance);
            }
            if deflection < modulus * (overlaps[i] - 0.1 * TOLERANCE_M) {
                entering.push(i);
            }
        }
        for &i in &entering {
            let at = self.loaded.partition_point(|j| *j < i);
            // A new strip begins as long as its loaded neighbour.
            let neighbour = self.loaded.get(at).or(self.loaded.last());
            if let Some(&neighbour) = neighbour {
                self.half_lengths_m[i] = self.half_lengths_m[neighbour];
            }
            self.loaded.insert(at, i);
            self.line_loads.insert(at, 0.0);
        }
        !entering.is_empty()
    }

    /// Sets the half-lengths of the loaded strips to those of elliptical patches with the same load and width.
    fn update_lengths(&mut self, strips: &[Strip], modulus: f64) {
        let connection = Connection {
            strips: &self.loaded,
            heights: &self.line_loads,
            valleys: VALLEYS,
        };
        let spread_around = |k: usize| {
            let mut spread = Spread::new(&strips[self.loaded[k]]);
            connection.each(k, |other, degree| {
                spread.add(&strips[self.loaded[other]], degree * self.line_loads[other]);
            });
            spread
        };
        let whole = connection.is_one_patch().then(|| spread_around(0));
        for (k, &i) in self.loaded.iter().enumerate() {
            let spread = whole.unwrap_or_else(|| spread_around(k));
            self.half_lengths_m[i] =
                spread.half_length(self.line_loads[k], strips[i].radius_m, modulus);
        }
    }
}

/// Load of a patch and its spread across the rolling direction.
#[derive(Debug, Clone, Copy)]
struct Spread {
    origin_m: f64,
    load: f64,
    first: f64,
    second: f64,
    width_m: f64,
}

impl Spread {
    fn new(origin: &Strip) -> Self {
        Self {
            origin_m: origin.arc_m,
            load: 0.0,
            first: 0.0,
            second: 0.0,
            width_m: origin.width_m,
        }
    }

    fn add(&mut self, strip: &Strip, line_load: f64) {
        let (load, distance) = (line_load * strip.width_m, strip.arc_m - self.origin_m);
        self.load += load;
        self.first += load * distance;
        self.second += load * distance * distance;
    }

    /// Half-length of a strip with `line_load` in an elliptical patch of this spread.
    fn half_length(&self, line_load: f64, radius_m: f64, modulus: f64) -> f64 {
        let mean = self.first / self.load;
        // The load of an elliptical patch has the variance b^2/5 across.
        let variance = self.second / self.load - mean * mean + self.width_m * self.width_m / 12.0;
        let semi_axis = (5.0 * variance).sqrt();
        let in_middle = 0.75 * self.load / semi_axis;
        let per_load = 4.0 * radius_m / modulus;
        let ratio = (per_load * in_middle).sqrt() / semi_axis;
        let squared = HalfSpace::tables().squared_length(ratio) * per_load;
        let least = MIN_LENGTH * MIN_LENGTH * in_middle;
        (squared * line_load.max(least)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Hertz, Installation, Pair};

    /// Strips of 0.2 mm on a cylinder of `radius_m` over a rail head of `across_m`, and their heights.
    fn cylinder(radius_m: f64, across_m: f64) -> (Vec<Strip>, Vec<f64>) {
        let at = |k: i32| 0.2e-3 * f64::from(k);
        let strips = (-100..=100).map(|k| Strip::flat(at(k), 0.2e-3, radius_m));
        let heights = (-100..=100).map(|k| -0.5 * at(k) * at(k) / across_m);
        (strips.collect(), heights.collect())
    }

    #[test]
    fn patches_of_smooth_bodies_are_hertzs() {
        let pair = Pair::standard(Installation::default()).unwrap();
        let steel = Steel::default();
        for (radius_m, across_m) in [
            (0.46, 0.3),
            (0.625, 0.08),
            (0.5, 0.5),
            (0.46, 2.0),
            (0.6, 0.02),
        ] {
            let hertz = Hertz::new(&steel, 1.0 / radius_m, 1.0 / across_m);
            for load_n in [20e3, 100e3] {
                let (strips, heights) = cylinder(radius_m, across_m);
                let mut contact = NormalContact::default();
                contact.solve(&strips, &heights, &steel, Given::LoadN(load_n));
                let penetration_m = hertz.penetration_m(load_n);
                let [a_m, b_m] = hertz.semi_axes_m(penetration_m);
                let pressure_pa = 1.5 * load_n / (std::f64::consts::PI * a_m * b_m);
                let patch = contact.patches(&pair, &strips, &[-1.0, 1.0, 2.0])[1];
                let case = format!("{radius_m} m, {across_m} m, {load_n} N: {patch:?}");
                assert!(
                    (contact.depth_m / penetration_m - 1.0).abs() < 0.01,
                    "{case}"
                );
                assert!((patch.semi_axes_m[0] / a_m - 1.0).abs() < 0.03, "{case}");
                assert!((patch.semi_axes_m[1] / b_m - 1.0).abs() < 0.05, "{case}");
                assert!(
                    (patch.peak_pressure_pa / pressure_pa - 1.0).abs() < 0.03,
                    "{case}"
                );
                assert!((patch.load_n / load_n - 1.0).abs() < 1e-9, "{case}");
                assert!(patch.wheel_y_m.abs() < 1e-9 && patch.slope == 0.0, "{case}");
            }
        }
    }

    #[test]
    fn a_depth_gives_the_load_that_gives_this_depth() {
        let steel = Steel::default();
        let (strips, heights) = cylinder(0.46, 0.3);
        let mut contact = NormalContact::default();
        contact.solve(&strips, &heights, &steel, Given::LoadN(75e3));
        let mut again = NormalContact::default();
        again.solve(&strips, &heights, &steel, Given::DepthM(contact.depth_m));
        assert!((again.load_n(&strips) / 75e3 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn wheels_apart_from_the_rail_carry_nothing() {
        let steel = Steel::default();
        let (strips, heights) = cylinder(0.46, 0.3);
        let mut contact = NormalContact::default();
        contact.solve(&strips, &heights, &steel, Given::DepthM(-1e-6));
        assert_eq!(contact.load_n(&strips), 0.0);
        contact.solve(
            &strips,
            &vec![f64::NEG_INFINITY; strips.len()],
            &steel,
            Given::LoadN(1e5),
        );
        assert_eq!(contact.load_n(&strips), 0.0);
        // The next solution does not suffer from it.
        contact.solve(&strips, &heights, &steel, Given::LoadN(1e5));
        assert!((contact.load_n(&strips) / 1e5 - 1.0).abs() < 1e-9);
    }
}
