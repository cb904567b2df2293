//! Distances between the wheels of a wheelset and between the rails of a track.

use crate::profile::s1002;
use crate::setters::setters;

/// Dimensions of a wheelset and of a track.
///
/// ```
/// use dashpot_rail::contact::Installation;
/// let narrow = Installation::default().with_gauge_m(1.432);
/// assert_eq!(narrow.datum_offset_m(), 0.750);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Installation {
    /// Radius of the wheel at the tread datum, m.
    pub wheel_radius_m: f64,
    /// Distance between the backs of the two flanges, m.
    pub back_to_back_m: f64,
    /// Distance from the back of the flange to the tread datum, m.
    pub back_to_datum_m: f64,
    /// Track gauge, m.
    pub gauge_m: f64,
    /// Depth below the top of the rails at which the gauge is measured, m.
    pub gauge_depth_m: f64,
    /// Inclination of the rails towards the track centre, dimensionless: 0.025 is 1:40.
    pub inclination: f64,
}

/// Errors in an [`Installation`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InstallationError {
    /// A distance is out of bounds.
    #[error("{name}: {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    OutOfBounds {
        /// Name of the quantity.
        name: &'static str,
        /// Its value, in m, or dimensionless for the inclination.
        value: f64,
        /// Minimum and maximum allowed value.
        allowed: [f64; 2],
    },
    /// Gauge and back-to-back distance do not match.
    #[error("gauge minus back-to-back distance: {play_m:.4} m, allowed: 0.03 to 0.12 m")]
    Play {
        /// Gauge minus back-to-back distance, m.
        play_m: f64,
    },
}

impl Default for Installation {
    /// [`Installation::STANDARD`].
    fn default() -> Self {
        Self::STANDARD
    }
}

impl Installation {
    /// Wheel radius 0.625 m, 1360 mm back to back, gauge 1435 mm measured at 14 mm depth, inclination 1:40.
    pub const STANDARD: Self = Self {
        wheel_radius_m: 0.625,
        back_to_back_m: 1.360,
        back_to_datum_m: s1002::FLANGE_BACK_TO_DATUM_M,
        gauge_m: 1.435,
        gauge_depth_m: 0.014,
        inclination: 1.0 / 40.0,
    };

    setters! {
        with_wheel_radius_m sets wheel_radius_m: f64;
        with_back_to_back_m sets back_to_back_m: f64;
        with_back_to_datum_m sets back_to_datum_m: f64;
        with_gauge_m sets gauge_m: f64;
        with_gauge_depth_m sets gauge_depth_m: f64;
        with_inclination sets inclination: f64;
    }

    /// Lateral distance of the tread datum from the track centre, for a centred wheelset, m.
    pub fn datum_offset_m(&self) -> f64 {
        0.5 * self.back_to_back_m + self.back_to_datum_m
    }

    /// Checks every dimension, and the play between wheelset and rails.
    ///
    /// # Errors
    /// A dimension is out of bounds.
    pub fn check(&self) -> Result<(), InstallationError> {
        let allowed = [
            ("wheel radius", self.wheel_radius_m, 0.1, 1.0),
            ("back-to-back distance", self.back_to_back_m, 0.4, 2.0),
            (
                "back of the flange to tread datum",
                self.back_to_datum_m,
                0.02,
                0.15,
            ),
            ("gauge", self.gauge_m, 0.5, 2.0),
            ("gauge depth", self.gauge_depth_m, 0.005, 0.03),
            ("rail inclination", self.inclination, -0.1, 0.1),
        ];
        for (name, value, low, high) in allowed {
            if !(low..=high).contains(&value) {
                return Err(InstallationError::OutOfBounds {
                    name,
                    value,
                    allowed: [low, high],
                });
            }
        }
        let play_m = self.gauge_m - self.back_to_back_m;
        if !(0.03..=0.12).contains(&play_m) {
            return Err(InstallationError::Play { play_m });
        }
        Ok(())
    }
}
