//! Where pressure acts on a plate, and how much of it.

use std::f64::consts::{PI, TAU};

use serde::Serialize;

use super::PlateError;
use super::quadrature::integral;

/// Most bosses over the circumference.
const MOST_BOSSES: u32 = 36;
/// Largest exponent of a decay.
const LARGEST_EXPONENT: f64 = 10.0;

/// Share of the full pressure over the radius: 1 from `full_m[0]` to `full_m[1]`, falling to nothing at `ends_m`,
/// `((r - end)/(full - end))^n`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Profile {
    /// Radii between which the pressure is full (m).
    pub full_m: [f64; 2],
    /// Radii at which the pressure has decayed to nothing (m); those of `full_m` for none.
    pub ends_m: [f64; 2],
    /// Exponent n of the decay (1): 1 linear, 2 quadratic.
    pub exponent: f64,
}

impl Profile {
    /// Full pressure between two radii (m), none outside.
    pub fn full(inner_m: f64, outer_m: f64) -> Self {
        let radii = [inner_m, outer_m];
        Self {
            full_m: radii,
            ends_m: radii,
            exponent: 2.0,
        }
    }

    /// Share of the full pressure at a radius.
    pub fn at(&self, radius_m: f64) -> f64 {
        let ([inner, outer], [start, end]) = (self.full_m, self.ends_m);
        if (inner..=outer).contains(&radius_m) {
            1.0
        } else if start < radius_m && radius_m < inner {
            ((radius_m - start) / (inner - start)).powf(self.exponent)
        } else if outer < radius_m && radius_m < end {
            ((end - radius_m) / (end - outer)).powf(self.exponent)
        } else {
            0.0
        }
    }

    fn check(&self, clamp_m: f64, free_m: f64) -> Result<(), PlateError> {
        let ([inner, outer], [start, end]) = (self.full_m, self.ends_m);
        let listed = |radii: [f64; 2]| format!("{} to {} m", radii[0], radii[1]);
        // Radii as written: a file's 0.029 is the free radius, whatever its last bit became in arithmetic.
        let (clamp, free) = (clamp_m * (1.0 - 1e-12), free_m * (1.0 + 1e-12));
        if !(clamp <= inner && inner < outer && outer <= free) {
            return Err(refused(
                "loaded_radii_m",
                listed(self.full_m),
                format!("rising, within the free part of the disc, {clamp_m} to {free_m} m"),
            ));
        }
        if !(clamp <= start && start <= inner && outer <= end && end <= free) {
            return Err(refused(
                "decay_radii_m",
                listed(self.ends_m),
                format!("around the loaded radii, within {clamp_m} to {free_m} m"),
            ));
        }
        check_exponent(self.exponent)
    }
}

/// Equal bosses over the circumference, each an annular sector.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bosses {
    /// Number of bosses N.
    pub count: u32,
    /// Share of the circumference that they take (1).
    pub share: f64,
    /// Pressure over the radius within a boss.
    pub profile: Profile,
}

/// Equal round bosses over the circumference: full pressure over the hole, decaying to nothing at the boss's edge,
/// `((b - d)/(b - a))^n` at distance d from the middle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RoundBosses {
    /// Number of bosses N.
    pub count: u32,
    /// Radius of the circle on which the bosses' middles lie (m).
    pub pitch_radius_m: f64,
    /// Radius a of a hole (m), at most that of the boss.
    pub hole_radius_m: f64,
    /// Radius b of a boss (m).
    pub boss_radius_m: f64,
    /// Exponent n of the decay (1).
    pub exponent: f64,
}

impl RoundBosses {
    fn at_distance(&self, distance_m: f64) -> f64 {
        let (hole, boss) = (self.hole_radius_m, self.boss_radius_m);
        if distance_m <= hole {
            1.0
        } else if distance_m < boss {
            ((boss - distance_m) / (boss - hole)).powf(self.exponent)
        } else {
            0.0
        }
    }

    fn distance_m(&self, radius_m: f64, angle_rad: f64) -> f64 {
        let pitch = self.pitch_radius_m;
        let half = (0.5 * angle_rad).sin();
        let apart = radius_m - pitch;
        (apart * apart + 4.0 * radius_m * pitch * half * half).sqrt()
    }

    /// Half the angle that a circle of `circle_m` about a boss's middle takes at a radius.
    fn half_angle(&self, radius_m: f64, circle_m: f64) -> f64 {
        let pitch = self.pitch_radius_m;
        let apart = radius_m - pitch;
        let square = (circle_m * circle_m - apart * apart) / (4.0 * radius_m * pitch);
        2.0 * square.max(0.0).sqrt().min(1.0).asin()
    }

    fn harmonic(&self, k: u32, radius_m: f64) -> f64 {
        let per_angle = f64::from(k * self.count);
        let full = self.half_angle(radius_m, self.hole_radius_m);
        let end = self.half_angle(radius_m, self.boss_radius_m);
        let within_hole = if k == 0 {
            full
        } else {
            (per_angle * full).sin() / per_angle
        };
        let middle = 0.5 * (full + end);
        let around = |angle: f64| {
            self.at_distance(self.distance_m(radius_m, angle)) * (per_angle * angle).cos()
        };
        let fading = integral(full, middle, around) + integral(middle, end, around);
        let both_sides = if k == 0 { 1.0 } else { 2.0 };
        both_sides * f64::from(self.count) / PI * (within_hole + fading)
    }

    fn check(&self, clamp_m: f64, free_m: f64) -> Result<(), PlateError> {
        check_count(self.count)?;
        check_exponent(self.exponent)?;
        let (pitch, boss) = (self.pitch_radius_m, self.boss_radius_m);
        if !(clamp_m < pitch && pitch < free_m) {
            return Err(refused(
                "pitch_radius_m",
                format!("{pitch} m"),
                format!("between {clamp_m} and {free_m} m"),
            ));
        }
        let greatest = self.greatest_radius_m(clamp_m, free_m);
        if !(0.0 < boss && boss <= greatest * (1.0 + 1e-12)) {
            return Err(refused(
                "boss_radius_m",
                format!("{boss} m"),
                format!(
                    "above 0 and at most {greatest:.6} m, where a boss meets the clamp, the edge or its neighbour"
                ),
            ));
        }
        if !(0.0 <= self.hole_radius_m && self.hole_radius_m <= boss) {
            return Err(refused(
                "hole_radius_m",
                format!("{} m", self.hole_radius_m),
                format!("0 to the boss radius, {boss} m"),
            ));
        }
        Ok(())
    }

    /// Radius (m) at which a boss at this pitch meets the clamp, the edge or its neighbour.
    pub(super) fn greatest_radius_m(&self, clamp_m: f64, free_m: f64) -> f64 {
        let pitch = self.pitch_radius_m;
        let apart = match self.count {
            1 => f64::INFINITY,
            count => pitch * (PI / f64::from(count)).sin(),
        };
        (pitch - clamp_m).min(free_m - pitch).min(apart)
    }
}

/// Where pressure acts. The angle counts from the middle of a boss.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum PressureArea {
    /// The same all round.
    Ring(Profile),
    /// Bosses that are annular sectors.
    Sectors(Bosses),
    /// Round bosses.
    Round(RoundBosses),
}

impl PressureArea {
    /// Full pressure on the whole free part of a disc between two radii (m).
    pub fn whole(clamp_m: f64, free_m: f64) -> Self {
        Self::Ring(Profile::full(clamp_m, free_m))
    }

    /// Equal parts of the circumference.
    pub fn count(&self) -> u32 {
        match self {
            Self::Ring(_) => 1,
            Self::Sectors(bosses) => bosses.count,
            Self::Round(bosses) => bosses.count,
        }
    }

    /// Whether the pressure is the same all round.
    pub fn is_round(&self) -> bool {
        match self {
            Self::Ring(_) => true,
            Self::Sectors(bosses) => bosses.share == 1.0,
            Self::Round(_) => false,
        }
    }

    /// Share of the full pressure at a radius (m) and an angle (rad).
    pub fn at(&self, radius_m: f64, angle_rad: f64) -> f64 {
        let pitch = TAU / f64::from(self.count());
        let angle = angle_rad - pitch * (angle_rad / pitch).round();
        match self {
            Self::Ring(profile) => profile.at(radius_m),
            Self::Sectors(bosses) => {
                let within = angle.abs() <= 0.5 * bosses.share * pitch;
                f64::from(u8::from(within)) * bosses.profile.at(radius_m)
            }
            Self::Round(bosses) => bosses.at_distance(bosses.distance_m(radius_m, angle)),
        }
    }

    /// Coefficient of `cos(k N t)` in the share of the full pressure at a radius.
    pub(super) fn harmonic(&self, k: u32, radius_m: f64) -> f64 {
        match self {
            Self::Ring(profile) if k == 0 => profile.at(radius_m),
            Self::Ring(_) => 0.0,
            Self::Sectors(bosses) => {
                let round = if k == 0 {
                    bosses.share
                } else {
                    let turns = PI * f64::from(k);
                    2.0 * (turns * bosses.share).sin() / turns
                };
                round * bosses.profile.at(radius_m)
            }
            Self::Round(bosses) => bosses.harmonic(k, radius_m),
        }
    }

    /// Radii where the pressure's course over the radius has an end or a corner.
    pub(super) fn corners_m(&self) -> [f64; 4] {
        match self {
            Self::Ring(profile) | Self::Sectors(Bosses { profile, .. }) => {
                let ([inner, outer], [start, end]) = (profile.full_m, profile.ends_m);
                [start, inner, outer, end]
            }
            Self::Round(bosses) => {
                let (pitch, hole, boss) = (
                    bosses.pitch_radius_m,
                    bosses.hole_radius_m,
                    bosses.boss_radius_m,
                );
                [pitch - boss, pitch - hole, pitch + hole, pitch + boss]
            }
        }
    }

    /// Holds the numbers to what they may be on a disc between two radii (m).
    ///
    /// # Errors
    /// A number out of its range.
    pub fn check(&self, clamp_m: f64, free_m: f64) -> Result<(), PlateError> {
        match self {
            Self::Ring(profile) => profile.check(clamp_m, free_m),
            Self::Sectors(bosses) => {
                check_count(bosses.count)?;
                if !(0.0 < bosses.share && bosses.share <= 1.0) {
                    return Err(refused(
                        "boss_share",
                        bosses.share.to_string(),
                        "above 0 and at most 1".into(),
                    ));
                }
                bosses.profile.check(clamp_m, free_m)
            }
            Self::Round(bosses) => bosses.check(clamp_m, free_m),
        }
    }
}

fn check_count(count: u32) -> Result<(), PlateError> {
    if (1..=MOST_BOSSES).contains(&count) {
        return Ok(());
    }
    let allowed = format!("1 to {MOST_BOSSES}");
    Err(refused("bosses", count.to_string(), allowed))
}

fn check_exponent(exponent: f64) -> Result<(), PlateError> {
    if 0.0 < exponent && exponent <= LARGEST_EXPONENT {
        return Ok(());
    }
    let allowed = format!("above 0 and at most {LARGEST_EXPONENT}");
    Err(refused("decay_exponent", exponent.to_string(), allowed))
}

fn refused(key: &'static str, given: String, allowed: String) -> PlateError {
    PlateError::Area {
        key,
        given,
        allowed,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The coefficients against sums over the angle of what the pressure is there.
    #[test]
    fn harmonics_are_those_of_the_pressure() {
        const STEPS: u32 = 40_000;
        let profile = Profile {
            full_m: [20e-3, 24e-3],
            ends_m: [17e-3, 28e-3],
            exponent: 2.0,
        };
        for area in [
            PressureArea::Ring(profile),
            PressureArea::Sectors(Bosses {
                count: 5,
                share: 0.35,
                profile,
            }),
            PressureArea::Round(RoundBosses {
                count: 6,
                pitch_radius_m: 23e-3,
                hole_radius_m: 3e-3,
                boss_radius_m: 5e-3,
                exponent: 2.0,
            }),
        ] {
            let per_turn = f64::from(area.count());
            for radius in [18.5e-3, 21e-3, 23e-3, 27.5e-3] {
                for k in [0, 1, 2, 7, 20] {
                    let sum: f64 = (0..STEPS)
                        .map(|i| TAU * (f64::from(i) + 0.5) / f64::from(STEPS))
                        .map(|t| area.at(radius, t) * (f64::from(k) * per_turn * t).cos())
                        .sum();
                    let both_sides = if k == 0 { 1.0 } else { 2.0 };
                    let expected = both_sides * sum / f64::from(STEPS);
                    let found = area.harmonic(k, radius);
                    assert!(
                        (found - expected).abs() < 5e-4,
                        "{area:?} {radius} {k}: {found} for {expected}"
                    );
                }
            }
        }
    }
}
