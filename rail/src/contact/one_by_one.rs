//! One wheel after the other, with derivatives by every field of the motion.

use std::array::from_fn;

use super::forces::{POSITION_Y, WheelDerivatives, WheelsetForces};
use super::frame::Frame;
use super::loaded_zones::LoadedZones;
use super::motion::{MOTION_FIELDS, Motion, ODD, RailDisplacement, RailNumbers, Tangent};
use super::silhouette::WheelPose;
use super::source::{PatchReader, PatchSource, functions_of_pose};
use super::wheel::{Place, Wrench, status};
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
        let mut wrenches = [[0.0; 2]; 6];
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
            let lengths = self.lengths[side].map(|length| Tangent::constant(*length));
            let place = Place::new(Frame::new(&numbers), rail, lengths);
            let wheel = &mut forces.wheels[side];
            let source = self.sources[side].as_ref();
            let [lateral_m, roll_rad, yaw_rad] = place.pose.map(|number| number.value());
            let reader = source.locate(&WheelPose {
                lateral_m,
                roll_rad,
                yaw_rad,
            });
            let heights = reader.interpenetrations_m();
            let depth = place.depth.value();
            let loaded = |zone: usize| u32::from(heights[zone] + depth > 0.0) << zone;
            let mut zones = LoadedZones::new((0..ZONES).map(loaded).sum(), wheel);
            let (mut penetration_m, mut wheel_y_m) = (0.0_f64, f64::MAX);
            let mut wrench = [Tangent::constant(0.0); 6];
            while zones.are_left() {
                let (zone, _) = zones.advance();
                let (interpenetration, numbers) =
                    functions_of_pose(&reader, zone, heights[zone], place.pose);
                let depth = interpenetration + place.depth;
                let patch = place.patch(&self.surface, depth, numbers, [true; 4]);
                for (sum, term) in wrench.iter_mut().zip(patch.wrench) {
                    *sum = *sum + term;
                }
                let mut told = patch.told.map(|number| number.value());
                told[POSITION_Y] *= sign;
                wheel.patches[zone].set(told);
                penetration_m = penetration_m.max(patch.penetration.value());
                wheel_y_m = wheel_y_m.min(patch.wheel_y.value());
            }
            wheel.status = status(
                source.geometry().pair(),
                reader.is_inside(),
                wheel.loaded_zones != 0,
                penetration_m,
                wheel_y_m,
            );
            for (sums, number) in wrenches.iter_mut().zip(&wrench) {
                sums[side] = number.value();
            }
            derivatives[side] = WheelDerivatives::of(&wrench, sign);
        }
        forces.set_wrenches(wrenches);
        derivatives
    }
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
