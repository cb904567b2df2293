//! Four loaded contacts side by side.

use fearless_simd::{Simd, f64x4};

use super::creepage::Creepage;
use super::kalker::KalkerCoefficients;
use super::law::LoadedContact;
use crate::math::each::Each;

/// Four loaded contacts and their creepages, the fields as those of [`LoadedContact`] and [`Creepage`].
#[derive(Clone, Copy)]
pub struct ContactLanes<S: Simd> {
    pub(crate) load: f64x4<S>,
    pub(crate) semi_axes: [f64x4<S>; 2],
    pub(crate) shear_modulus: f64,
    /// `C11`, `C22`, `C23`, `C33`.
    pub(crate) kalker: [f64x4<S>; 4],
    pub(crate) friction: f64x4<S>,
    /// Longitudinal, lateral, spin.
    pub(crate) creepage: [f64x4<S>; 3],
}

impl<S: Simd> ContactLanes<S> {
    /// The contact in one lane.
    #[inline(always)]
    pub(super) fn in_lane(&self, lane: usize) -> (LoadedContact, Creepage) {
        let [c11, c22, c23, c33] = self.kalker.each(|number| number[lane]);
        let contact = LoadedContact {
            load_n: self.load[lane],
            a_m: self.semi_axes[0][lane],
            b_m: self.semi_axes[1][lane],
            shear_modulus_pa: self.shear_modulus,
            kalker: KalkerCoefficients { c11, c22, c23, c33 },
            friction: self.friction[lane],
        };
        (
            contact,
            Creepage::of(self.creepage.each(|number| number[lane])),
        )
    }
}
