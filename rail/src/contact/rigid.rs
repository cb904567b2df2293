//! Contact of rigid bodies: the deepest point of a wheel, and a wheelset resting on both rails.

use super::contact_point::ContactPoint;
use super::pair::Pair;
use super::silhouette::{SilhouettePoint, WheelPose};

/// A rigid wheelset resting on both rails without penetration.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RigidContact {
    /// Lateral shift at the height of the top of the rails, right positive, m.
    pub lateral_m: f64,
    /// Roll, right side down positive, rad.
    pub roll_rad: f64,
    /// Depth of the wheelset's centre, m; zero at the height at which the tread datum is level with the rail's top.
    pub vertical_m: f64,
    /// Contact points of the left wheel (as its mirror image on the right side) and of the right wheel.
    pub sides: [ContactPoint; 2],
}

impl RigidContact {
    /// Rolling radius of the right wheel minus that of the left wheel, m.
    pub fn rolling_radius_difference_m(&self) -> f64 {
        self.sides[1].wheel_z_m - self.sides[0].wheel_z_m
    }

    /// Finds the contact points of a rigid wheelset as [`Pair::rigid_contact`] does, for a left and a right side that
    /// differ. The left pair is given as its mirror image, as if it were on the right side.
    pub fn of_sides(
        [left, right]: [&Pair; 2],
        lateral_m: f64,
        yaw_rad: f64,
        scratch: &mut Vec<SilhouettePoint>,
    ) -> Self {
        let [left_datum, right_datum] =
            [left, right].map(|pair| pair.installation().datum_offset_m());
        let distance = left_datum + right_datum;
        let mut sides_at = |roll: f64| {
            let mut side = |pair: &Pair, datum: f64, sign: f64| {
                let narrowing = datum * (libm::cos(yaw_rad) * libm::cos(roll) - 1.0);
                let pose = WheelPose {
                    lateral_m: sign * lateral_m + narrowing,
                    roll_rad: sign * roll,
                    yaw_rad: sign * yaw_rad,
                };
                pair.deepest(&pose, scratch)
            };
            let sides = [side(left, left_datum, -1.0), side(right, right_datum, 1.0)];
            let residual = sides[1].interpenetration_m - sides[0].interpenetration_m
                + distance * libm::cos(yaw_rad) * libm::sin(roll);
            (sides, residual)
        };
        let mut roll = 0.0;
        let (mut sides, mut residual) = sides_at(roll);
        let mut slope = distance;
        for _ in 0..30 {
            let next = roll - residual / slope;
            let (next_sides, next_residual) = sides_at(next);
            let secant = (next_residual - residual) / (next - roll);
            (roll, residual, sides) = (next, next_residual, next_sides);
            if residual.abs() < 1e-10 || !secant.is_finite() {
                break;
            }
            // The residual has a kink where the contact jumps; bounds on the slope keep the step reasonable.
            slope = secant.clamp(0.5 * distance, 2.0 * distance);
        }
        Self {
            lateral_m,
            roll_rad: roll,
            vertical_m: -0.5 * (sides[0].interpenetration_m + sides[1].interpenetration_m),
            sides,
        }
    }
}

impl Pair {
    /// Finds the contact points of a rigid wheelset, shifted and yawed, that rests on both rails.
    ///
    /// The roll solves `z_right - z_left + 2 e sin(roll) = 0` with the interpenetrations `z` and the offset `e` of
    /// the tread datum, by the secant method. `scratch` is working memory and is overwritten.
    ///
    /// ```
    /// use dashpot_rail::contact::{Installation, Pair};
    /// let pair = Pair::standard(Installation::default())?;
    /// let contact = pair.rigid_contact(3e-3, 0.0, &mut Vec::new());
    /// // A shift to the right makes the right rolling radius the larger one.
    /// assert!((contact.rolling_radius_difference_m() - 0.977e-3).abs() < 1e-5);
    /// # Ok::<(), dashpot_rail::contact::PairError>(())
    /// ```
    pub fn rigid_contact(
        &self,
        lateral_m: f64,
        yaw_rad: f64,
        scratch: &mut Vec<SilhouettePoint>,
    ) -> RigidContact {
        RigidContact::of_sides([self, self], lateral_m, yaw_rad, scratch)
    }

    /// Finds the deepest point of one wheel at `pose`, for rigid bodies; `scratch` is overwritten.
    pub fn deepest(&self, pose: &WheelPose, scratch: &mut Vec<SilhouettePoint>) -> ContactPoint {
        self.silhouette(pose, scratch);
        let deepest = (0..scratch.len()).max_by(|&i, &j| {
            scratch[i]
                .interpenetration_m
                .total_cmp(&scratch[j].interpenetration_m)
        });
        let Some(deepest) = deepest else {
            return self.absent();
        };
        let at = |i: usize| self.contact_point(&scratch[i]);
        if deepest == 0 || deepest + 1 == scratch.len() {
            return at(deepest);
        }
        vertex(&at(deepest - 1), &at(deepest), &at(deepest + 1))
    }
}

/// The patch at the vertex of the parabola through three neighbouring interpenetrations.
fn vertex(before: &ContactPoint, deepest: &ContactPoint, after: &ContactPoint) -> ContactPoint {
    let distance = |other: &ContactPoint| other.track_y_m - deepest.track_y_m;
    let rise = |other: &ContactPoint| other.interpenetration_m - deepest.interpenetration_m;
    let (x0, x2) = (distance(before), distance(after));
    let (f0, f2) = (rise(before), rise(after));
    let quadratic = (f0 / x0 - f2 / x2) / (x0 - x2);
    let linear = f0 / x0 - quadratic * x0;
    if quadratic >= 0.0 || quadratic.is_nan() {
        return *deepest;
    }
    let x = (-0.5 * linear / quadratic).clamp(x0.min(x2), x0.max(x2));
    let (neighbour, distance) = if x * x2 > 0.0 {
        (after, x2)
    } else {
        (before, x0)
    };
    ContactPoint {
        interpenetration_m: deepest.interpenetration_m + 0.5 * linear * x,
        ..deepest.zip(neighbour, |value, neighbour| {
            value + x / distance * (neighbour - value)
        })
    }
}
