//! Position of a wheel over its rail, and the force on one of its contact patches.

use super::frame::{Frame, RailRoll};
use super::loaded_contact::{Contact, CreepNumber};
use super::motion::{RailNumbers, Tangent};
use super::pair::Pair;
use super::patch_numbers::PatchNumbers;
use super::silhouette::WheelPose;
use super::status::Status;
use super::surface::Surface;
use super::wheel_lengths::WheelLengths;
use super::wrench::Wrench;
use crate::creep::{CreepLaw, MAX_CREEPAGE};
use crate::math::number::Number;

/// Cosine of the steepest contact angle.
const MIN_COSINE: f64 = 1e-3;
/// Added to loads, so that a patch without load has no share like 0/0, N. Its reciprocal squared is a number of single
/// precision, as derivatives are.
const TINY: f64 = 1e-12;
/// Normal penetration beyond which steel no longer stays elastic, m.
pub const MAX_PENETRATION_M: f64 = 2e-3;

/// A wheel in motion over its rail.
pub(super) struct MovingWheel<T> {
    frame: Frame<T>,
    rail: RailNumbers<T>,
    rail_roll: RailRoll<T>,
    lengths: WheelLengths<T>,
    /// Lateral shift, m, and roll and yaw, rad, relative to the rail.
    pub pose: [T; 3],
    /// Depth of the tread datum below the rail's top, m.
    pub depth: T,
}

/// Results for one patch of the right wheel, or of the mirror image of the left wheel; the fields are those of
/// [`PatchForces`](super::PatchForces).
#[derive(Debug, Clone, Copy)]
pub(super) struct PatchOutput<T> {
    pub load: T,
    pub penetration: T,
    pub slope: T,
    pub semi_axes: [T; 2],
    pub rolling_radius: T,
    pub wheel_y: T,
    pub position: [T; 3],
    pub creepage: [T; 3],
    pub creep: [T; 3],
    pub dissipation: T,
    pub peak_pressure: T,
    pub stiffness: T,
}

impl PatchOutput<Tangent> {
    /// The values without their derivatives.
    pub fn values(&self) -> PatchOutput<f64> {
        let three = |numbers: [Tangent; 3]| numbers.map(|number| number.value());
        PatchOutput {
            load: self.load.value(),
            penetration: self.penetration.value(),
            slope: self.slope.value(),
            semi_axes: self.semi_axes.map(|number| number.value()),
            rolling_radius: self.rolling_radius.value(),
            wheel_y: self.wheel_y.value(),
            position: three(self.position),
            creepage: three(self.creepage),
            creep: three(self.creep),
            dissipation: self.dissipation.value(),
            peak_pressure: self.peak_pressure.value(),
            stiffness: self.stiffness.value(),
        }
    }
}

/// Force on one patch, and its results.
pub(super) struct Patch<T> {
    pub wrench: Wrench<T>,
    pub output: PatchOutput<T>,
}

impl MovingWheel<Tangent> {
    /// The pose relative to the rail.
    pub fn pose(&self) -> WheelPose {
        let [lateral_m, roll_rad, yaw_rad] = self.pose.map(|number| number.value());
        WheelPose {
            lateral_m,
            roll_rad,
            yaw_rad,
        }
    }
}

impl<T: CreepNumber> MovingWheel<T> {
    #[inline(always)]
    pub fn new(frame: Frame<T>, rail: RailNumbers<T>, lengths: WheelLengths<T>) -> Self {
        let [lateral, vertical] = frame.datum_displacement(lengths.offset, lengths.radius);
        let rail_roll = RailRoll::new(&rail);
        let [across, depth] = rail_roll.into_rail([
            lateral + lengths.beside_top - rail.lateral,
            vertical + lengths.below_top - rail.vertical,
        ]);
        Self {
            pose: [
                across - lengths.beside_top,
                frame.roll - rail_roll.angle,
                frame.yaw,
            ],
            depth,
            frame,
            rail,
            rail_roll,
            lengths,
        }
    }

    /// Evaluates the patch of `numbers` in the lanes that are `used`, on a wheel that is `approach` below its first
    /// touch, m, and whose load grows with the depth by `growth` times itself, 1/m.
    #[inline(always)]
    pub fn patch<L: CreepLaw>(
        &self,
        surface: &Surface<L>,
        [approach, growth]: [T; 2],
        numbers: PatchNumbers<T>,
        used: [bool; 4],
    ) -> Patch<T> {
        let (frame, rail) = (&self.frame, &self.rail);
        let PatchNumbers {
            load: elastic_load,
            whole_load,
            sine,
            wheel_y,
            wheel_z,
            semi_axes,
            peak_pressure,
        } = numbers;
        let rail_cos = (-(sine * sine) + 1.0).limited(1.0).not_negative();
        let rail_cos = (rail_cos + MIN_COSINE * MIN_COSINE).sqrt();
        let penetration = approach * rail_cos;
        let slope = self.rail_roll.into_track(sine / rail_cos);
        let cos = cosine(slope);
        let sin = slope * cos;
        let radius = wheel_z + self.lengths.radius;
        let position = frame.silhouette_point(wheel_y + self.lengths.offset, radius, slope);
        let ([x, y, z], [wx, wy, wz]) = (position, frame.angular_velocity);
        // Velocity of the wheel's surface relative to the rail, which rolls about its top.
        let beside_top = self.pose[0] + wheel_y + self.lengths.beside_top;
        let below_top = self.depth + wheel_z;
        let vx = frame.velocity[0] + wy * z - wz * y;
        let vy = frame.velocity[1] + wz * x - wx * z + below_top * rail.roll_rate
            - rail.lateral_velocity;
        let vz = frame.velocity[2] + wx * y
            - wy * x
            - beside_top * rail.roll_rate
            - rail.vertical_velocity;
        let directed = frame.per_reference_speed * frame.direction;
        let approach_speed = vz * cos - vy * sin;
        let damping = surface.damping(approach_speed);
        // A part of a patch carries its share of the load and of the creep forces.
        let contact = Contact {
            load: whole_load * damping,
            fraction: elastic_load / (whole_load + TINY),
            semi_axes,
            kalker: T::kalker(&surface.kalker, semi_axes),
            creepage: [
                (vx * directed).limited(MAX_CREEPAGE),
                ((vy * cos + vz * sin) * directed).limited(MAX_CREEPAGE),
                ((wz * cos - wy * sin) * frame.per_reference_speed).limited(MAX_CREEPAGE),
            ],
            friction_ratio: rail.friction_ratio,
        };
        let creep = T::creep_forces(&contact, surface, frame.reference_speed, used);
        let [longitudinal, lateral, spin_moment] = creep;
        let [xi, eta, phi] = contact.creepage;
        let dissipation =
            -(longitudinal * xi + lateral * eta + spin_moment * phi) * frame.reference_speed;
        let load = elastic_load * damping;
        let (fx, ft) = (longitudinal * frame.direction, lateral * frame.direction);
        let (fy, fz) = (ft * cos + load * sin, ft * sin - load * cos);
        Patch {
            wrench: Wrench {
                force: [fx, fy, fz],
                moment: [
                    y * fz - z * fy,
                    z * fx - x * fz - spin_moment * sin,
                    x * fy - y * fx + spin_moment * cos,
                ],
            },
            output: PatchOutput {
                load,
                penetration,
                slope: -slope,
                semi_axes: contact.semi_axes,
                rolling_radius: radius,
                wheel_y,
                position,
                creepage: contact.creepage,
                creep,
                dissipation,
                peak_pressure,
                stiffness: elastic_load * growth / rail_cos,
            },
        }
    }
}

/// Status of a wheel.
///
/// `is_inside`: the pose is inside the tables. `penetration_m`: maximum over the patches. `wheel_y_m`: lateral position
/// of the loaded patch nearest to the flange tip.
#[inline(always)]
pub(super) fn status(
    pair: &Pair,
    is_inside: bool,
    is_loaded: bool,
    penetration_m: f64,
    wheel_y_m: f64,
) -> Status {
    if !is_inside || penetration_m > MAX_PENETRATION_M {
        Status::OutsideTables
    } else if !is_loaded {
        Status::Lifted
    } else if wheel_y_m < pair.flange_tip_m() {
        Status::PastTip
    } else if wheel_y_m < pair.steepest_flange_m() {
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
