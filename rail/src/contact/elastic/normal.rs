//! The normal problem: line loads on the strips such that no strip enters the rail and none is pulled.

use super::equations::{Equations, LoadedStrip};
use super::gap::{Gap, typical_penetration_m};
use super::half_space::HalfSpace;
use super::steps::Steps;
use crate::contact::hertz::Steel;

/// Maximum number of changes of the strips in contact or of their lengths.
const MAX_ROUNDS: usize = 200;
/// Number of rounds after which changes become cautious: one strip at a time, and half of the change of the lengths.
const CAUTIOUS: usize = 6;
/// Maximum number of changes of the lengths. In a few conformal contacts, a strip at an end takes load under some
/// lengths and none under the next ones; the depth then swings by up to half a micrometre.
const MAX_LENGTHS: usize = 16;
/// Default tolerance of the lengths.
const TOLERANCE: f64 = 5e-4;
/// Entering of a strip that is neglected, m.
const NEGLECTED_M: f64 = 1e-8;
/// Half-length of a strip, m, for the first guess.
const TYPICAL_LENGTH_M: f64 = 5e-3;

/// Maximum distance by which a contact moves with the highest strip, m. Beyond it, the contact jumps rather.
const MAX_MOVEMENT_M: f64 = 5e-3;

/// What is given of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Given {
    /// Total normal load, N. A load that is not positive and finite gives no patch.
    LoadN(f64),
    /// Depth of the tread datum below the top of the rail, m.
    DepthM(f64),
}

/// Line loads on the strips of a wheel. The next solution starts from the previous one.
#[derive(Debug, Clone)]
pub struct NormalContact {
    /// Depth of the tread datum below the top of the rail, m.
    pub depth_m: f64,
    /// Relative change of the lengths of the strips below which they have converged. The depth changes by less than a
    /// third of it.
    tolerance: f64,
    /// The strips of the gap that carry load, in rising order, and the load per width on each, N/m.
    pub(super) loaded: Vec<usize>,
    pub(super) line_loads: Vec<f64>,
    /// Half-length of every strip of the gap in the rolling direction, m.
    pub(super) half_lengths_m: Vec<f64>,
    /// Penetration of every strip of the gap along its normal, m; negative if wheel and rail are apart.
    pub(super) penetrations_m: Vec<f64>,
    /// Positions of the strips of the gap and of the highest one along the wheel's surface, m.
    arcs_m: Vec<f64>,
    summit_m: f64,
    pub(super) steps: Steps,
    equations: Equations,
}

impl Default for NormalContact {
    fn default() -> Self {
        Self::with_tolerance(TOLERANCE)
    }
}

impl NormalContact {
    /// A contact without a previous solution. The lengths of the strips converge until their relative change is below
    /// `tolerance`.
    pub(in crate::contact) fn with_tolerance(tolerance: f64) -> Self {
        Self {
            depth_m: 0.0,
            tolerance,
            loaded: Vec::new(),
            line_loads: Vec::new(),
            half_lengths_m: Vec::new(),
            penetrations_m: Vec::new(),
            arcs_m: Vec::new(),
            summit_m: 0.0,
            steps: Steps::default(),
            equations: Equations::default(),
        }
    }

    /// Solves the contact of the strips in `gap`.
    pub(in crate::contact) fn solve(&mut self, gap: &Gap, steel: &Steel, given: Given) {
        self.follow(gap);
        let is_positive = |number: f64| number > 0.0 && number.is_finite();
        if matches!(given, Given::LoadN(load_n) if !is_positive(load_n)) {
            self.loaded.clear();
            self.line_loads.clear();
            return self.update_penetrations(gap);
        }
        self.begin(gap, given);
        self.steps.forget();
        let modulus = std::f64::consts::PI * steel.contact_modulus_pa();
        let (mut lengths, mut rounds) = (0, 0);
        for _ in 0..MAX_ROUNDS {
            if self.loaded.is_empty() {
                break;
            }
            rounds += 1;
            let cautious = rounds > CAUTIOUS;
            self.solve_loaded(gap, modulus, given);
            if self.drop_pulled(cautious) {
                continue;
            }
            self.update_penetrations(gap);
            // The lengths follow only when the strips in contact are settled, or both might chase each other.
            if self.add_entering(gap, modulus, cautious) {
                continue;
            }
            (lengths, rounds) = (lengths + 1, 0);
            let part = if lengths > CAUTIOUS { 0.5 } else { 1.0 };
            let change = self.update_lengths(&gap.strips, modulus, part);
            if change < self.tolerance || lengths == MAX_LENGTHS {
                break;
            }
        }
        self.update_penetrations(gap);
        for load in &mut self.line_loads {
            *load = load.max(0.0);
        }
    }

    /// Carries the previous solution over to the strips of a new gap. It moves on the wheel as far as the highest
    /// strip does.
    fn follow(&mut self, gap: &Gap) {
        let summit_m = gap.summit_m();
        let moved_m = summit_m - self.summit_m;
        let moved_m = if moved_m.abs() < MAX_MOVEMENT_M {
            moved_m
        } else {
            0.0
        };
        let mut is_loaded = vec![false; self.arcs_m.len()];
        for &entry in &self.loaded {
            is_loaded[entry] = true;
        }
        self.loaded.clear();
        let mut lengths = Vec::with_capacity(gap.strips.len());
        let mut next = 0;
        for (entry, strip) in gap.strips.iter().enumerate() {
            let arc_m = strip.arc_m - moved_m;
            let distance = |at: usize| (self.arcs_m[at] - arc_m).abs();
            while next + 1 < self.arcs_m.len() && distance(next + 1) <= distance(next) {
                next += 1;
            }
            let length_m = self.half_lengths_m.get(next);
            lengths.push(length_m.copied().unwrap_or(TYPICAL_LENGTH_M));
            let is_near =
                is_loaded.get(next) == Some(&true) && distance(next) < 0.75 * strip.width_m;
            if is_near && gap.heights_m[entry].is_finite() {
                self.loaded.push(entry);
            }
        }
        self.half_lengths_m = lengths;
        self.summit_m = summit_m;
        self.arcs_m.clear();
        self.arcs_m
            .extend(gap.strips.iter().map(|strip| strip.arc_m));
    }

    /// Chooses the strips to start with: those of the previous solution, or those that enter the rail.
    fn begin(&mut self, gap: &Gap, given: Given) {
        let highest = gap.highest_m;
        self.depth_m = match given {
            Given::DepthM(depth_m) => depth_m,
            Given::LoadN(load_n) if self.loaded.is_empty() => {
                typical_penetration_m(load_n) - highest
            }
            Given::LoadN(_) => self.depth_m,
        };
        if self.loaded.is_empty() && highest.is_finite() {
            let depth_m = self.depth_m;
            let part = 0.45 * (highest + depth_m);
            let entering = |i: &usize| part > 0.0 && gap.heights_m[*i] + depth_m > part;
            self.loaded = (0..gap.strips.len()).filter(entering).collect();
        }
        self.line_loads.clear();
        self.line_loads.resize(self.loaded.len(), 0.0);
    }

    /// Solves for the loads on the strips in contact, of any sign, and for the depth if the load is given.
    fn solve_loaded(&mut self, gap: &Gap, modulus: f64, given: Given) {
        let tables = HalfSpace::tables();
        let strips = &gap.strips;
        let equations = &mut self.equations;
        let loaded = self.loaded.iter().map(|&i| {
            let strip = &strips[i];
            let per_length = 1.0 / self.half_lengths_m[i];
            LoadedStrip {
                arc_m: strip.arc_m,
                per_length,
                own: tables.own(strip.width_m * per_length),
                sides: [gap.heights_m[i] * strip.cos, strip.cos],
            }
        });
        equations.solve(loaded, modulus);
        if let Given::LoadN(load_n) = given {
            let [at_zero, per_depth] = equations.sums();
            self.depth_m = (load_n - at_zero) / per_depth;
        }
        let depth_m = self.depth_m;
        self.line_loads.clear();
        let loads = self.loaded.iter().zip(equations.solutions());
        self.line_loads.extend(
            loads.map(|(&i, [at_zero, per_depth])| {
                (at_zero + depth_m * per_depth) / strips[i].width_m
            }),
        );
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

    fn update_penetrations(&mut self, gap: &Gap) {
        let depth_m = self.depth_m;
        self.penetrations_m.clear();
        let penetrations = gap.strips.iter().zip(&gap.heights_m);
        self.penetrations_m
            .extend(penetrations.map(|(strip, height)| (height + depth_m) * strip.cos));
    }

    /// Adds the strips that would enter the deflected rail, or the deepest of them; false if there is none. Strips
    /// enter at the ends of a patch, or first where the overlap is greatest.
    fn add_entering(&mut self, gap: &Gap, modulus: f64, only_one: bool) -> bool {
        let tables = HalfSpace::tables();
        let strips = &gap.strips;
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
