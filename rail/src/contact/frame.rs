//! Kinematics of wheelset and rail, computed once for all patches of a wheel.

use super::motion::{MotionNumbers, RailNumbers, STANDSTILL_SPEED_M_PER_S};
use crate::math::number::Number;

/// Attitude and velocities of a wheelset as seen by the right wheel, in the axes of the track turned into the direction
/// of the rail.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame<T> {
    sin_roll: T,
    cos_roll: T,
    tan_roll: T,
    sin_yaw: T,
    cos_yaw: T,
    tan_yaw: T,
    /// Roll, and yaw relative to the rail, rad.
    pub roll: T,
    pub yaw: T,
    /// Lateral and vertical displacement of the centre, m.
    lateral: T,
    vertical: T,
    /// Velocity of the centre, m/s, and angular velocity, rad/s.
    pub velocity: [T; 3],
    pub angular_velocity: [T; 3],
    /// Denominator of all creepages, m/s: `hypot` of the speed and [`STANDSTILL_SPEED_M_PER_S`]; and its reciprocal.
    pub reference_speed: T,
    pub per_reference_speed: T,
    /// 1 when rolling forward, -1 when rolling backward. When rolling backward, the contact axes are rotated by 180
    /// degrees about the normal.
    pub direction: f64,
}

impl<T: Number> Frame<T> {
    #[inline(always)]
    pub fn new(motion: &MotionNumbers<T>, rail: &RailNumbers<T>) -> Self {
        let MotionNumbers {
            speed,
            lateral,
            vertical,
            roll,
            yaw,
            lateral_velocity,
            vertical_velocity,
            roll_rate,
            rotation,
            yaw_rate,
        } = *motion;
        let (sin_roll, cos_roll) = sine_and_cosine(roll);
        let yaw = yaw - rail.yaw;
        let (sin_yaw, cos_yaw) = sine_and_cosine(yaw);
        let standstill = STANDSTILL_SPEED_M_PER_S * STANDSTILL_SPEED_M_PER_S;
        let reference_speed = (speed * speed + standstill).sqrt();
        // Rolling forward is a negative rotation about y; the roll rate acts about x, the yaw rate about z.
        let turning = -(rotation * cos_yaw);
        Self {
            sin_roll,
            cos_roll,
            tan_roll: sin_roll * cos_roll.reciprocal(),
            sin_yaw,
            cos_yaw,
            tan_yaw: sin_yaw * cos_yaw.reciprocal(),
            roll,
            yaw,
            lateral,
            vertical,
            velocity: [speed, lateral_velocity, vertical_velocity],
            angular_velocity: [
                roll_rate + rotation * sin_yaw,
                turning * cos_roll,
                yaw_rate + turning * sin_roll,
            ],
            reference_speed,
            per_reference_speed: reference_speed.reciprocal(),
            direction: if speed.lane(0) < 0.0 { -1.0 } else { 1.0 },
        }
    }

    /// Displacement of the tread datum `[outwards, down]` relative to a centred wheelset without roll and yaw, m.
    ///
    /// The datum is `offset` from the wheelset's centre, on a wheel of `radius`.
    #[inline(always)]
    pub fn datum_displacement(&self, offset: T, radius: T) -> [T; 2] {
        [
            self.lateral + (self.cos_roll * self.cos_yaw + -1.0) * offset - self.sin_roll * radius,
            self.vertical + self.sin_roll * self.cos_yaw * offset + (self.cos_roll + -1.0) * radius,
        ]
    }

    /// Point of the silhouette relative to the wheelset's centre, m: `offset` along the axle, on the circle of
    /// `radius`, where the surface has `slope` across the track.
    #[inline(always)]
    pub fn silhouette_point(&self, offset: T, radius: T, slope: T) -> [T; 3] {
        let unrolled_slope = (slope - self.tan_roll) * (slope * self.tan_roll + 1.0).reciprocal();
        let sin_behind = (unrolled_slope * self.tan_yaw).limited(0.9);
        let behind = -(radius * sin_behind);
        let down = radius * (-(sin_behind * sin_behind) + 1.0).sqrt();
        let across = behind * self.sin_yaw + offset * self.cos_yaw;
        [
            behind * self.cos_yaw - offset * self.sin_yaw,
            across * self.cos_roll - down * self.sin_roll,
            across * self.sin_roll + down * self.cos_roll,
        ]
    }
}

/// Roll of the right rail.
#[derive(Debug, Clone, Copy)]
pub(super) struct RailRoll<T> {
    pub angle: T,
    sin: T,
    cos: T,
    tan: T,
}

impl<T: Number> RailRoll<T> {
    #[inline(always)]
    pub fn new(rail: &RailNumbers<T>) -> Self {
        let (sin, cos) = sine_and_cosine(rail.roll);
        Self {
            angle: rail.roll,
            sin,
            cos,
            tan: sin * cos.reciprocal(),
        }
    }

    /// Transforms a vector `[across, down]` from track axes to the rail's own axes.
    #[inline(always)]
    pub fn into_rail(self, [across, down]: [T; 2]) -> [T; 2] {
        [
            across * self.cos + down * self.sin,
            down * self.cos - across * self.sin,
        ]
    }

    /// Transforms the slope of a surface from the rail's own axes to track axes.
    #[inline(always)]
    pub fn into_track(self, slope: T) -> T {
        (slope + self.tan) * (-(slope * self.tan) + 1.0).reciprocal()
    }
}

/// Sine and cosine of an angle, which is limited to 0.3 rad. The error is below 5e-8, and below 3e-11 within 0.1 rad.
#[inline(always)]
fn sine_and_cosine<T: Number>(angle: T) -> (T, T) {
    let x = angle.limited(0.3);
    let square = x * x;
    let sine = x * (square * (square * (1.0 / 20.0) + -1.0) * (1.0 / 6.0) + 1.0);
    (sine, (-(sine * sine) + 1.0).sqrt())
}
