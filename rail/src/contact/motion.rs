//! How a wheelset and its rails stand and move, and what all its patches share of that.

/// Motion of a wheelset in the track's axes; turned by the yaw, then rolled about the rail's direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Speed along the track, m/s.
    pub speed: f64,
    /// Lateral place of the centre, right positive, m.
    pub lateral: f64,
    /// Depth of the centre below its place with the tread datum at the rails' top, m.
    pub vertical: f64,
    /// Roll, right side down positive, rad.
    pub roll: f64,
    /// Yaw, nose to the right positive, rad.
    pub yaw: f64,
    /// Rate of `lateral`, m/s.
    pub lateral_rate: f64,
    /// Rate of `vertical`, m/s.
    pub vertical_rate: f64,
    /// Rate of roll, rad/s.
    pub roll_rate: f64,
    /// Turning about the axle, rolling forward positive, rad/s; free rolling is `speed / radius`.
    pub rotation: f64,
    /// Rate of yaw over ground, rad/s: in a curve to the right of radius `R` the frame's own `speed / R` is part of it.
    pub yaw_rate: f64,
}

/// Place of one rail against its nominal one (irregularity, own movement).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rail {
    /// To the right, m.
    pub lateral: f64,
    /// Downward, m.
    pub vertical: f64,
    /// Rate of `lateral` as seen by the wheelset, `speed` times the rail's slope and its own movement, m/s.
    pub lateral_rate: f64,
    /// Rate of `vertical`, m/s.
    pub vertical_rate: f64,
}

/// Least speed creepages are taken over, m/s: at rest the creep forces become a viscous drag.
pub const STANDSTILL: f64 = 0.05;

/// Greatest number taken for a motion, in its unit: no square of it overflows.
const GREATEST: f64 = 1e9;

impl Motion {
    /// Whether every number lies within a thousand million.
    #[inline]
    pub(super) fn is_finite(&self) -> bool {
        // Not short-circuited: the comparisons run side by side.
        [
            self.speed,
            self.lateral,
            self.vertical,
            self.roll,
            self.yaw,
            self.lateral_rate,
            self.vertical_rate,
            self.roll_rate,
            self.rotation,
            self.yaw_rate,
        ]
        .iter()
        .fold(true, |all, number| all & (number.abs() <= GREATEST))
    }
}

impl Rail {
    /// Whether every number lies within a thousand million.
    #[inline]
    pub(super) fn is_finite(&self) -> bool {
        [
            self.lateral,
            self.vertical,
            self.lateral_rate,
            self.vertical_rate,
        ]
        .iter()
        .fold(true, |all, number| all & (number.abs() <= GREATEST))
    }

    /// The left rail seen in a mirror on the track's middle.
    #[inline]
    pub(super) fn mirrored(&self) -> Self {
        Self {
            lateral: -self.lateral,
            lateral_rate: -self.lateral_rate,
            ..*self
        }
    }
}

/// What all patches of a wheelset share of its motion, told for one side.
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
    /// Lateral and vertical place of the centre, m.
    pub lateral: f64,
    pub vertical: f64,
    /// Velocity of the centre and turning in track axes, m/s and rad/s.
    pub velocity: [f64; 3],
    pub turning: [f64; 3],
    /// Speed creepages are taken over, m/s, and its inverse.
    pub speed: f64,
    pub per_speed: f64,
    /// Rolling backwards is rolling forwards, turned half around the normal: -1, else 1.
    pub way: f64,
}

impl Frame {
    #[inline]
    pub fn new(motion: &Motion) -> Self {
        let (sin_roll, cos_roll) = sine_and_cosine(motion.roll);
        let (sin_yaw, cos_yaw) = sine_and_cosine(motion.yaw);
        let speed = (motion.speed * motion.speed + STANDSTILL * STANDSTILL).sqrt();
        let axle = [-sin_yaw, cos_yaw * cos_roll, cos_yaw * sin_roll];
        Self {
            sin_roll,
            cos_roll,
            tan_roll: sin_roll / cos_roll,
            sin_yaw,
            cos_yaw,
            tan_yaw: sin_yaw / cos_yaw,
            roll: motion.roll,
            yaw: motion.yaw,
            lateral: motion.lateral,
            vertical: motion.vertical,
            velocity: [motion.speed, motion.lateral_rate, motion.vertical_rate],
            // Roll rate about x, yaw rate about z, rotation backwards about the axle.
            turning: [
                motion.roll_rate - motion.rotation * axle[0],
                -motion.rotation * axle[1],
                motion.yaw_rate - motion.rotation * axle[2],
            ],
            speed,
            per_speed: 1.0 / speed,
            way: if motion.speed < 0.0 { -1.0 } else { 1.0 },
        }
    }

    /// The same seen in a mirror on the track's middle: the left wheel as a right one.
    #[inline]
    pub fn mirrored(&self) -> Self {
        let ([vx, vy, vz], [wx, wy, wz]) = (self.velocity, self.turning);
        Self {
            sin_roll: -self.sin_roll,
            tan_roll: -self.tan_roll,
            sin_yaw: -self.sin_yaw,
            tan_yaw: -self.tan_yaw,
            roll: -self.roll,
            yaw: -self.yaw,
            lateral: -self.lateral,
            velocity: [vx, -vy, vz],
            turning: [-wx, wy, -wz],
            ..*self
        }
    }

    /// Shift towards the field and drop of the wheel's datum, `datum` from the centre on a wheel of
    /// `radius`, against a wheelset that is neither rolled nor yawed, m.
    #[inline]
    pub fn shift(&self, datum: f64, radius: f64) -> [f64; 2] {
        [
            self.lateral + datum * (self.cos_roll * self.cos_yaw - 1.0) - radius * self.sin_roll,
            self.vertical + datum * self.sin_roll * self.cos_yaw + radius * (self.cos_roll - 1.0),
        ]
    }

    /// The point of the silhouette, from the wheelset's centre, `offset` along the axle on the
    /// circle of `radius`, where the outline has `slope` across the track.
    #[inline]
    pub fn point(&self, offset: f64, radius: f64, slope: f64) -> [f64; 3] {
        let own = (slope - self.tan_roll) / (1.0 + slope * self.tan_roll);
        let turned = (own * self.tan_yaw).clamp(-0.9, 0.9);
        let behind = -radius * turned;
        let deep = radius * (1.0 - turned * turned).sqrt();
        let across = behind * self.sin_yaw + offset * self.cos_yaw;
        [
            behind * self.cos_yaw - offset * self.sin_yaw,
            across * self.cos_roll - deep * self.sin_roll,
            across * self.sin_roll + deep * self.cos_roll,
        ]
    }
}

/// Sine and cosine of an angle held within 0.3 rad; off by less than 5e-8 there, 3e-11 within 0.1 rad.
#[inline]
fn sine_and_cosine(angle: f64) -> (f64, f64) {
    let x = angle.clamp(-0.3, 0.3);
    let square = x * x;
    let sine = x * (1.0 - square * (1.0 / 6.0) * (1.0 - square * (1.0 / 20.0)));
    (sine, (1.0 - sine * sine).sqrt())
}
