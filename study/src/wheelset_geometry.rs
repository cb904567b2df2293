//! Wheelset geometry as a function of lateral shift: rigid contact, rolling radii, equivalent conicity.

use dashpot_rail::contact::{Pair, RigidContact};
use dashpot_rail::indices::{RollingRadiusDifference, RollingRadiusError};
use serde::Serialize;

/// Maximum evaluated lateral shift, m.
const MAX_SHIFT_M: f64 = 0.012;
/// Number of cells, 25 um each, in which the rolling radius difference is computed; they are small enough to locate its
/// jumps.
const CELLS: usize = 960;
/// Number of amplitudes, 0.5 mm apart, at which the equivalent conicity is computed.
const AMPLITUDES: u32 = 16;

/// Rigid contact of a wheelset as a function of its lateral shift, from left to right.
pub struct WheelsetGeometry {
    /// Contact at each lateral shift from -12 mm to 12 mm, 25 um apart.
    pub contacts: Vec<RigidContact>,
    /// Rolling radius difference, right wheel minus left wheel.
    pub rolling: RollingRadiusDifference,
}

/// Equivalent conicity at one amplitude.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Conicity {
    /// Amplitude, m.
    pub amplitude_m: f64,
    /// Equivalent conicity according to EN 15302; `None` if the wheelset has no periodic motion.
    pub equivalent_conicity: Option<f64>,
}

/// Rigid wheelset at one lateral shift.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Shift {
    /// Lateral shift at the height of the top of the rails, positive to the right, m.
    pub lateral_shift_m: f64,
    /// Rolling radius of the right wheel minus that of the left wheel, m.
    pub rolling_radius_difference_m: f64,
    /// Roll of the wheelset, rad.
    pub roll_rad: f64,
    /// Contact angle of the left wheel, rad.
    pub contact_angle_left_rad: f64,
    /// Contact angle of the right wheel, rad.
    pub contact_angle_right_rad: f64,
    /// Contact position on the left wheel from the tread datum, positive to the field side, m.
    pub wheel_place_left_m: f64,
    /// Contact position on the right wheel from the tread datum, positive to the field side, m.
    pub wheel_place_right_m: f64,
}

impl From<&RigidContact> for Shift {
    fn from(contact: &RigidContact) -> Self {
        Self {
            lateral_shift_m: contact.lateral_m,
            rolling_radius_difference_m: contact.rolling_radius_difference_m(),
            roll_rad: contact.roll_rad,
            contact_angle_left_rad: -libm::atan(contact.sides[0].slope),
            contact_angle_right_rad: -libm::atan(contact.sides[1].slope),
            wheel_place_left_m: contact.sides[0].wheel_y_m,
            wheel_place_right_m: contact.sides[1].wheel_y_m,
        }
    }
}

impl WheelsetGeometry {
    /// Computes the geometry for a left and a right pair of profiles. The left pair is given as its mirror image, as if
    /// it were on the right side.
    ///
    /// # Errors
    /// Returns an error if the contacts do not define a rolling radius difference.
    pub fn new(sides: [&Pair; 2]) -> Result<Self, RollingRadiusError> {
        let mut scratch = Vec::new();
        let contacts: Vec<RigidContact> = (0..=CELLS)
            .map(|i| MAX_SHIFT_M * (2.0 * i as f64 / CELLS as f64 - 1.0))
            .map(|shift| RigidContact::of_sides(sides, shift, 0.0, &mut scratch))
            .collect();
        let rolling = RollingRadiusDifference::new(
            contacts.iter().map(|contact| contact.lateral_m).collect(),
            contacts
                .iter()
                .map(RigidContact::rolling_radius_difference_m)
                .collect(),
        )?;
        Ok(Self { contacts, rolling })
    }
}

impl Conicity {
    /// Computes the equivalent conicity at amplitudes from 0.5 mm to 8 mm, for wheels of the nominal radius `radius_m`.
    pub fn over_amplitude(rolling: &RollingRadiusDifference, radius_m: f64) -> Vec<Self> {
        (1..=AMPLITUDES)
            .map(|i| f64::from(i) * 0.5e-3)
            .map(|amplitude_m| Self {
                amplitude_m,
                equivalent_conicity: rolling.equivalent_conicity(amplitude_m, radius_m),
            })
            .collect()
    }
}
