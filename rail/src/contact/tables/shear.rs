//! How the contact moves across the nodes of the shift when roll and yaw change.

use super::row::Row;
use crate::contact::geometry::ContactGeometry;

/// Load for which the flange's approach is followed: index of a level.
const LEVEL: usize = 4;
/// Part of the load on the flange at which the contact counts as moving to it.
const HALF_WAY: f64 = 0.5;
/// Range in which the contact is sought, and the distance of the shifts tried first, m.
const RANGE_M: [f64; 2] = [-10e-3, 40e-3];
const STEP_M: f64 = 0.5e-3;
/// Bisections of this distance.
const BISECTIONS: usize = 14;
/// Roll and yaw at which the contact is sought, rad.
const ROLL_RAD: f64 = 4e-3;
const YAW_RAD: f64 = 15e-3;
/// Bounds of both movements, m/rad and m/rad^2. They keep the range of the shift.
const MAX: [f64; 2] = [0.1, 3.0];

/// Movement of the contact on the flange: the shift at which the wheel reaches its flange is larger by
/// `roll * per_roll + yaw^2 * per_squared_yaw` at other rolls and yaws. Nodes that move by as much keep it between the
/// same two nodes, where it would otherwise be blurred from one roll to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Shear {
    /// Micrometres per radian.
    per_roll_um: i32,
    /// Micrometres per squared radian.
    per_squared_yaw_um: i32,
}

impl Shear {
    /// Measures the movement on the elastic contact of a pair; none if the wheel does not reach its flange.
    pub fn of(geometry: &ContactGeometry) -> Self {
        let at = |roll_rad: f64, yaw_rad: f64| flange_shift_m(geometry, roll_rad, yaw_rad);
        let per_roll = at(ROLL_RAD, 0.0)
            .zip(at(-ROLL_RAD, 0.0))
            .map(|(after, before)| (after - before) / (2.0 * ROLL_RAD));
        let per_squared_yaw = at(0.0, YAW_RAD)
            .zip(at(0.0, 0.0))
            .map(|(after, before)| (after - before) / (YAW_RAD * YAW_RAD));
        let rounded = |movement: Option<f64>, max: f64| {
            (1e6 * movement.unwrap_or(0.0).clamp(-max, max)).round() as i32
        };
        Self {
            per_roll_um: rounded(per_roll, MAX[0]),
            per_squared_yaw_um: rounded(per_squared_yaw, MAX[1]),
        }
    }

    /// The movement from its whole numbers; `None` beyond the bounds.
    pub fn from_micrometres([per_roll_um, per_squared_yaw_um]: [i32; 2]) -> Option<Self> {
        let is_inside = |um: i32, max: f64| f64::from(um.unsigned_abs()) <= 1e6 * max;
        (is_inside(per_roll_um, MAX[0]) && is_inside(per_squared_yaw_um, MAX[1])).then_some(Self {
            per_roll_um,
            per_squared_yaw_um,
        })
    }

    /// The movement in whole numbers: micrometres per radian of roll and per squared radian of yaw.
    pub fn micrometres(&self) -> [i32; 2] {
        [self.per_roll_um, self.per_squared_yaw_um]
    }

    /// Movement per roll, m/rad, and per squared yaw, m/rad^2.
    pub fn movements(&self) -> [f64; 2] {
        self.micrometres().map(|um| 1e-6 * f64::from(um))
    }
}

/// The lateral shift at which the contact is half-way from tread to flange, m.
fn flange_shift_m(geometry: &ContactGeometry, roll_rad: f64, yaw_rad: f64) -> Option<f64> {
    let mut row = Row::new(geometry, roll_rad, yaw_rad);
    let mut is_beyond = |shift_m: f64| row.part_on_flange(shift_m, LEVEL) > HALF_WAY;
    let steps = ((RANGE_M[1] - RANGE_M[0]) / STEP_M) as usize;
    let shift = |step: usize| RANGE_M[0] + step as f64 * STEP_M;
    let first = (0..=steps).find(|step| is_beyond(shift(*step)))?;
    let (mut before, mut beyond) = (shift(first.checked_sub(1)?), shift(first));
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (before + beyond);
        if is_beyond(middle) {
            beyond = middle;
        } else {
            before = middle;
        }
    }
    Some(beyond)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{Installation, Pair, Steel};

    /// A flange of slope `t` and radius `r` at yaw `p` is `r t^2 p^2 / 2` deeper, so it touches earlier by
    /// `r t p^2 / 2`. Roll turns the wheel about its datum: a flange at the depth `z` and the distance `y` from the
    /// tread's contact touches later by `y / t + z`, less the rail's way down.
    #[test]
    fn the_flange_of_s1002_moves_by_its_slope() {
        let pair = Pair::standard(Installation::default()).unwrap();
        let slope = pair.flange_angle_rad().tan();
        let geometry = ContactGeometry::new(pair, Steel::default()).unwrap();
        let [per_roll, per_squared_yaw] = Shear::of(&geometry).movements();
        let expected = -0.5 * 0.625 * slope;
        assert!(
            (per_squared_yaw / expected - 1.0).abs() < 0.2,
            "{per_squared_yaw} {expected}"
        );
        assert!((0.0..0.05).contains(&per_roll), "{per_roll}");
    }

    #[test]
    fn whole_numbers_keep_the_movement() {
        let shear = Shear::from_micrometres([41_000, -1_100_000]).unwrap();
        assert_eq!(Shear::from_micrometres(shear.micrometres()), Some(shear));
        let [per_roll, per_squared_yaw] = shear.movements();
        assert!((per_roll - 0.041).abs() < 1e-12 && (per_squared_yaw + 1.1).abs() < 1e-12);
        assert_eq!(Shear::from_micrometres([200_000, 0]), None);
        assert_eq!(Shear::from_micrometres([0, i32::MIN]), None);
    }
}
