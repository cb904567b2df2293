//! Motion of a wheelset and displacement of its rails, in track axes: x forward, y right, z down.

use crate::math::dual::Dual;
use crate::math::number::Number;

/// Position and velocity of a wheelset, which is first yawed and then rolled about the rail's direction.
///
/// The fields are the complete rigid-body state over the rails; none will be added.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Speed along the track, m/s.
    pub speed_m_per_s: f64,
    /// Lateral displacement of the centre, right positive, m.
    pub lateral_m: f64,
    /// Vertical displacement of the centre, down positive, m. At 0 the tread datum is at the height of the rail's top
    /// (if the wheels differ, the mean of their datums).
    pub vertical_m: f64,
    /// Roll, right side down positive, rad.
    pub roll_rad: f64,
    /// Yaw, nose to the right positive, rad.
    pub yaw_rad: f64,
    /// Lateral velocity of the centre, m/s.
    pub lateral_velocity_m_per_s: f64,
    /// Vertical velocity of the centre, m/s.
    pub vertical_velocity_m_per_s: f64,
    /// Roll rate, rad/s.
    pub roll_rate_rad_per_s: f64,
    /// Angular velocity about the axle, rolling forward positive, rad/s; in free rolling, the speed divided by the
    /// rolling radius.
    pub rotation_rad_per_s: f64,
    /// Yaw rate relative to the ground, rad/s. In a right-hand curve of radius `R` it includes `speed / R`.
    pub yaw_rate_rad_per_s: f64,
}

/// Displacement of one rail from its nominal position, by track irregularity or its own movement, and its friction.
///
/// The fields are complete; none will be added.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RailDisplacement {
    /// Lateral displacement, right positive, m.
    pub lateral_m: f64,
    /// Vertical displacement, down positive, m.
    pub vertical_m: f64,
    /// Rate of `lateral_m` at the wheel, m/s: speed times the slope of the irregularity, plus the rail's own velocity.
    pub lateral_velocity_m_per_s: f64,
    /// Rate of `vertical_m` at the wheel, m/s.
    pub vertical_velocity_m_per_s: f64,
    /// Roll about the rail's top, right side down positive, rad.
    pub roll_rad: f64,
    /// Rate of `roll_rad` at the wheel, rad/s.
    pub roll_rate_rad_per_s: f64,
    /// Direction of the rail against that of the track, to the right positive, rad: the slope of its lateral
    /// irregularity. The wheel's angle of attack is its yaw relative to this direction.
    pub yaw_rad: f64,
    /// Factor on the friction coefficient of the contact, dimensionless; 1 if the rail has the friction of the contact.
    /// Below 1e-6 there is no friction.
    pub friction_ratio: f64,
}

impl Default for RailDisplacement {
    /// No displacement, and the friction of the contact.
    fn default() -> Self {
        Self {
            lateral_m: 0.0,
            vertical_m: 0.0,
            lateral_velocity_m_per_s: 0.0,
            vertical_velocity_m_per_s: 0.0,
            roll_rad: 0.0,
            roll_rate_rad_per_s: 0.0,
            yaw_rad: 0.0,
            friction_ratio: 1.0,
        }
    }
}

/// Speed `v0` in the denominator `hypot(speed, v0)` of all creepages, m/s. Near standstill it turns the creep forces
/// into a viscous drag.
pub const STANDSTILL_SPEED_M_PER_S: f64 = 0.05;

/// Maximum magnitude of any field, in its unit; its square does not overflow.
const MAX_MAGNITUDE: f64 = 1e9;

/// Minimum friction ratio; smaller ones count as zero.
const MIN_FRICTION_RATIO: f64 = 1e-6;

/// True if the magnitudes of all numbers are accepted; false for NaN.
// Not short-circuited, so that the comparisons run in parallel.
#[inline]
fn all_accepted<const N: usize>(numbers: [f64; N]) -> bool {
    numbers
        .iter()
        .fold(true, |all, number| all & (number.abs() <= MAX_MAGNITUDE))
}

/// Number of fields of [`Motion`].
pub const MOTION_FIELDS: usize = 10;

/// A number with its derivatives with respect to the fields of [`Motion`], padded to three vectors of four.
pub(super) type Tangent = Dual<12>;

/// The fields of [`Motion`] in a generic number type: vector lanes, or numbers with derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct MotionNumbers<T> {
    pub speed: T,
    pub lateral: T,
    pub vertical: T,
    pub roll: T,
    pub yaw: T,
    pub lateral_velocity: T,
    pub vertical_velocity: T,
    pub roll_rate: T,
    pub rotation: T,
    pub yaw_rate: T,
}

impl<T> MotionNumbers<T> {
    /// The motion as seen by a right wheel, or by the mirror image of a left wheel.
    ///
    /// `odd` converts the fields that change sign when mirrored about the track centre, `even` the others. Both receive
    /// the field and its index in [`Motion`].
    #[inline(always)]
    pub fn new(
        even: impl Fn(fn(&Motion) -> f64, usize) -> T,
        odd: impl Fn(fn(&Motion) -> f64, usize) -> T,
    ) -> Self {
        Self {
            speed: even(|motion| motion.speed_m_per_s, 0),
            lateral: odd(|motion| motion.lateral_m, 1),
            vertical: even(|motion| motion.vertical_m, 2),
            roll: odd(|motion| motion.roll_rad, 3),
            yaw: odd(|motion| motion.yaw_rad, 4),
            lateral_velocity: odd(|motion| motion.lateral_velocity_m_per_s, 5),
            vertical_velocity: even(|motion| motion.vertical_velocity_m_per_s, 6),
            roll_rate: odd(|motion| motion.roll_rate_rad_per_s, 7),
            rotation: even(|motion| motion.rotation_rad_per_s, 8),
            yaw_rate: odd(|motion| motion.yaw_rate_rad_per_s, 9),
        }
    }
}

impl Motion {
    /// True if every field is at most 1e9 in magnitude.
    #[inline]
    pub(super) fn is_accepted(&self) -> bool {
        all_accepted::<MOTION_FIELDS>([
            self.speed_m_per_s,
            self.lateral_m,
            self.vertical_m,
            self.roll_rad,
            self.yaw_rad,
            self.lateral_velocity_m_per_s,
            self.vertical_velocity_m_per_s,
            self.roll_rate_rad_per_s,
            self.rotation_rad_per_s,
            self.yaw_rate_rad_per_s,
        ])
    }
}

/// The fields of [`RailDisplacement`] in a generic number type: vector lanes, or numbers with derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct RailNumbers<T> {
    pub lateral: T,
    pub vertical: T,
    pub lateral_velocity: T,
    pub vertical_velocity: T,
    pub roll: T,
    pub roll_rate: T,
    pub yaw: T,
    pub friction_ratio: T,
}

impl RailDisplacement {
    /// True if every field is at most 1e9 in magnitude.
    #[inline]
    pub(super) fn is_accepted(&self) -> bool {
        all_accepted([
            self.lateral_m,
            self.vertical_m,
            self.lateral_velocity_m_per_s,
            self.vertical_velocity_m_per_s,
            self.roll_rad,
            self.roll_rate_rad_per_s,
            self.yaw_rad,
            self.friction_ratio,
        ])
    }
}

impl RailDisplacement {
    /// The friction ratio, or zero if it is so small that a creepage divided by the friction could overflow.
    #[inline(always)]
    fn accepted_friction_ratio(&self) -> f64 {
        if self.friction_ratio < MIN_FRICTION_RATIO {
            0.0
        } else {
            self.friction_ratio
        }
    }
}

impl<T: Number> RailNumbers<T> {
    /// The rail as seen by a right wheel, or by the mirror image of a left wheel.
    ///
    /// `odd` converts the fields that change sign when mirrored about the track centre, `even` the others.
    #[inline(always)]
    pub fn new(
        even: impl Fn(fn(&RailDisplacement) -> f64) -> T,
        odd: impl Fn(fn(&RailDisplacement) -> f64) -> T,
    ) -> Self {
        Self {
            lateral: odd(|rail| rail.lateral_m),
            vertical: even(|rail| rail.vertical_m),
            lateral_velocity: odd(|rail| rail.lateral_velocity_m_per_s),
            vertical_velocity: even(|rail| rail.vertical_velocity_m_per_s),
            roll: odd(|rail| rail.roll_rad),
            roll_rate: odd(|rail| rail.roll_rate_rad_per_s),
            yaw: odd(|rail| rail.yaw_rad),
            friction_ratio: even(RailDisplacement::accepted_friction_ratio),
        }
    }
}
