//! How a wheelset under load runs.

use super::LoadedWheelsetError;

/// Maximum lateral shift to either side, m.
pub const MAX_LATERAL_M: f64 = 0.012;
/// Vertical loads of a wheel that are accepted, N.
const LOADS_N: [f64; 2] = [1e3, 400e3];
/// Maximum yaw, rad.
const MAX_YAW_RAD: f64 = 0.05;
/// Maximum roll that can be given, rad.
const MAX_ROLL_RAD: f64 = 0.02;
/// Accepted speeds, m/s: above the standstill, at which creepages are not defined.
const SPEEDS_M_PER_S: [f64; 2] = [1.0, 200.0];
/// Accepted friction coefficients; without friction the rotation of the wheelset would be arbitrary.
const FRICTIONS: [f64; 2] = [0.01, 1.0];

/// Load and motion of a wheelset that runs along a straight track at constant shift and yaw.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Running {
    /// Vertical load of each wheel, N.
    pub load_n: f64,
    /// Speed, m/s.
    pub speed_m_per_s: f64,
    /// Yaw, nose to the right positive, rad.
    pub yaw_rad: f64,
    /// Constant friction coefficient.
    pub friction: f64,
    /// Roll, right side down positive, rad, of two wheels that are pressed on their rails one by one; `None` if the
    /// wheelset rests on both rails.
    pub roll_rad: Option<f64>,
    /// Angular velocity about the axle, rad/s; `None` if no moment drives or brakes the wheelset.
    pub rotation_rad_per_s: Option<f64>,
}

impl Default for Running {
    /// 100 kN per wheel at 100 km/h, friction 0.4, without yaw, free in roll and rotation.
    fn default() -> Self {
        Self {
            load_n: 100e3,
            speed_m_per_s: 100.0 / 3.6,
            yaw_rad: 0.0,
            friction: 0.4,
            roll_rad: None,
            rotation_rad_per_s: None,
        }
    }
}

macro_rules! setters {
    ($($name:ident sets $field:ident: $kind:ty;)*) => {$(
        #[doc = concat!("Returns a copy with the given [`", stringify!($field), "`](Self::", stringify!($field), ").")]
        pub fn $name(mut self, $field: $kind) -> Self {
            self.$field = $field;
            self
        }
    )*};
}

impl Running {
    setters! {
        with_load_n sets load_n: f64;
        with_speed_m_per_s sets speed_m_per_s: f64;
        with_yaw_rad sets yaw_rad: f64;
        with_friction sets friction: f64;
        with_roll_rad sets roll_rad: Option<f64>;
        with_rotation_rad_per_s sets rotation_rad_per_s: Option<f64>;
    }

    /// Checks the bounds of every quantity.
    pub(super) fn check(&self) -> Result<(), LoadedWheelsetError> {
        within("load_n", self.load_n, LOADS_N)?;
        within("speed_m_per_s", self.speed_m_per_s, SPEEDS_M_PER_S)?;
        within("yaw_rad", self.yaw_rad, [-MAX_YAW_RAD, MAX_YAW_RAD])?;
        within("friction", self.friction, FRICTIONS)?;
        let roll_rad = self.roll_rad.unwrap_or(0.0);
        within("roll_rad", roll_rad, [-MAX_ROLL_RAD, MAX_ROLL_RAD])?;
        let rotation = self.rotation_rad_per_s.unwrap_or(0.0);
        within("rotation_rad_per_s", rotation, [-1e4, 1e4])
    }
}

pub(super) fn within(
    key: &'static str,
    value: f64,
    allowed: [f64; 2],
) -> Result<(), LoadedWheelsetError> {
    if (allowed[0]..=allowed[1]).contains(&value) {
        Ok(())
    } else {
        Err(LoadedWheelsetError::OutOfBounds {
            key,
            value,
            allowed,
        })
    }
}
