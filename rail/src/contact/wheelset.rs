//! Contact forces on a wheelset: both wheels, each on its own rail.

use std::sync::Arc;

use super::forces::{Status, WheelDerivatives, WheelForces, WheelsetForces};
use super::frame::Frame;
use super::geometry::ContactGeometry;
use super::motion::{MOTION_FIELDS, Motion, MotionNumbers, RailDisplacement};
use super::source::PatchSource;
use super::surface::{MAX_NORMAL_DAMPING_S_PER_M, Surface, SurfaceError};
use super::tables::Tables;
use super::wheel::{Wheel, Wrench};
use crate::creep::{CreepLaw, Friction};
use crate::math::number::{Dual, Number};

/// The contact of a wheelset: constant, shared by every wheelset of the same profiles.
///
/// ```
/// # use std::sync::Arc;
/// # use dashpot_rail::contact::{ContactGeometry, Grid, Installation, Motion, Pair, RailDisplacement, Steel, Tables, WheelsetContact};
/// # use dashpot_rail::creep::{Friction, Polach};
/// # let mut grid = Grid::default();
/// # grid.roll_rad.cells = [1, 2, 1];
/// # grid.yaw_squared_rad2.cells = [0, 1, 1];
/// let pair = Pair::standard(Installation::default())?;
/// let tables = Tables::new(ContactGeometry::new(pair, Steel::default(), 80e3)?, grid)?;
/// let contact = WheelsetContact::new(Arc::new(tables), Polach, Friction::default())?;
/// let pressed = Motion { vertical_m: 0.25e-3, ..Motion::default() };
/// let forces = contact.forces(&pressed, &[RailDisplacement::default(); 2]);
/// // The rails push up, against the axis z.
/// assert!((forces.force_n[2] / -156.3e3 - 1.0).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct WheelsetContact<L, S = Tables> {
    /// Of the left wheel (as its mirror image on the right side) and of the right wheel.
    sources: [Arc<S>; 2],
    surface: Surface<L>,
    height_m: f64,
}

impl<L: CreepLaw, S: PatchSource> WheelsetContact<L, S> {
    /// The contact of two equal wheels on equal rails, with the patches of `source`.
    ///
    /// # Errors
    /// A friction out of its bounds.
    pub fn new(source: Arc<S>, law: L, friction: Friction) -> Result<Self, SurfaceError> {
        Self::with_sides([Arc::clone(&source), source], law, friction)
    }

    /// The contact of a left and a right wheel that differ in profiles, diameter, or inclination of the rail.
    ///
    /// The left pair is described as its mirror image: as if it were on the right side. The shear modulus is the
    /// mean of both sides.
    ///
    /// # Errors
    /// A friction out of its bounds.
    pub fn with_sides(
        [left, right]: [Arc<S>; 2],
        law: L,
        friction: Friction,
    ) -> Result<Self, SurfaceError> {
        friction.check()?;
        let mean = |of: fn(&ContactGeometry) -> f64| {
            0.5 * (of(left.geometry()) + of(right.geometry()))
        };
        let surface = Surface {
            law,
            friction,
            shear_modulus_pa: mean(|geometry| geometry.steel().shear_modulus_pa()),
            normal_damping_s_per_m: 0.0,
        };
        Ok(Self {
            height_m: mean(|geometry| geometry.pair().installation().wheel_radius_m),
            surface,
            sources: [left, right],
        })
    }

    /// The same with the normal damping `beta` of Hunt and Crossley, s/m: the load is `k penetration^1.5 (1 + beta w)` with the
    /// speed `w` at which the surfaces approach each other, and never negative. Zero unless set.
    ///
    /// # Errors
    /// A damping not within 0 to [`MAX_NORMAL_DAMPING_S_PER_M`].
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

    /// The sources of the patches of the left and the right wheel.
    pub fn sources(&self) -> &[Arc<S>; 2] {
        &self.sources
    }

    /// Forces on a wheelset in `motion` over the left and the right rail.
    ///
    /// Does not fail: [`Status`] reports a motion that is beyond the tables or contains NaN.
    #[inline]
    pub fn forces(&self, motion: &Motion, rails: &[RailDisplacement; 2]) -> WheelsetForces {
        let mut forces = WheelsetForces::default();
        self.update(motion, rails, &mut forces);
        forces
    }

    /// [`forces`](WheelsetContact::forces) written over those of the step before, which saves copying them.
    ///
    /// Does not allocate with [`Tables`].
    #[inline]
    pub fn update(
        &self,
        motion: &Motion,
        rails: &[RailDisplacement; 2],
        forces: &mut WheelsetForces,
    ) {
        self.evaluate(motion.numbers(), rails, forces);
    }

    /// As [`update`](WheelsetContact::update), and the derivatives of force and moment on the left and the right wheel by
    /// every field of [`Motion`].
    ///
    /// A wheel's derivatives by the lateral and vertical displacement and velocity of its own rail are the negative ones
    /// of the wheelset's.
    #[inline]
    pub fn update_with_derivatives(
        &self,
        motion: &Motion,
        rails: &[RailDisplacement; 2],
        forces: &mut WheelsetForces,
    ) -> [WheelDerivatives; 2] {
        let values = motion.numbers();
        let variables = std::array::from_fn(|field| Dual::variable(values[field], field));
        self.evaluate(variables, rails, forces)
            .map(|wrench| WheelDerivatives::of(&wrench))
    }

    /// Writes the forces and returns the wrench on each wheel.
    #[inline(always)]
    fn evaluate<T: Number>(
        &self,
        motion: MotionNumbers<T>,
        rails: &[RailDisplacement; 2],
        forces: &mut WheelsetForces,
    ) -> [Wrench<T>; 2] {
        let frame = Frame::new(&motion);
        let accepted = super::motion::all_accepted(motion.map(T::value));
        let frames = [frame.mirrored(), frame];
        let mut wrenches = [[T::constant(0.0); 6]; 2];
        for side in 0..2 {
            let wheel_forces = &mut forces.wheels[side];
            let rail = if side == 0 { rails[0].mirrored() } else { rails[1] };
            if !(accepted && rail.is_accepted()) {
                *wheel_forces = WheelForces {
                    status: Status::NotFinite,
                    ..WheelForces::default()
                };
                continue;
            }
            let wheel = Wheel {
                source: self.sources[side].as_ref(),
                surface: &self.surface,
                height_m: self.height_m,
            };
            let mut wrench = wheel.wrench(&frames[side], &rail, wheel_forces);
            if side == 0 {
                wheel_forces.mirror_patches();
                // Forces along y and moments about x and z change their sign in a mirror.
                for k in [1, 3, 5] {
                    wrench[k] = -wrench[k];
                }
            }
            let [fx, fy, fz, mx, my, mz] = wrench.map(T::value);
            wheel_forces.force_n = [fx, fy, fz];
            wheel_forces.moment_n_m = [mx, my, mz];
            wrenches[side] = wrench;
        }
        let [left, right] = &forces.wheels;
        for k in 0..3 {
            forces.force_n[k] = left.force_n[k] + right.force_n[k];
            forces.moment_n_m[k] = left.moment_n_m[k] + right.moment_n_m[k];
        }
        forces.status = left.status.max(right.status);
        wrenches
    }
}

impl WheelDerivatives {
    fn of(wrench: &Wrench<Dual>) -> Self {
        let by_field = |number: &Dual| {
            std::array::from_fn::<f64, MOTION_FIELDS, _>(|field| {
                f64::from(number.derivatives()[field])
            })
        };
        let [fx, fy, fz, mx, my, mz] = wrench;
        Self {
            force: [fx, fy, fz].map(by_field),
            moment: [mx, my, mz].map(by_field),
        }
    }
}
