//! The fixed set of motions, scaled by the damper's clearance, friction and springs, and by the speeds at which its
//! force is small, medium and at the limit.

use std::f64::consts::TAU;

use super::motion::{Kind, Motion, Path};
use crate::damper::side::Side;

/// Number of halvings of the top speed.
const OCTAVES: i32 = 11;
/// The set includes the steady speeds at these forces, given as fractions of the range from the closed force to the
/// force limit.
const FORCE_SHARES: [f64; 6] = [0.003, 0.03, 0.15, 0.4, 0.8, 1.0];
/// Times between two reversals of a sawtooth motion, as fractions of the settling time of the force.
const SAW_SHARES: [f64; 3] = [1.0, 0.35, 0.12];
/// Maximum settling time in ticks. Forces that would take longer to settle are reached by faster motions of the set.
const MAX_SETTLING_TICKS: usize = 150;
/// Maximum ticks of a passage through the clearance.
const MAX_CROSSING_TICKS: usize = 20_000;
/// Largest displacement of one piece (m).
const MAX_PIECE_M: f64 = 0.2;
/// Longest rest (s), and its maximum number of ticks.
const HOLD_S: f64 = 60.0;
const MAX_HOLD_TICKS: f64 = 1.2e6;

/// Properties of a damper that scale the motions.
pub(super) struct Scale<'a> {
    pub(super) sides: &'a [Side; 2],
    pub(super) clearance_m: f64,
    pub(super) step_s: f64,
    /// Largest speed of the motions (m/s).
    pub(super) top_m_per_s: f64,
}

impl Scale<'_> {
    /// Builds the set of motions.
    pub(super) fn motions(&self) -> Vec<Motion> {
        let speeds = self.speeds();
        let mut motions: Vec<Motion> = Vec::new();
        for (number, &speed) in speeds.iter().enumerate() {
            motions.extend(SAW_SHARES.map(|share| self.saw(speed, share)));
            motions.push(self.move_and_stop(speed));
            motions.extend(self.crossing(speed));
            if number % 6 == 0 {
                motions.push(self.hold(speed));
            }
        }
        for (number, share) in [1.0, 0.3, 0.1, 0.03].into_iter().enumerate() {
            let speed = share * self.top_m_per_s;
            motions.push(self.changing_speed(speed, 1 + number as u64));
            motions.push(self.ride(speed / 3.0, 101 + number as u64));
        }
        motions.push(self.ramp());
        // Longest first, so that all threads finish at about the same time.
        motions.sort_by_key(|motion| std::cmp::Reverse(motion.compared.len()));
        motions
    }

    /// Speeds (m/s), decreasing: halvings of the top speed, and the steady speeds at fractions of the force.
    fn speeds(&self) -> Vec<f64> {
        let top = self.top_m_per_s;
        let halvings = (0..OCTAVES).map(|octave| top * 0.5_f64.powi(octave));
        let force_speeds = self.sides.iter().flat_map(|side| {
            FORCE_SHARES.map(|share| {
                let force = side.closed_force + share * (side.yield_force - side.closed_force);
                1.02 * side.velocity(side.coordinate(force))
            })
        });
        let mut speeds: Vec<f64> = halvings
            .chain(force_speeds.filter(|speed| (1e-4 * top..top).contains(speed)))
            .collect();
        speeds.sort_by(|a, b| b.total_cmp(a));
        speeds.dedup_by(|lower, upper| *lower > 0.85 * *upper);
        speeds
    }

    /// Number of ticks to cover a distance (m) at a speed (m/s).
    fn ticks(&self, distance_m: f64, speed: f64) -> usize {
        (distance_m / (speed * self.step_s)).ceil() as usize
    }

    /// Number of ticks at a speed (m/s) until the force of the slower side has settled.
    fn settling(&self, speed: f64) -> usize {
        let stretch = self.sides.each_ref().map(|side| {
            let force = side.force(side.coordinate_at(speed));
            side.stretch(force)
        });
        self.ticks(3.0 * stretch[0].max(stretch[1]), speed)
            .clamp(5, MAX_SETTLING_TICKS)
            .min(self.ticks(MAX_PIECE_M, speed))
    }

    fn across(&self, speed: f64) -> usize {
        self.ticks(self.clearance_m, speed).min(MAX_CROSSING_TICKS)
    }

    /// A saw whose legs last a share of the settling time.
    fn saw(&self, speed: f64, share: f64) -> Motion {
        let mut path = Path::new(self.step_s);
        let settling = (share * self.settling(speed) as f64) as usize;
        let ticks = self.across(speed) + settling.max(3);
        path.go(speed, ticks / 2);
        for piece in 0..6 {
            // Slightly different speeds reach the edges of the clearance at different phases of a tick.
            let speed = speed * (1.0 - 0.013 * f64::from(piece));
            path.go(if piece % 2 == 0 { -speed } else { speed }, ticks + 1);
            path.end_part();
        }
        path.end(Kind::Saw, speed)
    }

    fn move_and_stop(&self, speed: f64) -> Motion {
        let mut path = Path::new(self.step_s);
        let (across, settling) = (self.across(speed), self.settling(speed));
        path.go(speed, across / 2);
        for piece in 0..8 {
            let speed = speed * (1.0 - 0.017 * f64::from(piece));
            // Some stops come after the force has settled, others earlier.
            let share = [1.0, 0.6, 0.35, 0.2][piece as usize % 4];
            let ticks = across + (share * settling as f64) as usize + 2;
            path.go(if piece % 2 == 0 { speed } else { -speed }, ticks);
            path.go(0.0, 20 * settling + 400);
            path.end_part();
        }
        path.end(Kind::MoveAndStop, speed)
    }

    /// `None` if a passage takes too many ticks.
    fn crossing(&self, speed: f64) -> Option<Motion> {
        let held = self.sides.each_ref().map(|side| side.closed_stretch);
        let held = self.ticks(2.0 * held[0].max(held[1]), speed).min(60);
        let ticks = self.across(speed) + held + 4;
        if ticks >= MAX_CROSSING_TICKS {
            return None;
        }
        let mut path = Path::new(self.step_s);
        for piece in 0..14 {
            let speed = speed * (1.0 - 0.019 * f64::from(piece));
            path.go(
                if piece % 2 == 0 { speed } else { -speed },
                ticks + piece as usize % 3,
            );
            path.end_part();
        }
        Some(path.end(Kind::Crossing, speed))
    }

    fn changing_speed(&self, top: f64, seed: u64) -> Motion {
        let mut numbers = Numbers(seed);
        let mut path = Path::new(self.step_s);
        let far = MAX_PIECE_M.min(self.clearance_m + 40.0 * top * self.step_s);
        for piece in 0..250 {
            let speed = top * (numbers.unit() * 1e-3_f64.ln()).exp();
            let ticks = (numbers.unit() * 40_f64.ln()).exp() as usize;
            let ticks = ticks.min(self.ticks(MAX_PIECE_M, speed));
            let direction = if path.x().abs() > far {
                -path.x().signum()
            } else if numbers.unit() < 0.5 {
                1.0
            } else {
                -1.0
            };
            let rests = numbers.unit() < 0.15;
            path.go(if rests { 0.0 } else { direction * speed }, ticks);
            if piece % 25 == 24 {
                path.end_part();
            }
        }
        path.end(Kind::ChangingSpeed, top)
    }

    /// Random motion up to 20 Hz with an RMS speed (m/s).
    fn ride(&self, speed: f64, seed: u64) -> Motion {
        let mut numbers = Numbers(seed);
        let lines: Vec<[f64; 3]> = (0..30)
            .map(|_| {
                let angular = TAU * 0.5 * (40_f64.ln() * numbers.unit()).exp();
                [numbers.unit(), angular, TAU * numbers.unit()]
            })
            .collect();
        let sum: f64 = lines.iter().map(|[share, ..]| share * share).sum();
        let scale = speed / (0.5 * sum).sqrt();
        let ticks = (2.0 / self.step_s).min(5000.0) as usize;
        let at = |tick: usize| {
            let t = tick as f64 * self.step_s;
            let line = |[share, angular, phase]: &[f64; 3]| {
                share / angular * ((angular * t + phase).sin() - phase.sin())
            };
            scale * lines.iter().map(line).sum::<f64>()
        };
        // The ride is slowed down if its harmonics add up to more than the top speed.
        let largest = (1..=ticks)
            .map(|tick| (at(tick) - at(tick - 1)).abs() / self.step_s)
            .fold(0.0, f64::max);
        let slowed = (self.top_m_per_s / largest).min(1.0);
        let displacements = (0..=ticks).map(|tick| slowed * at(tick)).collect();
        Motion::new(Kind::Ride, slowed * speed, displacements)
    }

    fn ramp(&self) -> Motion {
        let mut path = Path::new(self.step_s);
        let quarter = self
            .ticks(0.4 * MAX_PIECE_M, self.top_m_per_s)
            .clamp(4, 1500);
        for direction in [1.0, -1.0] {
            for tick in (1..=quarter).chain((0..quarter).rev()) {
                let share = tick as f64 / quarter as f64;
                path.go(direction * share * self.top_m_per_s, 1);
            }
        }
        path.end(Kind::Ramp, self.top_m_per_s)
    }

    fn hold(&self, speed: f64) -> Motion {
        let mut path = Path::new(self.step_s);
        let rest = (HOLD_S / self.step_s).min(MAX_HOLD_TICKS) as usize;
        path.go(speed, self.across(speed) + self.settling(speed));
        path.go(0.0, rest / 2);
        path.go(-speed, self.across(speed) + self.settling(speed));
        path.go(0.0, rest / 2);
        path.end(Kind::Hold, speed)
    }
}

/// Pseudorandom numbers: SplitMix64 (Steele, Lea, Flood 2014).
struct Numbers(u64);

impl Numbers {
    /// Next number in [0, 1).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}
