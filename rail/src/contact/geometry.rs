//! Where a wheel touches its rail: the tread's patch and the flange's, and the rigid wheelset.

use super::pair::{Overlap, Pair, Place};

/// Softness of the search for the deepest place, m: about a tenth of the penetration under a
/// wheel load. Greater smears tread and flange into each other, less makes the contact jump.
pub const SOFTNESS: f64 = 1e-5;

/// One patch of a wheel, tread or flange, at the deepest place of its part of the outline.
///
/// Every number is a mean over the outline with weights `exp(rise / softness)`: it moves
/// continuously where a rigid contact would jump (quasi-elastic contact, Arnold and Netter 1998).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// How far the patch reaches below the rail's surface when the datum stands at the rail's top, m.
    pub rise: f64,
    /// Place on the wheel from the tread datum, field side positive, m.
    pub s: f64,
    /// Depth on the wheel: the rolling radius is the wheel's radius plus this, m.
    pub z: f64,
    /// Lateral place from the track centre, m.
    pub y: f64,
    /// `dz/dy` of both surfaces across the track: the tangent of the contact angle.
    pub slope: f64,
    /// Curvature of the rail less that of the wheel across the track, 1/m.
    pub curvature: f64,
    /// Share of the patch, 0 to 1: below 1 where tread and flange patch are still one.
    pub share: f64,
}

/// The patches of one wheel at a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patches {
    /// The patch on the tread.
    pub tread: Patch,
    /// The patch on the flange and its root.
    pub flange: Patch,
}

/// Depth of the valley between tread and flange patch, in softnesses, from which they are two.
const TWO_PATCHES: f64 = 4.0;

/// Where a part of the wheel is nowhere over the rail it stands this far above it, m.
const FAR: f64 = -0.05;

impl Pair {
    /// Tread and flange patch at `place`; `room` is working space.
    ///
    /// The patches share one load while no valley parts them, by `exp(rise / softness)`; with the
    /// valley four softnesses deep each carries its own. The split itself leaves no trace.
    pub fn patches(&self, place: &Place, softness: f64, room: &mut Vec<Overlap>) -> Patches {
        self.overlap(place, room);
        let parts = room
            .iter()
            .position(|o| self.wheel.points[o.index].y > self.split)
            .unwrap_or(room.len());
        let (flange, tread) = room.split_at(parts);
        let summit = |part: &[Overlap]| part.iter().map(|o| o.rise).fold(f64::MIN, f64::max);
        let peaks = [summit(tread), summit(flange)];
        let top = peaks[0].max(peaks[1]);
        let (tread_mass, mut on_tread) = self.mean(tread, peaks[0], softness);
        let (flange_mass, mut on_flange) = self.mean(flange, peaks[1], softness);
        let at = |part: &[Overlap], peak: f64| part.iter().position(|o| o.rise == peak);
        let depth = match (at(flange, peaks[1]), at(tread, peaks[0])) {
            (Some(i), Some(j)) => {
                let valley = room[i..=parts + j].iter().map(|o| o.rise);
                peaks[0].min(peaks[1]) - valley.fold(f64::MAX, f64::min)
            }
            _ => f64::MAX,
        };
        let t = (depth / (TWO_PATCHES * softness)).min(1.0);
        let apart = t * t * (3.0 - 2.0 * t);
        let masses = [
            tread_mass * ((peaks[0] - top) / softness).exp(),
            flange_mass * ((peaks[1] - top) / softness).exp(),
        ];
        let whole = (masses[0] + masses[1]).max(f64::MIN_POSITIVE);
        on_tread.share = apart + (1.0 - apart) * masses[0] / whole;
        on_flange.share = apart + (1.0 - apart) * masses[1] / whole;
        Patches {
            tread: on_tread,
            flange: on_flange,
        }
    }

    /// Sum of the weights over `part` relative to its `peak`, and the means.
    fn mean(&self, part: &[Overlap], peak: f64, softness: f64) -> (f64, Patch) {
        let mut mass = 0.0;
        let mut sum = [0.0; 6];
        for (i, overlap) in part.iter().enumerate() {
            let below = (overlap.rise - peak) / softness;
            if below < -40.0 {
                continue;
            }
            let next = part.get(i + 1).unwrap_or(overlap).y;
            let last = part[i.saturating_sub(1)].y;
            let weight = below.exp() * 0.5 * (next - last).abs();
            let point = &self.wheel.points[overlap.index];
            let terms = [
                overlap.rise,
                point.y,
                point.z,
                overlap.y,
                overlap.slope,
                overlap.curvature,
            ];
            mass += weight;
            for (sum, term) in sum.iter_mut().zip(terms) {
                *sum += weight * term;
            }
        }
        if mass <= 0.0 {
            let patch = Patch {
                rise: FAR,
                s: self.split,
                z: 0.0,
                y: self.installation.datum(),
                slope: 0.0,
                curvature: 1.0,
                share: 0.0,
            };
            return (0.0, patch);
        }
        let [rise, s, z, y, slope, curvature] = sum.map(|sum| sum / mass);
        let patch = Patch {
            // The mean lies half a softness below the top of a parabola.
            rise: rise + 0.5 * softness,
            s,
            z,
            y,
            slope,
            curvature,
            share: 1.0,
        };
        (mass, patch)
    }

    /// The deepest point of the whole outline at `place`, as if both bodies were rigid.
    pub fn deepest(&self, place: &Place, room: &mut Vec<Overlap>) -> Patch {
        self.overlap(place, room);
        let best = (0..room.len()).max_by(|&i, &j| room[i].rise.total_cmp(&room[j].rise));
        let Some(best) = best else {
            return self.mean(&[], 0.0, SOFTNESS).1;
        };
        let at = |i: usize| {
            let (o, p) = (&room[i], &self.wheel.points[room[i].index]);
            [o.rise, p.y, p.z, o.y, o.slope, o.curvature]
        };
        let mut values = at(best);
        if best > 0 && best + 1 < room.len() {
            // Vertex of the parabola through the three highest points.
            let (before, after) = (at(best - 1), at(best + 1));
            let (x0, x2) = (before[3] - values[3], after[3] - values[3]);
            let (f0, f2) = (before[0] - values[0], after[0] - values[0]);
            let square = (f0 / x0 - f2 / x2) / (x0 - x2);
            let slope = f0 / x0 - square * x0;
            if square < 0.0 {
                let x = (-0.5 * slope / square).clamp(x0.min(x2), x0.max(x2));
                let top = values[0] + 0.5 * slope * x;
                let (other, span) = if x * x2 > 0.0 {
                    (after, x2)
                } else {
                    (before, x0)
                };
                for (value, other) in values.iter_mut().zip(other) {
                    *value += x / span * (other - *value);
                }
                values[0] = top;
            }
        }
        let [rise, s, z, y, slope, curvature] = values;
        Patch {
            rise,
            s,
            z,
            y,
            slope,
            curvature,
            share: 1.0,
        }
    }
}

/// A wheelset resting on both rails without penetration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidContact {
    /// Lateral shift at the level of the rails' top, right positive, m.
    pub lateral: f64,
    /// Roll, right side down positive, rad.
    pub roll: f64,
    /// Height of the wheelset's centre over its centred tread-datum height, down positive, m.
    pub vertical: f64,
    /// The touching points of the left (mirrored to a right-hand side) and the right wheel.
    pub sides: [Patch; 2],
}

impl RigidContact {
    /// Rolling radius of the right wheel less that of the left, m.
    pub fn rolling_radius_difference(&self) -> f64 {
        self.sides[1].z - self.sides[0].z
    }
}

impl Pair {
    /// Lets a rigid wheelset, shifted by `lateral` and yawed, rest on two rails.
    ///
    /// `rise_right - rise_left + 2 e sin(roll) = 0`, by secants.
    pub fn rigid(&self, lateral: f64, yaw: f64, room: &mut Vec<Overlap>) -> RigidContact {
        let datum = self.installation.datum();
        let mut sides_at = |roll: f64| {
            let narrower = datum * (yaw.cos() * roll.cos() - 1.0);
            let mut side = |sign: f64| {
                let place = Place {
                    lateral: sign * lateral + narrower,
                    roll: sign * roll,
                    yaw: sign * yaw,
                };
                self.deepest(&place, room)
            };
            let sides = [side(-1.0), side(1.0)];
            let open = sides[1].rise - sides[0].rise + 2.0 * datum * yaw.cos() * roll.sin();
            (sides, open)
        };
        let mut roll = 0.0;
        let (mut sides, mut open) = sides_at(roll);
        let mut slope = 2.0 * datum;
        for _ in 0..30 {
            let next = roll - open / slope;
            let (next_sides, next_open) = sides_at(next);
            let secant = (next_open - open) / (next - roll);
            (roll, open, sides) = (next, next_open, next_sides);
            if open.abs() < 1e-10 || !secant.is_finite() {
                break;
            }
            // A jump of the contact bends the function; keep the step within its plausible slope.
            slope = secant.clamp(datum, 4.0 * datum);
        }
        RigidContact {
            lateral,
            roll,
            vertical: -0.5 * (sides[0].rise + sides[1].rise),
            sides,
        }
    }
}
