//! Wear laws: the volume that a strip of a contact patch loses.

mod archard;
mod t_gamma;

pub use archard::Archard;
pub use t_gamma::TGamma;

use crate::patch::WearingPatch;
use crate::strips::Strip;

/// A wear law. Each is fitted to tests in the laboratory, so every result is an estimate.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum WearLaw {
    /// Archard's law with coefficients over pressure and sliding speed.
    Archard(Archard),
    /// Wear rate over the friction work per contact area.
    TGamma(TGamma),
}

impl Default for WearLaw {
    /// [`Archard::default`].
    fn default() -> Self {
        Self::Archard(Archard::default())
    }
}

impl WearLaw {
    /// [`TGamma::default`].
    pub fn t_gamma() -> Self {
        Self::TGamma(TGamma::default())
    }

    /// Name of the law.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Archard(_) => "Archard, KTH chart",
            Self::TGamma(_) => "T-gamma per area, Sheffield (R8T on UIC 60 900A)",
        }
    }

    /// Publication of the law and of its coefficients.
    pub fn source(&self) -> &'static str {
        match self {
            Self::Archard(_) => "Jendel, Wear 253 (2002) 89-99",
            Self::TGamma(_) => "Braghin et al., Wear 261 (2006) 1253-1264",
        }
    }

    /// Volume that one body loses in a strip of the patch per metre rolled, m^3/m.
    #[inline]
    pub(crate) fn volume_rate_m2(&self, patch: &WearingPatch, strip: &Strip) -> f64 {
        match self {
            Self::Archard(law) => law.volume_rate_m2(patch, strip),
            Self::TGamma(law) => law.volume_rate_m2(patch, strip),
        }
    }
}
