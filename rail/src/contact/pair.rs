//! A wheel profile over a laid rail: where the surfaces overlap.
//!
//! Everything is told for the right-hand side, axes x forward, y right (the field side), z down;
//! the left-hand side is its mirror image.

use crate::profile::{Profile, ProfilePoint, s1002, uic60};

/// Why a wheel and a rail make no pair.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PairError {
    /// A distance of the installation out of its bounds.
    #[error("{name}: {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    Distance {
        /// Which.
        name: &'static str,
        /// Its value, m or 1.
        value: f64,
        /// Least and greatest allowed.
        allowed: [f64; 2],
    },
    /// Gauge and back-to-back distance do not belong together.
    #[error("gauge less back-to-back distance: {play:.4} m, allowed: 0.03 to 0.12 m")]
    Play {
        /// Gauge less back-to-back distance, m.
        play: f64,
    },
    /// The wheel has no flange.
    #[error(
        "wheel {wheel}: no flange, allowed: a flange with its tip and a face of 50 degrees or more"
    )]
    NoFlange {
        /// Name of the wheel's profile.
        wheel: String,
    },
    /// The rail does not reach down to where the gauge is measured.
    #[error(
        "rail {rail}: its gauge side ends above {:.1} mm, where the gauge is measured; allowed: a profile \
         reaching deeper",
        .gauge_depth * 1e3
    )]
    LowRail {
        /// Name of the rail's profile.
        rail: String,
        /// Depth below the rails' top at which the gauge is measured, m.
        gauge_depth: f64,
    },
}

/// How wheels and rails stand to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Installation {
    /// Radius of the wheel at the tread datum, m.
    pub wheel_radius: f64,
    /// Distance of the flange backs, m.
    pub back_to_back: f64,
    /// From the flange back to the tread datum, m.
    pub back_to_datum: f64,
    /// Track gauge, m.
    pub gauge: f64,
    /// Depth below the rails' top at which the gauge is measured, m.
    pub gauge_depth: f64,
    /// Inclination of the rails towards the track centre, 1:n as 1/n.
    pub inclination: f64,
}

impl Default for Installation {
    /// Radius 0.625 m, 1360 mm back to back, gauge 1435 mm at 14 mm, 1:40.
    fn default() -> Self {
        Self {
            wheel_radius: 0.625,
            back_to_back: 1.360,
            back_to_datum: s1002::FLANGE_BACK_TO_DATUM,
            gauge: 1.435,
            gauge_depth: 0.014,
            inclination: 1.0 / 40.0,
        }
    }
}

impl Installation {
    /// Lateral place of the tread datum of a centred wheelset, m.
    pub fn datum(&self) -> f64 {
        0.5 * self.back_to_back + self.back_to_datum
    }

    fn check(&self) -> Result<(), PairError> {
        let allowed = [
            ("wheel radius", self.wheel_radius, 0.1, 1.0),
            ("back-to-back distance", self.back_to_back, 0.4, 2.0),
            ("flange back to tread datum", self.back_to_datum, 0.02, 0.15),
            ("gauge", self.gauge, 0.5, 2.0),
            ("gauge depth", self.gauge_depth, 0.005, 0.03),
            ("rail inclination", self.inclination, -0.1, 0.1),
        ];
        for (name, value, low, high) in allowed {
            if !(low..=high).contains(&value) {
                return Err(PairError::Distance {
                    name,
                    value,
                    allowed: [low, high],
                });
            }
        }
        let play = self.gauge - self.back_to_back;
        if !(0.03..=0.12).contains(&play) {
            return Err(PairError::Play { play });
        }
        Ok(())
    }
}

/// A wheel profile and a rail laid under it.
#[derive(Debug, Clone)]
pub struct Pair {
    /// The wheel's profile about its tread datum.
    pub wheel: Profile,
    /// The rail's profile in track axes: `y` from the track centre, `z` below the rail's top.
    pub rail: Profile,
    /// How they stand.
    pub installation: Installation,
    /// Place on the wheel, from the tread datum, m, that parts tread (beyond) from flange.
    pub split: f64,
    /// Place of the flange's steepest angle; contact further in is climbing, m from the tread datum.
    pub steepest: f64,
    /// Place of the flange tip, m from the tread datum.
    pub tip: f64,
    wheel_slopes: Vec<f64>,
    rail_slopes: Vec<f64>,
}

/// Place of the wheel of one side over its rail.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Place {
    /// Shift of the wheel towards the field against its centred place over the rail, m.
    pub lateral: f64,
    /// Roll, field side down positive, rad.
    pub roll: f64,
    /// Yaw, nose to the field side positive, rad.
    pub yaw: f64,
}

/// One point of the wheel's outline over the rail.
#[derive(Debug, Clone, Copy)]
pub struct Overlap {
    /// Index of the point in the wheel's profile.
    pub index: usize,
    /// Lateral place from the track centre, m.
    pub y: f64,
    /// How far the wheel reaches below the rail's surface when its datum stands at the rail's top, m.
    pub rise: f64,
    /// `dz/dy` of the wheel's surface across the track.
    pub slope: f64,
    /// Curvature of the rail less that of the wheel, 1/m.
    pub curvature: f64,
}

/// Steepness of the wheel that parts tread from flange. Inside a root as round as the rail's corner
/// contact leaves 40 degrees for the flange face's 70: parting there leaves each part one summit.
const SPLIT_ANGLE: f64 = 50.0 * std::f64::consts::PI / 180.0;

impl Pair {
    /// Lays `rail` under `wheel`.
    ///
    /// # Errors
    /// A distance out of its bounds, a rail too low to measure the gauge on, a wheel without a flange of 50 degrees.
    pub fn new(
        wheel: Profile,
        rail: &Profile,
        installation: Installation,
    ) -> Result<Self, PairError> {
        installation.check()?;
        let rail = lay(rail, &installation)?;
        let flange = wheel
            .points
            .iter()
            .rposition(|point| point.angle < -SPLIT_ANGLE);
        let deepest = (0..wheel.points.len())
            .max_by(|&i, &j| wheel.points[i].z.total_cmp(&wheel.points[j].z));
        let (Some(split), Some(tip)) = (flange, deepest.filter(|&tip| tip > 0)) else {
            return Err(PairError::NoFlange { wheel: wheel.name });
        };
        let steepest = (tip..=split)
            .min_by(|&i, &j| wheel.points[i].angle.total_cmp(&wheel.points[j].angle))
            .map_or(tip, |steepest| {
                // The innermost point within 0.1 degree: a straight face is not yet climbing.
                let bound = wheel.points[steepest].angle + 1.7e-3;
                (tip..=steepest)
                    .find(|&i| wheel.points[i].angle <= bound)
                    .unwrap_or(steepest)
            });
        Ok(Self {
            split: wheel.points[split].y,
            steepest: wheel.points[steepest].y,
            tip: wheel.points[tip].y,
            wheel_slopes: slopes(&wheel),
            rail_slopes: slopes(&rail),
            wheel,
            rail,
            installation,
        })
    }

    /// S1002 on UIC 60.
    ///
    /// # Errors
    /// As [`Pair::new`].
    pub fn standard(installation: Installation) -> Result<Self, PairError> {
        Self::new(s1002::profile(), &uic60::profile(), installation)
    }

    /// Fills `overlaps` with the outline of the wheel over the rail at `place`.
    ///
    /// The outline is the silhouette along the rail of the body of revolution, turned by the yaw and
    /// then rolled about the rail's direction: a circle of radius `r` and slope `t = dr/ds` touches
    /// it `r t tan(yaw)` behind the axle, `r t tan(yaw) sin(yaw)` inward and at `r sqrt(1 - t^2 tan(yaw)^2)`
    /// below it. Exact for this order of turns.
    pub fn overlap(&self, place: &Place, overlaps: &mut Vec<Overlap>) {
        overlaps.clear();
        let (sin_roll, cos_roll) = place.roll.sin_cos();
        let (sin_yaw, cos_yaw) = place.yaw.sin_cos();
        let datum = self.installation.datum();
        let radius = self.installation.wheel_radius;
        let (tan_roll, tan_yaw) = (sin_roll / cos_roll, sin_yaw / cos_yaw);
        let mut rail = Cursor {
            points: &self.rail.points,
            slopes: &self.rail_slopes,
            i: 0,
        };
        for (index, point) in self.wheel.points.iter().enumerate() {
            let r = radius + point.z;
            let slope = self.wheel_slopes[index];
            let turned = slope * tan_yaw;
            let short = (1.0 - turned * turned).max(0.01).sqrt();
            let across = point.y * cos_yaw - r * turned * sin_yaw;
            let deep = r * short - radius;
            let y = datum + place.lateral + across * cos_roll - deep * sin_roll;
            let z = across * sin_roll + deep * cos_roll;
            let outline = slope / (cos_yaw * short);
            if let Some((rail_z, rail_curvature)) = rail.at(y) {
                overlaps.push(Overlap {
                    index,
                    y,
                    rise: z - rail_z,
                    slope: (outline + tan_roll) / (1.0 - outline * tan_roll),
                    curvature: rail_curvature - point.curvature,
                });
            }
        }
    }
}

/// `dz/dy` at every sample.
fn slopes(profile: &Profile) -> Vec<f64> {
    profile.points.iter().map(|p| p.angle.tan()).collect()
}

/// Reads a curve at rising places without searching anew.
struct Cursor<'a> {
    points: &'a [ProfilePoint],
    slopes: &'a [f64],
    i: usize,
}

impl Cursor<'_> {
    /// Depth (cubic between the samples' tangents) and curvature at `y`; none beyond the ends.
    fn at(&mut self, y: f64) -> Option<(f64, f64)> {
        let points = self.points;
        if !(points[0].y..=points[points.len() - 1].y).contains(&y) {
            return None;
        }
        while self.i > 0 && points[self.i].y > y {
            self.i -= 1;
        }
        while self.i + 2 < points.len() && points[self.i + 1].y < y {
            self.i += 1;
        }
        let (p, q) = (&points[self.i], &points[self.i + 1]);
        let h = q.y - p.y;
        let t = (y - p.y) / h;
        let (out, back) = (self.slopes[self.i] * h, self.slopes[self.i + 1] * h);
        let rest = q.z - p.z;
        let z =
            p.z + t * (out + t * (3.0 * rest - 2.0 * out - back + t * (out + back - 2.0 * rest)));
        Some((z, p.curvature + t * (q.curvature - p.curvature)))
    }
}

/// Tilts a rail towards the track centre, sets its top at depth 0 and its gauge face at half the gauge.
fn lay(rail: &Profile, installation: &Installation) -> Result<Profile, PairError> {
    let turn = installation.inclination.atan();
    let (sin, cos) = turn.sin_cos();
    let mut points: Vec<ProfilePoint> = rail
        .points
        .iter()
        .map(|p| ProfilePoint {
            y: p.y * cos + p.z * sin,
            z: p.z * cos - p.y * sin,
            angle: p.angle - turn,
            curvature: p.curvature,
        })
        .collect();
    let top = (0..points.len())
        .min_by(|&i, &j| points[i].z.total_cmp(&points[j].z))
        .unwrap_or(0);
    // Below its widest place a tilted head turns under: no wheel can touch it there.
    let upright = |p: &ProfilePoint| p.angle.cos() > 0.01;
    let end = (top..points.len()).find(|&i| !upright(&points[i]));
    points.truncate(end.unwrap_or(points.len()));
    let start = (0..top).rev().find(|&i| !upright(&points[i]));
    points.drain(..start.map_or(0, |start| start + 1));
    let crown = points.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
    let depth = installation.gauge_depth;
    let face = points
        .windows(2)
        .find(|pair| pair[0].z - crown >= depth && pair[1].z - crown < depth)
        .map(|pair| {
            let share = (pair[0].z - crown - depth) / (pair[0].z - pair[1].z);
            pair[0].y + share * (pair[1].y - pair[0].y)
        });
    let Some(face) = face else {
        return Err(PairError::LowRail {
            rail: rail.name.clone(),
            gauge_depth: depth,
        });
    };
    for point in &mut points {
        point.y += 0.5 * installation.gauge - face;
        point.z -= crown;
    }
    Ok(Profile {
        name: rail.name.clone(),
        points,
    })
}
