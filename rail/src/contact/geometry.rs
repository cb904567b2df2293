//! Contact patches of a pair at any pose, computed from the profiles.

use super::hertz::{Steel, SteelError};
use super::pair::Pair;
use super::patches::softness_m;
use super::silhouette::{SilhouettePoint, TurnedWheel, WheelPose};
use super::tabulated_patch::TabulatedPatch;
use super::zones::{ZONES, Zones};
use crate::creep::{KalkerError, KalkerTable};

/// Minimum and maximum nominal wheel load, N.
pub const NOMINAL_LOAD_RANGE_N: [f64; 2] = [100.0, 1e6];

/// Errors from computing the contact of a pair.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GeometryError {
    /// The elastic constants are out of bounds.
    #[error(transparent)]
    Steel(#[from] SteelError),
    /// There are no Kalker coefficients for the Poisson's ratio.
    #[error(transparent)]
    Kalker(#[from] KalkerError),
    /// The nominal load is out of bounds.
    #[error(
        "nominal load: {nominal_load_n} N, allowed: {} to {} N per wheel",
        NOMINAL_LOAD_RANGE_N[0], NOMINAL_LOAD_RANGE_N[1]
    )]
    NominalLoad {
        /// The load, N.
        nominal_load_n: f64,
    },
}

/// A pair of elastic bodies: everything that the contact of a wheel depends on, apart from its pose.
#[derive(Debug, Clone)]
pub struct ContactGeometry {
    pair: Pair,
    steel: Steel,
    nominal_load_n: f64,
    softness_m: f64,
    zones: Zones,
    kalker: KalkerTable,
}

impl ContactGeometry {
    /// Contact of `pair`, with both bodies of `steel`. The nominal wheel load, N, determines the [softness](softness_m)
    /// and thereby the spread of the contact.
    ///
    /// # Errors
    /// The elastic constants or the load are out of bounds.
    ///
    /// ```
    /// use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel, WheelPose};
    /// let pair = Pair::standard(Installation::default())?;
    /// let geometry = ContactGeometry::new(pair, Steel::default(), 100e3)?;
    /// let shifted = WheelPose { lateral_m: 3e-3, ..WheelPose::default() };
    /// let deepest = geometry
    ///     .patches(&shifted, &mut Vec::new())
    ///     .into_iter()
    ///     .max_by(|p, q| p.interpenetration_m.total_cmp(&q.interpenetration_m));
    /// // An elastic half-space under 100 kN touches 740.30 mm from the track centre.
    /// let wheel_y_m = deepest.map_or(0.0, |patch| patch.wheel_y_m);
    /// assert!((0.750 + 3e-3 + wheel_y_m - 0.74030).abs() < 0.2e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(pair: Pair, steel: Steel, nominal_load_n: f64) -> Result<Self, GeometryError> {
        steel.check()?;
        let [min, max] = NOMINAL_LOAD_RANGE_N;
        if !(min..=max).contains(&nominal_load_n) {
            return Err(GeometryError::NominalLoad { nominal_load_n });
        }
        Ok(Self {
            softness_m: softness_m(&steel, pair.installation().wheel_radius_m, nominal_load_n),
            zones: Zones::new(&pair),
            kalker: KalkerTable::new(steel.poisson_ratio)?,
            pair,
            steel,
            nominal_load_n,
        })
    }

    /// The pair of profiles.
    pub fn pair(&self) -> &Pair {
        &self.pair
    }

    /// The elastic constants.
    pub fn steel(&self) -> &Steel {
        &self.steel
    }

    /// The nominal wheel load, N.
    pub fn nominal_load_n(&self) -> f64 {
        self.nominal_load_n
    }

    /// The softness of the contact, m.
    pub fn softness_m(&self) -> f64 {
        self.softness_m
    }

    /// The zones of the wheel.
    pub fn zones(&self) -> &Zones {
        &self.zones
    }

    /// Computes the patch of each zone at `pose`, from the flange to the field side. `scratch` is working memory and is
    /// overwritten.
    pub fn patches(
        &self,
        pose: &WheelPose,
        scratch: &mut Vec<SilhouettePoint>,
    ) -> [TabulatedPatch; ZONES] {
        let wheel = self.pair.turned(pose.roll_rad, pose.yaw_rad);
        self.patches_of(&wheel, pose.lateral_m, scratch)
    }

    /// Computes [`patches`](ContactGeometry::patches) for a wheel that is already rotated by its roll and yaw, at a
    /// lateral shift.
    pub fn patches_of(
        &self,
        wheel: &TurnedWheel<'_>,
        lateral_m: f64,
        scratch: &mut Vec<SilhouettePoint>,
    ) -> [TabulatedPatch; ZONES] {
        wheel
            .patches(lateral_m, &self.zones, self.softness_m, scratch)
            .map(|patch| {
                TabulatedPatch::new(
                    &self.pair,
                    &self.steel,
                    &self.kalker,
                    &patch,
                    wheel.roll_rad,
                )
            })
    }
}
