//! Contact forces on a wheelset: both wheels, each on its own rail.

use std::array::from_fn;
use std::sync::Arc;

use super::forces::{Status, WheelDerivatives, WheelsetForces};
use super::frame::Frame;
use super::geometry::ContactGeometry;
use super::loaded_zones::LoadedZones;
use super::motion::{MOTION_FIELDS, Motion, ODD, RailDisplacement, RailNumbers, Tangent};
use super::source::{PatchSource, functions_of_pose};
use super::surface::{MAX_NORMAL_DAMPING_S_PER_M, Surface, SurfaceError};
use super::tables::Tables;
use super::wheel::{Place, WheelLengths, Wrench};
use crate::creep::{CreepLaw, Friction};
use crate::math::number::{Number, Sides};

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
/// let tables = Tables::new(ContactGeometry::new(pair, Steel::default(), 100e3)?, grid)?;
/// let contact = WheelsetContact::new(Arc::new(tables), Polach, Friction::default())?;
/// let shifted = Motion { lateral_m: 3e-3, vertical_m: 0.0708e-3, ..Motion::default() };
/// let forces = contact.forces(&shifted, &[RailDisplacement::default(); 2]);
/// // An elastic half-space carries 100 kN on the right wheel; the rail pushes up, against the axis z.
/// assert!((forces.wheels[1].force_n[2] / -100e3 - 1.0).abs() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct WheelsetContact<L, S = Tables> {
    /// Of the left wheel (as its mirror image on the right side) and of the right wheel.
    sources: [Arc<S>; 2],
    surface: Surface<L>,
    lengths: [WheelLengths<Tangent>; 2],
    lengths_of_sides: WheelLengths<Sides>,
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
        let mean =
            |of: fn(&ContactGeometry) -> f64| 0.5 * (of(left.geometry()) + of(right.geometry()));
        let surface = Surface {
            law,
            friction,
            shear_modulus_pa: mean(|geometry| geometry.steel().shear_modulus_pa()),
            normal_damping_s_per_m: 0.0,
        };
        let height_m = mean(|geometry| geometry.pair().installation().wheel_radius_m);
        let of_side = |side: &Arc<S>| {
            WheelLengths::new(|of| Tangent::constant(of(side.geometry())), height_m)
        };
        Ok(Self {
            surface,
            lengths: [of_side(&left), of_side(&right)],
            lengths_of_sides: WheelLengths::new(
                |of| Sides::from([of(left.geometry()), of(right.geometry())]),
                height_m,
            ),
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
        if !begin(motion, rails, forces) {
            return;
        }
        let values = motion.numbers();
        let numbers = from_fn(|field| {
            let left = if ODD[field] {
                -values[field]
            } else {
                values[field]
            };
            Sides::from([left, values[field]])
        });
        let rail = RailNumbers::new(
            |of| Sides::from([of(&rails[0]), of(&rails[1])]),
            |of| Sides::from([-of(&rails[0]), of(&rails[1])]),
        );
        let place = Place::new(Frame::new(&numbers), rail, self.lengths_of_sides);
        let [lateral, roll, yaw] = place.pose.map(<[f64; 2]>::from);
        let depth = <[f64; 2]>::from(place.depth);
        let [left, right] = &mut forces.wheels;
        let sources = self.sources.each_ref().map(|source| source.as_ref());
        let pose = |side: usize| [lateral[side], roll[side], yaw[side]];
        let left_zones = LoadedZones::of(sources[0], pose(0), depth[0], left);
        let right_zones = LoadedZones::of(sources[1], pose(1), depth[1], right);
        let mut wrench = [Sides::constant(0.0); 6];
        for k in 0..left_zones.count.max(right_zones.count) {
            // A wheel with fewer patches than the other computes one without load.
            let (left_depth, left_numbers) = left_zones.patch(k);
            let (right_depth, right_numbers) = right_zones.patch(k);
            let patch = place.patch(
                &self.surface,
                Sides::from([left_depth, right_depth]),
                from_fn(|n| Sides::from([left_numbers[n], right_numbers[n]])),
            );
            patch.add_to(&mut wrench);
            let [left_pair, right_pair] = sources.map(|source| source.geometry().pair());
            if k < left_zones.count {
                patch.write(0, left_pair, left_zones.zones[k], left);
            }
            if k < right_zones.count {
                patch.write(1, right_pair, right_zones.zones[k], right);
            }
        }
        let wrench = wrench.map(<[f64; 2]>::from);
        for side in 0..2 {
            forces.wheels[side].set_wrench(wrench.map(|sides| sides[side]));
        }
        finish(forces);
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
        let mut derivatives = [WheelDerivatives::default(); 2];
        if !begin(motion, rails, forces) {
            return derivatives;
        }
        let values = motion.numbers();
        for side in 0..2 {
            let sign = if side == 0 { -1.0 } else { 1.0 };
            let numbers = from_fn(|field| {
                let variable = Tangent::variable(values[field], field);
                if ODD[field] {
                    variable * sign
                } else {
                    variable
                }
            });
            let rail = RailNumbers::new(
                |of| Tangent::constant(of(&rails[side])),
                |of| Tangent::constant(sign * of(&rails[side])),
            );
            let place = Place::new(Frame::new(&numbers), rail, self.lengths[side]);
            let wheel = &mut forces.wheels[side];
            let source = self.sources[side].as_ref();
            let pose = place.pose.map(|number| number.value());
            let loaded = LoadedZones::of(source, pose, place.depth.value(), wheel);
            let mut wrench = [Tangent::constant(0.0); 6];
            for &zone in &loaded.zones[..loaded.count] {
                let value = loaded.interpenetrations[zone];
                let (interpenetration, numbers) =
                    functions_of_pose(&loaded.reader, zone, value, place.pose);
                let depth = interpenetration + place.depth;
                let patch = place.patch(&self.surface, depth, numbers);
                patch.add_to(&mut wrench);
                patch.write(0, source.geometry().pair(), zone, wheel);
            }
            wheel.set_wrench(wrench.map(|number| number.value()));
            derivatives[side] = WheelDerivatives::of(&wrench, sign);
        }
        finish(forces);
        derivatives
    }
}

/// Whether the motion is one that forces can be computed of; otherwise they are zero and say so.
#[inline(always)]
fn begin(motion: &Motion, rails: &[RailDisplacement; 2], forces: &mut WheelsetForces) -> bool {
    let accepted = motion.is_accepted() & rails[0].is_accepted() & rails[1].is_accepted();
    if !accepted {
        *forces = WheelsetForces::default();
        forces.status = Status::NotFinite;
        for wheel in &mut forces.wheels {
            wheel.status = Status::NotFinite;
        }
    }
    accepted
}

/// Turns the left wheel back from its mirror image and adds up both wheels.
#[inline(always)]
fn finish(forces: &mut WheelsetForces) {
    let [left, right] = &mut forces.wheels;
    left.mirror();
    for k in 0..3 {
        forces.force_n[k] = left.force_n[k] + right.force_n[k];
        forces.moment_n_m[k] = left.moment_n_m[k] + right.moment_n_m[k];
    }
    forces.status = left.status.max(right.status);
}

impl WheelDerivatives {
    /// Those of the wrench on a wheel, or on the mirror image (`sign` -1) of the left wheel.
    fn of(wrench: &Wrench<Tangent>, sign: f64) -> Self {
        let by_field = |number: &Tangent, sign: f64| -> [f64; MOTION_FIELDS] {
            from_fn(|field| sign * f64::from(number.derivatives()[field]))
        };
        let [fx, fy, fz, mx, my, mz] = wrench;
        Self {
            force: [by_field(fx, 1.0), by_field(fy, sign), by_field(fz, 1.0)],
            moment: [by_field(mx, sign), by_field(my, 1.0), by_field(mz, sign)],
        }
    }
}
