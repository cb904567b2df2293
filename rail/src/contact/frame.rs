//! What all patches of a wheelset need of its motion, computed once.

use super::motion::{Motion, STANDSTILL_SPEED_M_PER_S};

/// Attitude and velocities of a wheelset in track axes, for the wheel of the right side.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    sin_roll: f64,
    cos_roll: f64,
    tan_roll: f64,
    sin_yaw: f64,
    cos_yaw: f64,
    tan_yaw: f64,
    /// Roll and yaw, rad.
    pub roll: f64,
    pub yaw: f64,
    /// Lateral and vertical displacement of the centre, m.
    lateral: f64,
    vertical: f64,
    /// Velocity of the centre, m/s, and angular velocity, rad/s.
    pub velocity: [f64; 3],
    pub angular_velocity: [f64; 3],
    /// Speed by which creepages are divided, m/s, and its reciprocal.
    pub reference_speed: f64,
    pub per_reference_speed: f64,
    /// 1 rolling forward, -1 rolling backward: the contact axes then are turned by half a turn about the normal.
    pub direction: f64,
}

impl Frame {
    #[inline]
    pub fn new(motion: &Motion) -> Self {
        let (sin_roll, cos_roll) = sine_and_cosine(motion.roll_rad);
        let (sin_yaw, cos_yaw) = sine_and_cosine(motion.yaw_rad);
        let speed = motion.speed_m_per_s;
        let reference_speed =
            (speed * speed + STANDSTILL_SPEED_M_PER_S * STANDSTILL_SPEED_M_PER_S).sqrt();
        let rotation = motion.rotation_rad_per_s;
        let axle = [-sin_yaw, cos_yaw * cos_roll, cos_yaw * sin_roll];
        Self {
            sin_roll,
            cos_roll,
            tan_roll: sin_roll / cos_roll,
            sin_yaw,
            cos_yaw,
            tan_yaw: sin_yaw / cos_yaw,
            roll: motion.roll_rad,
            yaw: motion.yaw_rad,
            lateral: motion.lateral_m,
            vertical: motion.vertical_m,
            velocity: [
                speed,
                motion.lateral_velocity_m_per_s,
                motion.vertical_velocity_m_per_s,
            ],
            // Roll rate about x, yaw rate about z; rolling forward turns against the direction of the axle.
            angular_velocity: [
                motion.roll_rate_rad_per_s - rotation * axle[0],
                -rotation * axle[1],
                motion.yaw_rate_rad_per_s - rotation * axle[2],
            ],
            reference_speed,
            per_reference_speed: 1.0 / reference_speed,
            direction: if speed < 0.0 { -1.0 } else { 1.0 },
        }
    }

    /// The mirror image about the track centre: the left wheel as a right wheel.
    #[inline]
    pub fn mirrored(&self) -> Self {
        let ([vx, vy, vz], [wx, wy, wz]) = (self.velocity, self.angular_velocity);
        Self {
            sin_roll: -self.sin_roll,
            tan_roll: -self.tan_roll,
            sin_yaw: -self.sin_yaw,
            tan_yaw: -self.tan_yaw,
            roll: -self.roll,
            yaw: -self.yaw,
            lateral: -self.lateral,
            velocity: [vx, -vy, vz],
            angular_velocity: [-wx, wy, -wz],
            ..*self
        }
    }

    /// Displacement of the tread datum to the field side and down, m, from that of a centred wheelset without roll
    /// and yaw; the datum is `offset` from the centre on a wheel of `radius`.
    #[inline]
    pub fn datum_displacement(&self, offset: f64, radius: f64) -> [f64; 2] {
        [
            self.lateral + offset * (self.cos_roll * self.cos_yaw - 1.0) - radius * self.sin_roll,
            self.vertical + offset * self.sin_roll * self.cos_yaw + radius * (self.cos_roll - 1.0),
        ]
    }

    /// Point of the silhouette from the wheelset's centre, m: `offset` along the axle on the circle of `radius`,
    /// where the surface has `slope` across the track.
    #[inline]
    pub fn silhouette_point(&self, offset: f64, radius: f64, slope: f64) -> [f64; 3] {
        let unrolled_slope = (slope - self.tan_roll) / (1.0 + slope * self.tan_roll);
        let sin_behind = (unrolled_slope * self.tan_yaw).clamp(-0.9, 0.9);
        let behind = -radius * sin_behind;
        let down = radius * (1.0 - sin_behind * sin_behind).sqrt();
        let across = behind * self.sin_yaw + offset * self.cos_yaw;
        [
            behind * self.cos_yaw - offset * self.sin_yaw,
            across * self.cos_roll - down * self.sin_roll,
            across * self.sin_roll + down * self.cos_roll,
        ]
    }
}

/// Sine and cosine of an angle limited to 0.3 rad; in error by less than 5e-8 there, 3e-11 within 0.1 rad.
#[inline]
fn sine_and_cosine(angle: f64) -> (f64, f64) {
    let x = angle.clamp(-0.3, 0.3);
    let square = x * x;
    let sine = x * (1.0 - square * (1.0 / 6.0) * (1.0 - square * (1.0 / 20.0)));
    (sine, (1.0 - sine * sine).sqrt())
}
