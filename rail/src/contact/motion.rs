//! Motion of a wheelset and displacement of its rails, in track axes: x forward, y right, z down.

use crate::math::dual::Dual;
use crate::math::number::Number;

/// Position and velocity of a wheelset, which is turned by its yaw and then rolled about the rail's direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Motion {
    /// Speed along the track, m/s.
    pub speed_m_per_s: f64,
    /// Lateral displacement of the centre, right positive, m.
    pub lateral_m: f64,
    /// Vertical displacement of the centre, down positive, m; 0 has the tread datum at the height of the rail's top
    /// (the mean of both, where the wheels differ).
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
    /// Angular velocity about the axle, rolling forward positive, rad/s: speed over rolling radius when rolling freely.
    pub rotation_rad_per_s: f64,
    /// Yaw rate over ground, rad/s. In a curve to the right of radius `R` it includes `speed / R`.
    pub yaw_rate_rad_per_s: f64,
}

/// Displacement of one rail from its nominal position, by track irregularity or movement of its own.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
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
}

/// Smallest speed by which creepages are divided, m/s: at standstill the creep forces become a viscous drag.
pub const STANDSTILL_SPEED_M_PER_S: f64 = 0.05;

/// Greatest magnitude accepted in any field, in its unit: its square does not overflow.
const MAX_MAGNITUDE: f64 = 1e9;

/// Whether every number is within the accepted magnitude; NaN is not.
// Not short-circuited: the comparisons run side by side.
#[inline]
fn all_accepted<const N: usize>(numbers: [f64; N]) -> bool {
    numbers
        .iter()
        .fold(true, |all, number| all & (number.abs() <= MAX_MAGNITUDE))
}

/// Number of fields of [`Motion`].
pub const MOTION_FIELDS: usize = 10;

/// A number with its derivatives by the fields of [`Motion`], filled up to three vectors of four.
pub(super) type Tangent = Dual<12>;

/// The fields of [`Motion`] in their order, with or without derivatives.
pub(super) type MotionNumbers<T> = [T; MOTION_FIELDS];

impl Motion {
    /// Whether every field is a number of at most 1e9 in magnitude.
    #[inline]
    pub(super) fn is_accepted(&self) -> bool {
        all_accepted(self.numbers())
    }

    /// The fields in their order.
    #[inline]
    pub(super) fn numbers(&self) -> MotionNumbers<f64> {
        [
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
        ]
    }
}

/// The fields of [`RailDisplacement`], with or without derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct RailNumbers<T> {
    pub lateral: T,
    pub vertical: T,
    pub lateral_velocity: T,
    pub vertical_velocity: T,
    pub roll: T,
    pub roll_rate: T,
}

impl RailDisplacement {
    /// Whether every field is a number of at most 1e9 in magnitude.
    #[inline]
    pub(super) fn is_accepted(&self) -> bool {
        all_accepted([
            self.lateral_m,
            self.vertical_m,
            self.lateral_velocity_m_per_s,
            self.vertical_velocity_m_per_s,
            self.roll_rad,
            self.roll_rate_rad_per_s,
        ])
    }
}

impl<T: Number> RailNumbers<T> {
    /// The rails of a wheel of the right side, or of the mirror image of one of the left: what is odd in the mirror comes
    /// from `odd`.
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
        }
    }
}

/// Whether a field of [`Motion`] changes its sign in a mirror about the track centre: the lateral one, roll and yaw,
/// and their rates.
pub(super) const ODD: [bool; MOTION_FIELDS] = [
    false, true, false, true, true, true, false, true, false, true,
];
