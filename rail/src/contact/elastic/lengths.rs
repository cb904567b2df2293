//! Lengths of the strips in the rolling direction.

use super::connection::Connection;
use super::half_space::HalfSpace;
use super::normal::NormalContact;
use super::strips::Strip;

/// Minimum half-length of a strip as a fraction of that in the middle of its patch. It keeps the deflection finite at
/// the ends of a patch.
const MIN_LENGTH: f64 = 0.15;
/// Valleys of the load that leave two summits one patch, and that divide them.
const VALLEYS: [f64; 2] = [0.5, 0.0];

impl NormalContact {
    /// Moves the half-lengths of the loaded strips by `part` of the way to those of elliptical patches with the same
    /// load and width. Returns the relative change that a whole way would be.
    pub(super) fn update_lengths(&mut self, strips: &[Strip], modulus: f64, part: f64) -> f64 {
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
        let (mut change, mut total) = (0.0, 0.0);
        let whole = connection.is_one_patch().then(|| spread_around(0));
        let mut steps = self.steps.cleared();
        for (k, &i) in self.loaded.iter().enumerate() {
            let spread = whole.unwrap_or_else(|| spread_around(k));
            let new = spread.half_length(self.line_loads[k], strips[i].radius_m, modulus);
            let step = new - self.half_lengths_m[i];
            change += step.abs();
            total += new;
            steps.push(step);
        }
        self.steps
            .accelerated(&self.loaded, steps, part, &mut self.half_lengths_m);
        // A strip that enters later begins as long as the loaded one next to it, at the end of its patch.
        let mut next = 0;
        for i in 0..strips.len() {
            while next + 1 < self.loaded.len()
                && self.loaded[next].abs_diff(i) > self.loaded[next + 1].abs_diff(i)
            {
                next += 1;
            }
            self.half_lengths_m[i] = self.half_lengths_m[self.loaded[next]];
        }
        change / total
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
