//! A pair of elastic bodies in contact.

use super::hertz::{Steel, SteelError};
use super::pair::Pair;
use super::zones::Zones;
use crate::creep::{KalkerError, KalkerLookup, KalkerTable};

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
}

/// A pair of elastic bodies: everything that the contact of a wheel depends on, apart from its pose and load.
#[derive(Debug, Clone)]
pub struct ContactGeometry {
    pair: Pair,
    steel: Steel,
    zones: Zones,
    kalker: KalkerLookup,
}

impl ContactGeometry {
    /// Contact of `pair`, with both bodies of `steel`.
    ///
    /// # Errors
    /// The elastic constants are out of bounds.
    pub fn new(pair: Pair, steel: Steel) -> Result<Self, GeometryError> {
        steel.check()?;
        Ok(Self {
            zones: Zones::new(&pair),
            kalker: KalkerLookup::new(&KalkerTable::new(steel.poisson_ratio)?),
            pair,
            steel,
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

    /// The zones of the wheel.
    pub fn zones(&self) -> &Zones {
        &self.zones
    }

    /// Kalker's coefficients for the steel.
    pub(super) fn kalker(&self) -> &KalkerLookup {
        &self.kalker
    }
}
