//! Four loaded contacts in vector lanes.

use fearless_simd::{Simd, f64x4};

use super::creepage::Creepage;
use super::kalker::KalkerCoefficients;
use super::loaded_contact::LoadedContact;
use crate::math::each::Each;

/// Four loaded contacts and their creepages, one per vector lane; the input of [`CreepLaw::forces_in_lanes`].
///
/// Units and signs are those of [`LoadedContact`] and [`Creepage`].
///
/// [`CreepLaw::forces_in_lanes`]: super::CreepLaw::forces_in_lanes
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct ContactLanes<S: Simd> {
    /// Normal loads, N.
    pub load: f64x4<S>,
    /// Semi-axes in the rolling direction and across, m.
    pub semi_axes: [f64x4<S>; 2],
    /// Shear modulus of all contacts, Pa.
    pub shear_modulus: f64,
    /// Kalker's coefficients of the ellipses.
    pub kalker: KalkerCoefficients<f64x4<S>>,
    /// Friction coefficients at the sliding speeds of the contacts.
    pub friction: f64x4<S>,
    /// Longitudinal creepages, lateral creepages, and spins, 1/m.
    pub creepage: [f64x4<S>; 3],
}

impl<S: Simd> ContactLanes<S> {
    /// Returns the contact in one lane.
    #[inline(always)]
    pub fn in_lane(&self, lane: usize) -> (LoadedContact, Creepage) {
        let contact = LoadedContact {
            load_n: self.load[lane],
            a_m: self.semi_axes[0][lane],
            b_m: self.semi_axes[1][lane],
            shear_modulus_pa: self.shear_modulus,
            kalker: KalkerCoefficients {
                c11: self.kalker.c11[lane],
                c22: self.kalker.c22[lane],
                c23: self.kalker.c23[lane],
                c33: self.kalker.c33[lane],
            },
            friction: self.friction[lane],
        };
        (
            contact,
            Creepage::of(self.creepage.each(|number| number[lane])),
        )
    }
}
