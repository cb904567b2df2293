//! A wheel profile on a laid rail.

use super::installation::{Installation, InstallationError};
use super::laid_rail::lay;
use crate::profile::{Profile, ProfilePoint, s1002, uic60};

/// Errors from pairing a wheel with a rail.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PairError {
    /// The dimensions of wheelset or track are invalid.
    #[error(transparent)]
    Installation(#[from] InstallationError),
    /// The wheel has no flange.
    #[error(
        "wheel {wheel}: no flange, allowed: a profile with a flange tip and a flange face of 50 degrees or more"
    )]
    NoFlange {
        /// Name of the wheel's profile.
        wheel: String,
    },
    /// The rail does not reach the depth at which the gauge is measured.
    #[error(
        "rail {rail}: the gauge side must reach below the depth of {:.1} mm at which the gauge is measured",
        .gauge_depth_m * 1e3
    )]
    LowRail {
        /// Name of the rail's profile.
        rail: String,
        /// Depth below the top of the rails at which the gauge is measured, m.
        gauge_depth_m: f64,
    },
}

/// A wheel profile and the rail laid under it.
#[derive(Debug, Clone)]
pub struct Pair {
    wheel: Profile,
    rail: Profile,
    installation: Installation,
    rail_top_m: f64,
    tread_end_m: f64,
    steepest_flange_m: f64,
    flange_tip_m: f64,
    /// `dz/dy` at every sample of the wheel and of the rail.
    pub(super) wheel_slopes: Vec<f64>,
    pub(super) rail_slopes: Vec<f64>,
}

/// Contact angle that separates tread and flange. If the flange root is as round as the rail's corner, the contact
/// angle jumps within one sample from 40 degrees to the 70 degrees of the flange face. With a boundary in between,
/// tread and flange each have one maximum of interpenetration.
const FLANGE_ANGLE: f64 = 50.0 * std::f64::consts::PI / 180.0;

impl Pair {
    /// Lays `rail` under `wheel`.
    ///
    /// # Errors
    /// A dimension is out of bounds, the rail ends above the gauge depth, or the wheel has no flange of 50 degrees.
    pub fn new(
        wheel: Profile,
        rail: &Profile,
        installation: Installation,
    ) -> Result<Self, PairError> {
        installation.check()?;
        let Some(laid) = lay(rail, &installation) else {
            return Err(PairError::LowRail {
                rail: rail.name().to_owned(),
                gauge_depth_m: installation.gauge_depth_m,
            });
        };
        let points = wheel.points();
        let Some((tip, tread_end)) = flange(points) else {
            return Err(PairError::NoFlange {
                wheel: wheel.name().to_owned(),
            });
        };
        let steepest = (tip..=tread_end)
            .min_by(|&i, &j| points[i].angle_rad.total_cmp(&points[j].angle_rad))
            .map_or(tip, |steepest| {
                // Takes the innermost point within 0.1 degrees of the steepest angle, because a wheel in contact on a
                // straight flange face does not climb yet.
                let bound = points[steepest].angle_rad + 1.7e-3;
                (tip..=steepest)
                    .find(|&i| points[i].angle_rad <= bound)
                    .unwrap_or(steepest)
            });
        let top = laid.points().iter().min_by(|p, q| p.z_m.total_cmp(&q.z_m));
        Ok(Self {
            rail_top_m: top.map_or(0.0, |point| point.y_m),
            tread_end_m: points[tread_end].y_m,
            steepest_flange_m: points[steepest].y_m,
            flange_tip_m: points[tip].y_m,
            wheel_slopes: slopes(&wheel),
            rail_slopes: slopes(&laid),
            wheel,
            rail: laid,
            installation,
        })
    }

    /// The wheel profile S1002 on the rail profile UIC 60.
    ///
    /// # Errors
    /// The installation is invalid, see [`Pair::new`].
    ///
    /// ```
    /// use dashpot_rail::contact::{Installation, Pair};
    /// let pair = Pair::standard(Installation::default())?;
    /// // The rail is in track axes: its gauge face lies at half the gauge, 14 mm below the top.
    /// let gauge_face = pair.rail().at(0.7175);
    /// assert!((gauge_face.z_m - 0.014).abs() < 1e-5);
    /// # Ok::<(), dashpot_rail::contact::PairError>(())
    /// ```
    pub fn standard(installation: Installation) -> Result<Self, PairError> {
        Self::new(s1002::profile(), &uic60::profile(), installation)
    }

    /// The wheel's profile, relative to its tread datum.
    pub fn wheel(&self) -> &Profile {
        &self.wheel
    }

    /// The rail's profile in track axes: `y` from the track centre, `z` below the rail's top.
    pub fn rail(&self) -> &Profile {
        &self.rail
    }

    /// The dimensions of wheelset and track.
    pub fn installation(&self) -> &Installation {
        &self.installation
    }

    /// Lateral position of the rail's top from the track centre, m.
    pub fn rail_top_m(&self) -> f64 {
        self.rail_top_m
    }

    /// Position on the wheel at which the tread meets the flange, m from the tread datum.
    pub fn tread_end_m(&self) -> f64 {
        self.tread_end_m
    }

    /// Position of the steepest point of the flange, m from the tread datum. A wheel whose contact lies at a smaller
    /// value climbs.
    pub fn steepest_flange_m(&self) -> f64 {
        self.steepest_flange_m
    }

    /// Flange angle: the maximum angle of the flange face against the axle, rad.
    ///
    /// ```
    /// use dashpot_rail::contact::{Installation, Pair};
    /// // S1002: 70 degrees.
    /// let pair = Pair::standard(Installation::default())?;
    /// assert!((pair.flange_angle_rad().to_degrees() - 70.0).abs() < 0.1);
    /// # Ok::<(), dashpot_rail::contact::PairError>(())
    /// ```
    pub fn flange_angle_rad(&self) -> f64 {
        -self.wheel.at(self.steepest_flange_m).angle_rad
    }

    /// Position of the flange tip, m from the tread datum.
    pub fn flange_tip_m(&self) -> f64 {
        self.flange_tip_m
    }
}

/// Indices of the flange tip and of the end of the flange face towards the tread.
///
/// The search for the face starts at the tip, because a chamfer on the field side is steep as well.
fn flange(points: &[ProfilePoint]) -> Option<(usize, usize)> {
    let tip = (1..points.len()).max_by(|&i, &j| points[i].z_m.total_cmp(&points[j].z_m))?;
    let steep = |point: &ProfilePoint| point.angle_rad < -FLANGE_ANGLE;
    let face = tip + points[tip..].iter().position(steep)?;
    let root = points[face..].iter().position(|point| !steep(point))?;
    Some((tip, face + root - 1))
}

/// `dz/dy` at every sample.
fn slopes(profile: &Profile) -> Vec<f64> {
    profile
        .points()
        .iter()
        .map(|p| libm::tan(p.angle_rad))
        .collect()
}
