//! Evaluates one wheel after the other, with derivatives with respect to every field of the motion.

use std::array::from_fn;

use super::forces::{WheelDerivatives, WheelsetForces};
use super::frame::Frame;
use super::loaded_zones::LoadedZones;
use super::motion::{MOTION_FIELDS, Motion, MotionNumbers, RailDisplacement, RailNumbers, Tangent};
use super::source::{PatchReader, PatchSource};
use super::wheel::{MovingWheel, status};
use super::wheelset::WheelsetContact;
use super::wrench::Wrench;
use crate::creep::CreepLaw;
use crate::math::dispatch::dispatch;

/// Sign of quantities that change when mirrored about the track centre, for the left (0) and the right wheel.
fn sign(side: usize) -> f64 {
    if side == 0 { -1.0 } else { 1.0 }
}

impl<L: CreepLaw, S: PatchSource> WheelsetContact<L, S> {
    /// The right wheel, or the mirror image of the left wheel, over its rail.
    #[inline]
    pub(super) fn moving_wheel(
        &self,
        side: usize,
        motion: &Motion,
        rails: &[RailDisplacement; 2],
    ) -> MovingWheel<Tangent> {
        let sign = sign(side);
        let numbers = MotionNumbers::new(
            |field, number| Tangent::variable(field(motion), number),
            |field, number| Tangent::variable(field(motion), number) * sign,
        );
        let rail = RailNumbers::new(
            |field| Tangent::constant(field(&rails[side])),
            |field| Tangent::constant(sign * field(&rails[side])),
        );
        let lengths = self.lengths[side].map(|length| Tangent::constant(*length));
        MovingWheel::new(Frame::new(&numbers, &rail), rail, lengths)
    }

    #[inline]
    pub(super) fn update_one_by_one(
        &self,
        motion: &Motion,
        rails: &[RailDisplacement; 2],
        forces: &mut WheelsetForces,
    ) -> [WheelDerivatives; 2] {
        let mut derivatives = [WheelDerivatives::default(); 2];
        if !forces.begin(motion, rails) {
            return derivatives;
        }
        let mut wrenches = Wrench::splat([0.0; 2]);
        for (side, derivatives) in derivatives.iter_mut().enumerate() {
            let sign = sign(side);
            let moving = self.moving_wheel(side, motion, rails);
            let wheel = &mut forces.wheels[side];
            let source = self.sources[side].as_ref();
            let (pose, depth_m) = (moving.pose(), moving.depth.value());
            let reader = dispatch!(self.level, simd => source.locate(simd, &pose, depth_m));
            let mut zones = LoadedZones::new(reader.loaded_zones(), wheel);
            let growth = Tangent::constant(reader.growth_per_m());
            let (mut penetration_m, mut wheel_y_m) = (0.0_f64, f64::MAX);
            let mut wrench = Wrench::splat(Tangent::constant(0.0));
            while zones.are_left() {
                let (zone, _) = zones.advance();
                let [lateral, roll, yaw] = moving.pose;
                let coordinates = [lateral, roll, yaw, moving.depth];
                let (approach, numbers) = reader.differentiated(zone, coordinates);
                let patch = moving.patch(&self.surface, [approach, growth], numbers, [true; 4]);
                wrench.accumulate(&patch.wrench, |sum, term| sum + term);
                let mut output = patch.output.values();
                output.position[1] *= sign;
                wheel.patches[zone].set(output);
                penetration_m = penetration_m.max(output.penetration);
                if output.load > 0.0 {
                    wheel_y_m = wheel_y_m.min(output.wheel_y);
                }
            }
            wheel.status = status(
                source.geometry().pair(),
                reader.is_inside(),
                wheel.loaded_zones != 0,
                penetration_m,
                wheel_y_m,
            );
            for k in 0..3 {
                wrenches.force[k][side] = wrench.force[k].value();
                wrenches.moment[k][side] = wrench.moment[k].value();
            }
            *derivatives = WheelDerivatives::new(&wrench, sign);
        }
        forces.set_wrenches(wrenches);
        derivatives
    }
}

impl WheelDerivatives {
    /// Derivatives of the wrench on the right wheel (`sign` 1) or on the mirror image of the left wheel (`sign` -1).
    fn new(wrench: &Wrench<Tangent>, sign: f64) -> Self {
        let by_field = |number: &Tangent, sign: f64| -> [f64; MOTION_FIELDS] {
            from_fn(|field| sign * f64::from(number.derivatives()[field]))
        };
        let [fx, fy, fz] = &wrench.force;
        let [mx, my, mz] = &wrench.moment;
        Self {
            force: [by_field(fx, 1.0), by_field(fy, sign), by_field(fz, 1.0)],
            moment: [by_field(mx, sign), by_field(my, 1.0), by_field(mz, sign)],
        }
    }
}
