//! The geometry of a wheelset over its lateral shift: contacts of rigid wheels and rails, rolling radii, equivalent conicity.

use dashpot_rail::contact::{
    Axis, ContactGeometry, Grid, Jump, MAX_JUMP, Pair, RigidContact, Steel, Tables,
};
use dashpot_rail::indices::{RollingRadiusDifference, RollingRadiusError};
use serde::Serialize;

/// Largest lateral shift that is evaluated, m.
const LARGEST_SHIFT_M: f64 = 0.012;
/// Cells of the rolling radius difference from left to right: 25 um each, which locates its jumps as well.
const CELLS: usize = 960;
/// Amplitudes that equivalent conicity is told of, each half millimetre.
const AMPLITUDES: u32 = 16;

/// Load of a wheel under which jumps of the force are looked for, N.
const LOAD_N: f64 = 100e3;

/// A jump of the force of the contact, for which tables of a pair are refused.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ForceJump {
    /// Lateral shift of the right wheel over its rail, to the field side, m.
    pub lateral_m: f64,
    /// Roll of the wheel, rad.
    pub roll_rad: f64,
    /// Yaw of the wheel, rad.
    pub yaw_rad: f64,
    /// Load of the wheel there, N.
    pub load_n: f64,
    /// Jump of the vertical force, N.
    pub jump_n: f64,
    /// What the stiffness of the contact allows, N.
    pub allowed_n: f64,
}

impl From<Jump> for ForceJump {
    fn from(jump: Jump) -> Self {
        Self {
            lateral_m: jump.pose.lateral_m,
            roll_rad: jump.pose.roll_rad,
            yaw_rad: jump.pose.yaw_rad,
            load_n: jump.load_n,
            jump_n: jump.jump_n,
            allowed_n: jump.allowed_n,
        }
    }
}

impl ForceJump {
    /// The greatest jump of a pair whose contact tables are refused under a wheel load of 100 kN; `None` if its force does not jump at any
    /// of the looked-at rolls (0, 6 and 12 mrad to both sides) and yaws (0 and 20 mrad).
    pub fn of(pair: &Pair) -> Option<Self> {
        let grid = Grid::default()
            .with_roll_rad(Axis {
                ends: [-12e-3, -12e-3, 12e-3, 12e-3],
                cells: [0, 4, 0],
            })
            .with_yaw_squared_rad2(Axis {
                ends: [0.0, 0.0, 4e-4, 4e-4],
                cells: [0, 1, 0],
            });
        let geometry = ContactGeometry::new(pair.clone(), Steel::default(), LOAD_N).ok()?;
        let jump = Tables::greatest_jump(&geometry, &grid).ok()??;
        (jump.excess() > MAX_JUMP).then(|| jump.into())
    }
}

/// Rigid contacts of a wheelset, from left to right.
pub struct WheelsetGeometry {
    /// At each lateral shift, 25 um apart from -12 mm to 12 mm.
    pub contacts: Vec<RigidContact>,
    /// Of the right less the left wheel.
    pub rolling: RollingRadiusDifference,
}

/// Equivalent conicity at an amplitude.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Conicity {
    /// Amplitude, m.
    pub amplitude_m: f64,
    /// Conicity by EN 15302; none where the wheelset finds no closed path.
    pub equivalent_conicity: Option<f64>,
}

/// The rigid wheelset at a lateral shift.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Shift {
    /// Lateral shift at the rails' top, to the right, m.
    pub lateral_shift_m: f64,
    /// Rolling radius of the right wheel less that of the left one, m.
    pub rolling_radius_difference_m: f64,
    /// Roll of the wheelset, rad.
    pub roll_rad: f64,
    /// Contact angle of the left wheel, rad.
    pub contact_angle_left_rad: f64,
    /// Contact angle of the right wheel, rad.
    pub contact_angle_right_rad: f64,
    /// Where the left wheel is touched, from the tread datum to the field side, m.
    pub wheel_place_left_m: f64,
    /// Where the right wheel is touched, m.
    pub wheel_place_right_m: f64,
}

impl From<&RigidContact> for Shift {
    fn from(contact: &RigidContact) -> Self {
        Self {
            lateral_shift_m: contact.lateral_m,
            rolling_radius_difference_m: contact.rolling_radius_difference_m(),
            roll_rad: contact.roll_rad,
            contact_angle_left_rad: -contact.sides[0].slope.atan(),
            contact_angle_right_rad: -contact.sides[1].slope.atan(),
            wheel_place_left_m: contact.sides[0].wheel_y_m,
            wheel_place_right_m: contact.sides[1].wheel_y_m,
        }
    }
}

impl WheelsetGeometry {
    /// Of a wheel and a rail.
    ///
    /// # Errors
    /// Contacts that make no rolling radius difference.
    pub fn of(pair: &Pair) -> Result<Self, RollingRadiusError> {
        let mut scratch = Vec::new();
        let contacts: Vec<RigidContact> = (0..=CELLS)
            .map(|i| LARGEST_SHIFT_M * (2.0 * i as f64 / CELLS as f64 - 1.0))
            .map(|shift| pair.rigid_contact(shift, 0.0, &mut scratch))
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

    /// Equivalent conicity at amplitudes from 0.5 mm to 8 mm.
    pub fn conicities(&self, pair: &Pair) -> Vec<Conicity> {
        let radius_m = pair.installation().wheel_radius_m;
        (1..=AMPLITUDES)
            .map(|i| f64::from(i) * 0.5e-3)
            .map(|amplitude_m| Conicity {
                amplitude_m,
                equivalent_conicity: self.rolling.equivalent_conicity(amplitude_m, radius_m),
            })
            .collect()
    }
}
