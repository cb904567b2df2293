//! Distribution of pressure over a plate.

use std::f64::consts::{PI, TAU};

use serde::Serialize;

use super::limits::{check_count, invalid};
use super::{PlateError, Profile, RoundBosses};

/// Equal, evenly spaced bosses, each an annular sector.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bosses {
    /// Number of bosses N.
    pub count: u32,
    /// Share of the circumference that the bosses cover (1).
    pub share: f64,
    /// Radial pressure profile within a boss.
    pub profile: Profile,
}

/// Pressure distribution. The angle is measured from the centre of a boss.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind")]
pub enum PressureArea {
    /// Axisymmetric pressure.
    Ring(Profile),
    /// Pressure on bosses that are annular sectors.
    Sectors(Bosses),
    /// Pressure on round bosses.
    Round(RoundBosses),
}

impl PressureArea {
    /// Returns an area with full pressure on the whole free part of a disc, between two radii (m).
    pub fn whole(clamp_m: f64, free_m: f64) -> Self {
        Self::Ring(Profile::full(clamp_m, free_m))
    }

    /// Returns the number of identical sectors around the circumference.
    pub fn count(&self) -> u32 {
        match self {
            Self::Ring(_) => 1,
            Self::Sectors(bosses) => bosses.count,
            Self::Round(bosses) => bosses.count,
        }
    }

    /// True if the pressure is axisymmetric.
    pub fn is_axisymmetric(&self) -> bool {
        match self {
            Self::Ring(_) => true,
            Self::Sectors(bosses) => bosses.share == 1.0,
            Self::Round(_) => false,
        }
    }

    /// Returns the pressure at a radius (m) and an angle (rad), divided by the full pressure.
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

    /// Returns the coefficient of `cos(k N t)` of the pressure at a radius, divided by the full pressure.
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

    /// Returns the radii where the pressure profile begins, ends or has a corner.
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

    /// Checks the values for a disc clamped at one radius and free at another (m).
    ///
    /// # Errors
    /// Returns an error if a value is out of range.
    pub fn check(&self, clamp_m: f64, free_m: f64) -> Result<(), PlateError> {
        match self {
            Self::Ring(profile) => profile.check(clamp_m, free_m),
            Self::Sectors(bosses) => {
                check_count(bosses.count)?;
                if !(0.0 < bosses.share && bosses.share <= 1.0) {
                    return Err(invalid(
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares the coefficients with numerical sums of the pressure over the angle.
    #[test]
    fn harmonics_agree_with_numerical_integration() {
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
