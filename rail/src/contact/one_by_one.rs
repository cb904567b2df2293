//! Evaluates one wheel after the other, with derivatives with respect to every field of the motion.

use std::array::from_fn;

use super::forces::{WheelDerivatives, WheelsetForces};
use super::frame::Frame;
use super::loaded_zones::LoadedZones;
use super::motion::{MOTION_FIELDS, Motion, MotionNumbers, RailDisplacement, RailNumbers, Tangent};
use super::silhouette::WheelPose;
use super::source::{PatchReader, PatchSource, differentiated};
use super::wheel::{MovingWheel, Wrench, status};
use super::wheelset::WheelsetContact;
use super::zones::ZONES;
use crate::creep::CreepLaw;

impl<L: CreepLaw, S: PatchSource> WheelsetContact<L, S> {
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
        for side in 0..2 {
            let sign = if side == 0 { -1.0 } else { 1.0 };
            let numbers = MotionNumbers::new(motion, Tangent::variable, |value, field| {
                Tangent::variable(value, field) * sign
            });
            let rail = RailNumbers::new(
                |field| Tangent::constant(field(&rails[side])),
                |field| Tangent::constant(sign * field(&rails[side])),
            );
            let lengths = self.lengths[side].map(|length| Tangent::constant(*length));
            let moving = MovingWheel::new(Frame::new(&numbers), rail, lengths);
            let wheel = &mut forces.wheels[side];
            let source = self.sources[side].as_ref();
            let [lateral_m, roll_rad, yaw_rad] = moving.pose.map(|number| number.value());
            let reader = source.locate(&WheelPose {
                lateral_m,
                roll_rad,
                yaw_rad,
            });
            let heights = reader.interpenetrations_m();
            let depth = moving.depth.value();
            let loaded = |zone: usize| u32::from(heights[zone] + depth > 0.0) << zone;
            let mut zones = LoadedZones::new((0..ZONES).map(loaded).sum(), wheel);
            let (mut penetration_m, mut wheel_y_m) = (0.0_f64, f64::MAX);
            let mut wrench = Wrench::splat(Tangent::constant(0.0));
            while zones.are_left() {
                let (zone, _) = zones.advance();
                let (interpenetration, numbers) =
                    differentiated(&reader, zone, heights[zone], moving.pose);
                let depth = interpenetration + moving.depth;
                let patch = moving.patch(&self.surface, depth, numbers, [true; 4]);
                wrench.accumulate(&patch.wrench, |sum, term| sum + term);
                let mut output = patch.output.values();
                output.position[1] *= sign;
                wheel.patches[zone].set(output);
                penetration_m = penetration_m.max(output.penetration);
                wheel_y_m = wheel_y_m.min(output.wheel_y);
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
            derivatives[side] = WheelDerivatives::new(&wrench, sign);
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
