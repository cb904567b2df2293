//! Contact forces on a wheelset: both wheels, each on its own rail.

use std::sync::Arc;

use fearless_simd::Level;

use super::forces::{WheelDerivatives, WheelsetForces};
use super::geometry::ContactGeometry;
use super::motion::{Motion, RailDisplacement};
use super::source::PatchSource;
use super::surface::{MAX_NORMAL_DAMPING_S_PER_M, Surface, SurfaceError};
use super::tables::Tables;
use super::wheel_lengths::WheelLengths;
use crate::creep::{CreepLaw, Friction};
use crate::math::dispatch::dispatch;

/// The contact of a wheelset. It is constant and can be shared by all wheelsets with the same profiles.
///
/// ```
/// # use std::sync::Arc;
/// # use dashpot_rail::contact::{
/// #     ContactGeometry, Installation, Motion, Pair, RailDisplacement, Steel, Tables, WheelsetContact,
/// # };
/// # use dashpot_rail::creep::{Friction, Polach};
/// let pair = Pair::standard(Installation::default())?;
/// let tables = Tables::new(ContactGeometry::new(pair, Steel::default())?);
/// let contact = WheelsetContact::new(Arc::new(tables), Polach, Friction::default())?;
/// let shifted = Motion { lateral_m: 3e-3, vertical_m: 0.0708e-3, ..Motion::default() };
/// let forces = contact.forces(&shifted, &[RailDisplacement::default(); 2]);
/// // An elastic half-space then carries 100 kN on the right wheel. The rail pushes up, against the z axis.
/// assert!((forces.wheels[1].force_n[2] / -100e3 - 1.0).abs() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct WheelsetContact<L, S: PatchSource = Tables> {
    /// Sources of the left wheel (of its mirror image on the right side) and of the right wheel.
    pub(super) sources: [Arc<S>; 2],
    pub(super) surface: Surface<L>,
    pub(super) lengths: [WheelLengths<f64>; 2],
    pub(super) lengths_in_lanes: WheelLengths<[f64; 4]>,
    pub(super) level: Level,
}

impl<L: CreepLaw, S: PatchSource> WheelsetContact<L, S> {
    /// Contact of two equal wheels on equal rails, with the patches of `source`.
    ///
    /// # Errors
    /// The friction is out of bounds.
    pub fn new(source: Arc<S>, law: L, friction: Friction) -> Result<Self, SurfaceError> {
        Self::with_sides([Arc::clone(&source), source], law, friction)
    }

    /// Contact of a left and a right wheel that differ in profile, diameter or rail inclination.
    ///
    /// The left pair is given as its mirror image, as if it were on the right side. The shear modulus is the mean of
    /// both sides.
    ///
    /// # Errors
    /// The friction is out of bounds.
    pub fn with_sides(
        [left, right]: [Arc<S>; 2],
        law: L,
        friction: Friction,
    ) -> Result<Self, SurfaceError> {
        friction.check()?;
        let mean = |length: fn(&ContactGeometry) -> f64| {
            0.5 * (length(left.geometry()) + length(right.geometry()))
        };
        let surface = Surface {
            law,
            friction,
            shear_modulus_pa: mean(|geometry| geometry.steel().shear_modulus_pa()),
            kalker: left.geometry().kalker().mean(right.geometry().kalker()),
            normal_damping_s_per_m: 0.0,
        };
        let height_m = mean(|geometry| geometry.pair().installation().wheel_radius_m);
        let lengths = [&left, &right].map(|side| WheelLengths::new(side.geometry(), height_m));
        let [left_lengths, right_lengths] = &lengths;
        let in_lanes = |left: &f64, right: &f64| [*left, *right, *left, *right];
        Ok(Self {
            surface,
            lengths_in_lanes: left_lengths.zip(right_lengths, in_lanes),
            lengths,
            level: crate::math::level(),
            sources: [left, right],
        })
    }

    /// Sets the normal damping `beta` of Hunt and Crossley, s/m; the default is zero.
    ///
    /// The elastic load is multiplied by `1 + beta w`, where `w` is the approach speed of the surfaces. It is never
    /// negative.
    ///
    /// # Errors
    /// The damping is not within 0 to [`MAX_NORMAL_DAMPING_S_PER_M`].
    pub fn with_normal_damping(
        mut self,
        normal_damping_s_per_m: f64,
    ) -> Result<Self, SurfaceError> {
        if !(0.0..=MAX_NORMAL_DAMPING_S_PER_M).contains(&normal_damping_s_per_m) {
            return Err(SurfaceError::NormalDamping {
                normal_damping_s_per_m,
            });
        }
        self.surface.normal_damping_s_per_m = normal_damping_s_per_m;
        Ok(self)
    }

    /// Sources of the patches of the left and the right wheel.
    pub fn sources(&self) -> &[Arc<S>; 2] {
        &self.sources
    }

    /// Shear modulus, mean of both sides, Pa.
    pub fn shear_modulus_pa(&self) -> f64 {
        self.surface.shear_modulus_pa
    }

    /// Normal damping, s/m.
    pub fn normal_damping_s_per_m(&self) -> f64 {
        self.surface.normal_damping_s_per_m
    }

    /// Computes the forces on a wheelset in `motion` over the left and the right rail.
    ///
    /// Cannot fail: [`Status`](super::Status) reports a motion outside the tables or with NaN.
    #[inline]
    pub fn forces(&self, motion: &Motion, rails: &[RailDisplacement; 2]) -> WheelsetForces {
        let mut forces = WheelsetForces::default();
        self.update(motion, rails, &mut forces);
        forces
    }

    /// Computes the forces like [`forces`](WheelsetContact::forces), and writes them over those of the previous step,
    /// which avoids a copy.
    ///
    /// Does not allocate if the source is [`Tables`].
    #[inline]
    pub fn update(
        &self,
        motion: &Motion,
        rails: &[RailDisplacement; 2],
        forces: &mut WheelsetForces,
    ) {
        let are_few = dispatch!(self.level, simd => {
            self.update_side_by_side::<false, _>(simd, motion, rails, forces)
        });
        if !are_few {
            self.update_many(motion, rails, forces);
        }
    }

    /// Computes the forces like [`update`](WheelsetContact::update), and returns the derivatives of force and moment on
    /// the left and the right wheel with respect to every field of [`Motion`].
    ///
    /// For the lateral and vertical displacement and velocity of a wheel's own rail, the derivatives are the negatives
    /// of those for the displacement and velocity of the wheelset.
    #[inline]
    pub fn update_with_derivatives(
        &self,
        motion: &Motion,
        rails: &[RailDisplacement; 2],
        forces: &mut WheelsetForces,
    ) -> [WheelDerivatives; 2] {
        self.update_one_by_one(motion, rails, forces)
    }
}
