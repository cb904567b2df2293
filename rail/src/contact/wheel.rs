//! Contact forces on one wheel: the patches of its pose, each with its load, its creepages and its creep forces.

use super::contact_forces::{Contact, Creep};
use super::forces::{PatchForces, Status, WheelForces};
use super::frame::{Frame, RailRoll};
use super::motion::RailDisplacement;
use super::pair::Pair;
use super::silhouette::WheelPose;
use super::source::{PatchReader, sealed::Source};
use super::surface::Surface;
use super::tables::NUMBERS;
use crate::creep::CreepLaw;
use crate::math::number::Number;

/// Normal penetration beyond which steel does not stay elastic, m.
pub const MAX_PENETRATION_M: f64 = 2e-3;

/// Force, N, and moment about the wheelset's centre, N m, in track axes.
pub(super) type Wrench<T> = [T; 6];

/// One wheel over its rail, as a wheel of the right side.
pub(super) struct Wheel<'a, S, L> {
    pub source: &'a S,
    pub surface: &'a Surface<L>,
    /// Height of the wheelset's centre above the rails' top in its nominal position, m.
    pub height_m: f64,
}

/// Where a wheel is over its rail.
struct Place<'a, T> {
    frame: &'a Frame<T>,
    rail: &'a RailDisplacement,
    rail_roll: RailRoll,
    /// Shift, roll and yaw.
    pose: [T; 3],
    /// Depth of the tread datum below the rail's top, m.
    depth: T,
    /// Lateral distance of the datum of a centred wheel from the rail's top, m.
    arm: f64,
}

impl<S: Source, L: CreepLaw> Wheel<'_, S, L> {
    /// The force and moment on the wheel; writes its patches and its status into `forces`.
    #[inline]
    pub fn wrench<T: Number>(
        &self,
        frame: &Frame<T>,
        rail: &RailDisplacement,
        forces: &mut WheelForces,
    ) -> Wrench<T> {
        let place = self.place(frame, rail);
        let [lateral_m, roll_rad, yaw_rad] = place.pose.map(T::value);
        let reader = self.source.locate(&WheelPose {
            lateral_m,
            roll_rad,
            yaw_rad,
        });
        forces.status = if reader.is_inside() {
            Status::Lifted
        } else {
            Status::OutsideTables
        };
        let mut wrench = [T::constant(0.0); 6];
        let [interpenetrations, stiffnesses] = [reader.interpenetrations_m(), reader.stiffnesses()];
        for (zone, result) in forces.patches.iter_mut().enumerate() {
            let (interpenetration, stiffness) = (interpenetrations[zone], stiffnesses[zone]);
            if interpenetration + place.depth.value() <= 0.0 || stiffness <= 0.0 {
                if result.load_n != 0.0 {
                    *result = PatchForces::default();
                }
                continue;
            }
            let [interpenetration, stiffness] =
                reader.load_numbers(zone, [interpenetration, stiffness], place.pose);
            let numbers = reader.numbers_at(zone, place.pose);
            let depth = interpenetration + place.depth;
            let patch = self.patch(&place, depth, stiffness, numbers, result);
            for (sum, term) in wrench.iter_mut().zip(patch) {
                *sum = *sum + term;
            }
            forces.status = forces.status.max(status(self.pair(), result));
        }
        wrench
    }

    fn pair(&self) -> &Pair {
        self.source.geometry().pair()
    }

    #[inline(always)]
    fn place<'a, T: Number>(
        &self,
        frame: &'a Frame<T>,
        rail: &'a RailDisplacement,
    ) -> Place<'a, T> {
        let installation = self.pair().installation();
        let (offset, radius) = (installation.datum_offset_m(), installation.wheel_radius_m);
        let [lateral, vertical] = frame.datum_displacement(offset, radius);
        let rail_roll = RailRoll::of(rail);
        let arm = offset - self.pair().rail_top_m();
        let [across, depth] = rail_roll.into_rail([
            lateral + (arm - rail.lateral_m),
            vertical + (radius - self.height_m - rail.vertical_m),
        ]);
        Place {
            frame,
            rail,
            rail_roll,
            pose: [across - arm, frame.roll - rail_roll.angle, frame.yaw],
            depth,
            arm,
        }
    }

    /// The force and moment of one patch whose surfaces interpenetrate by `depth` along z; writes it into `result`.
    #[inline(always)]
    fn patch<T: Number>(
        &self,
        place: &Place<'_, T>,
        depth: T,
        stiffness: T,
        numbers: [T; NUMBERS],
        result: &mut PatchForces,
    ) -> Wrench<T> {
        let (frame, rail) = (place.frame, place.rail);
        let installation = self.pair().installation();
        let [wheel_y, wheel_z, rail_slope, _, a, b, c11, c22, c23, c33, _, _] = numbers;
        let penetration = depth * cosine(rail_slope);
        let slope = place.rail_roll.into_track(rail_slope);
        let cos = cosine(slope);
        let sin = slope * cos;
        let radius = wheel_z + installation.wheel_radius_m;
        let offset = wheel_y + installation.datum_offset_m();
        let position = frame.silhouette_point(offset, radius, slope);
        let ([x, y, z], [wx, wy, wz]) = (position, frame.angular_velocity);
        // Velocity of the wheel's surface relative to the rail, which turns about its top.
        let beside_top = place.pose[0] + wheel_y + place.arm;
        let below_top = place.depth + wheel_z;
        let rate = rail.roll_rate_rad_per_s;
        let vx = wy * z - wz * y + frame.velocity[0];
        let vy = wz * x - wx * z + frame.velocity[1] + below_top * rate
            - rail.lateral_velocity_m_per_s;
        let vz = wx * y - wy * x + frame.velocity[2]
            - beside_top * rate
            - rail.vertical_velocity_m_per_s;
        let directed = frame.per_reference_speed * frame.direction;
        let root = penetration.sqrt();
        let approach_speed = vz * cos - vy * sin;
        let contact = Contact {
            load: stiffness * penetration * root * self.surface.damping(approach_speed),
            semi_axes: [a * root, b * root],
            kalker: [c11, c22, c23, c33],
            creepage: [
                vx * directed,
                (vy * cos + vz * sin) * directed,
                (wz * cos - wy * sin) * frame.per_reference_speed,
            ],
        };
        let Creep {
            forces: creep_forces,
            creepage,
            creep,
        } = contact.creep(self.surface, frame.reference_speed);
        let load = contact.load;
        let [longitudinal, lateral, spin_moment] = creep_forces;
        let (fx, ft) = (longitudinal * frame.direction, lateral * frame.direction);
        let (fy, fz) = (ft * cos + load * sin, ft * sin - load * cos);
        result.load_n = load.value();
        result.penetration_m = penetration.value();
        result.slope = -slope.value();
        result.semi_axes_m = contact.semi_axes.map(T::value);
        result.rolling_radius_m = radius.value();
        result.wheel_y_m = wheel_y.value();
        result.position_m = position.map(T::value);
        result.creepage = creepage;
        result.creep = creep;
        result.dissipation_w = creep.dissipation_n(&creepage) * frame.reference_speed.value();
        [
            fx,
            fy,
            fz,
            y * fz - z * fy,
            z * fx - x * fz - spin_moment * sin,
            x * fy - y * fx + spin_moment * cos,
        ]
    }
}

fn status(pair: &Pair, patch: &PatchForces) -> Status {
    if patch.penetration_m > MAX_PENETRATION_M {
        Status::OutsideTables
    } else if patch.wheel_y_m < pair.flange_tip_m() {
        Status::PastTip
    } else if patch.wheel_y_m < pair.steepest_flange_m() {
        Status::Climbing
    } else {
        Status::Rolling
    }
}

/// Cosine of the angle whose tangent is `slope`.
#[inline(always)]
fn cosine<T: Number>(slope: T) -> T {
    (slope * slope + 1.0).sqrt().reciprocal()
}
