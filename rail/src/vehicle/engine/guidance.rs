//! Effect of the track layout on the bodies above it.

use super::block::{N, Vector};
use crate::track::{Alignment, Layout};
use crate::vehicle::GRAVITY_M_PER_S2;

/// Lateral distance between the contact points of a centred wheelset, over which cant is measured, m.
pub const CANT_BASE_M: f64 = 1.5;

/// Position of a body: longitudinal from the middle of the vehicle, and height of its centre above the top of the
/// rails, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BodyPosition {
    pub x_m: f64,
    pub height_m: f64,
}

/// The track frame under each body, in the order of the body's coordinates.
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Guidance {
    /// Displacement and rotation of the body's centre by the frame since the distance 0.
    pub pose: Vec<Vector>,
    /// Rate of `pose`.
    pub pose_rate: Vec<Vector>,
    /// Pose of the body's frame relative to the frame at the middle of the vehicle, in which elements are defined.
    pub relative: Vec<Vector>,
    /// Rate of `relative`.
    pub relative_rate: Vec<Vector>,
    /// Gravity and centrifugal acceleration in excess of those on straight level track.
    pub acceleration: Vec<Vector>,
}

/// The cant as an angle.
#[derive(Debug, Clone, Copy)]
struct Bank {
    sine: f64,
    cosine: f64,
    roll: f64,
    rate: f64,
}

impl Bank {
    #[inline(always)]
    fn new(alignment: &Alignment, speed_m_per_s: f64) -> Self {
        let sine = alignment.cant_m / CANT_BASE_M;
        let cosine = (1.0 - sine * sine).sqrt();
        Self {
            sine,
            cosine,
            roll: cant_angle(sine),
            rate: speed_m_per_s * alignment.cant_slope / (CANT_BASE_M * cosine),
        }
    }
}

/// Arc sine by its series; the error is below 2e-8 for the largest cant of a layout.
#[inline(always)]
fn cant_angle(sine: f64) -> f64 {
    let square = sine * sine;
    sine * (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0 + square * (15.0 / 336.0))))
}

impl Guidance {
    /// Returns the frames on straight track, which are all zero.
    pub fn new(bodies: usize) -> Self {
        let zeros = vec![[0.0; N]; bodies];
        Self {
            pose: zeros.clone(),
            pose_rate: zeros.clone(),
            relative: zeros.clone(),
            relative_rate: zeros.clone(),
            acceleration: zeros,
        }
    }

    /// Updates the frames with the middle of the vehicle at `distance_m`.
    #[inline(always)]
    pub fn update(
        &mut self,
        layout: &Layout,
        distance_m: f64,
        speed_m_per_s: f64,
        positions: &[BodyPosition],
    ) {
        let middle = layout.course(distance_m);
        let middle_bank = Bank::new(&middle.alignment, speed_m_per_s);
        let middle_curvature = middle.alignment.curvature_per_m;
        let poses = self.pose.iter_mut().zip(&mut self.pose_rate);
        let relatives = self.relative.iter_mut().zip(&mut self.relative_rate);
        let frames = poses.zip(relatives).zip(&mut self.acceleration);
        for (position, (((pose, pose_rate), (relative, relative_rate)), acceleration)) in
            positions.iter().zip(frames)
        {
            let course = layout.course(distance_m + position.x_m);
            let bank = Bank::new(&course.alignment, speed_m_per_s);
            let curvature = course.alignment.curvature_per_m;
            let heading = course.heading_rad - middle.heading_rad;
            let (roll, rate) = (bank.roll - middle_bank.roll, bank.rate - middle_bank.rate);
            let offset = course.offset_m - middle.offset_m - middle.heading_rad * position.x_m;
            let height = position.height_m;
            let centripetal = speed_m_per_s * speed_m_per_s * curvature;
            // The frame has neither vertical displacement nor pitch.
            [pose[0], pose[2], pose[4]] = [height * bank.roll, bank.roll, course.heading_rad];
            let turn = speed_m_per_s * curvature;
            [pose_rate[0], pose_rate[2], pose_rate[4]] = [height * bank.rate, bank.rate, turn];
            [relative[0], relative[2], relative[4]] = [offset + height * roll, roll, heading];
            let drift = speed_m_per_s * (heading - middle_curvature * position.x_m);
            let turn = speed_m_per_s * (curvature - middle_curvature);
            [relative_rate[0], relative_rate[2], relative_rate[4]] =
                [drift + height * rate, rate, turn];
            acceleration[0] = GRAVITY_M_PER_S2 * middle_bank.sine - centripetal * bank.cosine;
            acceleration[1] =
                GRAVITY_M_PER_S2 * (middle_bank.cosine - 1.0) + centripetal * bank.sine;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::Part;

    const SPEED: f64 = 30.0;
    const POSITIONS: [BodyPosition; 3] =
        [position(0.0, 1.5), position(9.0, 0.6), position(-7.0, 2.0)];

    const fn position(x_m: f64, height_m: f64) -> BodyPosition {
        BodyPosition { x_m, height_m }
    }

    /// A transition of 100 m from 1000 m to 250 m, with cant from 0.06 m to 0.15 m.
    fn clothoid() -> Layout {
        let circular = |radius_m: f64, cant_m: f64| Part::Circular {
            radius_m,
            length_m: 50.0,
            cant_m,
        };
        let transition = Part::Transition { length_m: 100.0 };
        Layout::new(&[circular(1000.0, 0.06), transition, circular(250.0, 0.15)]).unwrap()
    }

    fn at(layout: &Layout, distance_m: f64) -> Guidance {
        let mut guidance = Guidance::new(POSITIONS.len());
        guidance.update(layout, distance_m, SPEED, &POSITIONS);
        guidance
    }

    /// The first omitted term is `35/1152 sine^9`.
    #[test]
    fn the_cant_angle_is_the_arc_sine() {
        for i in -20..=20 {
            let sine = 0.01 * f64::from(i);
            let error = (cant_angle(sine) - sine.asin()).abs();
            assert!(
                error <= 0.04 * sine.abs().powi(9) + 1e-16,
                "{sine}: {error}"
            );
        }
    }

    #[test]
    fn a_pose_follows_the_heading_and_the_cant_under_its_body() {
        let layout = clothoid();
        let guidance = at(&layout, 90.0);
        for (position, pose) in POSITIONS.iter().zip(&guidance.pose) {
            let under = layout.course(90.0 + position.x_m);
            let roll = (under.alignment.cant_m / 1.5).asin();
            let expected = [position.height_m * roll, 0.0, roll, 0.0, under.heading_rad];
            for (found, expected) in pose.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-9, "{pose:?}");
            }
        }
    }

    /// Along a clothoid the curvature changes by `c` per metre. Ahead by x, the frame is turned by `k x + c x^2/2` and
    /// lies `k x^2/2 + c x^3/6` to the side.
    #[test]
    fn a_relative_frame_lies_on_the_clothoid() {
        let layout = clothoid();
        let guidance = at(&layout, 90.0);
        let k = layout.at(90.0).curvature_per_m;
        let c = (1.0 / 250.0 - 1.0 / 1000.0) / 100.0;
        let roll = |x: f64| (layout.at(90.0 + x).cant_m / 1.5).asin();
        for (position, relative) in POSITIONS.iter().zip(&guidance.relative) {
            let x = position.x_m;
            let roll = roll(x) - roll(0.0);
            let lateral = k * x * x / 2.0 + c * x * x * x / 6.0 + position.height_m * roll;
            let expected = [lateral, 0.0, roll, 0.0, k * x + c * x * x / 2.0];
            for (found, expected) in relative.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-9, "{x}: {relative:?}");
            }
        }
    }

    #[test]
    fn rates_are_the_derivatives_of_the_poses() {
        let layout = clothoid();
        let half_s = 1e-4;
        let guidance = at(&layout, 90.0);
        let [before, after] = [-half_s, half_s].map(|s| at(&layout, 90.0 + SPEED * s));
        for body in 0..POSITIONS.len() {
            for i in 0..N {
                let slope =
                    |from: &[Vector], to: &[Vector]| (to[body][i] - from[body][i]) / (2.0 * half_s);
                let pose = slope(&before.pose, &after.pose);
                assert!((guidance.pose_rate[body][i] - pose).abs() < 1e-6, "{i}");
                let relative = slope(&before.relative, &after.relative);
                let found = guidance.relative_rate[body][i];
                assert!((found - relative).abs() < 1e-6, "{i}: {found} {relative}");
            }
        }
    }

    /// Gravity acts in the frame at the middle of the vehicle. The centrifugal acceleration is horizontal.
    #[test]
    fn each_body_feels_the_curvature_under_it() {
        let layout = clothoid();
        let guidance = at(&layout, 90.0);
        let middle = (layout.at(90.0).cant_m / 1.5).asin();
        for (position, found) in POSITIONS.iter().zip(&guidance.acceleration) {
            let under = layout.at(90.0 + position.x_m);
            let outward = SPEED * SPEED * under.curvature_per_m;
            let (sin, cos) = (under.cant_m / 1.5).asin().sin_cos();
            let lateral = GRAVITY_M_PER_S2 * middle.sin() - outward * cos;
            let vertical = GRAVITY_M_PER_S2 * (middle.cos() - 1.0) + outward * sin;
            assert!((found[0] - lateral).abs() < 1e-12, "{found:?}");
            assert!((found[1] - vertical).abs() < 1e-12, "{found:?}");
            assert_eq!(found[2..], [0.0; 3]);
        }
    }
}
