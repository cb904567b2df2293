//! Dry friction: a spring in series with a slider that holds up to a limit.
//!
//! The slider rests in one range of the law, so its position is constant between two events. In the other two it slides
//! and the force is the limit, so its position follows from the displacement. It has to be set only where sliding ends.

use super::coupling::Extension;
use super::ranges::OVERLAP_M;

/// Index of the range in which the slider rests. It slides towards negative displacements in the range before, and
/// towards positive ones in the range after.
pub(super) const RESTING: usize = 1;

/// Overlap of the ranges at the end of sliding (m/s).
const OVERLAP_M_PER_S: f64 = 1e-10;

/// A friction element.
#[derive(Clone, Debug)]
pub(super) struct Friction {
    pub(super) stiffness: f64,
    /// Constant part of the limit (N).
    pub(super) constant: f64,
    /// Element whose load the limit follows, and the coefficient.
    pub(super) load: Option<(usize, f64)>,
}

/// Direction of sliding.
fn sign(range: usize) -> f64 {
    range as f64 - RESTING as f64
}

impl Friction {
    /// Limit of the force (N) and its rate (N/s) at a load (N) and its rate (N/s).
    pub(super) fn limit(&self, [load, rate]: [f64; 2]) -> [f64; 2] {
        let coefficient = self.load.map_or(0.0, |(_, coefficient)| coefficient);
        if load > 0.0 {
            [self.constant + coefficient * load, coefficient * rate]
        } else {
            [self.constant, 0.0]
        }
    }

    /// Force that resists a displacement (N).
    pub(super) fn force(&self, range: usize, at: &Extension, slider: f64) -> f64 {
        if range == RESTING {
            self.stiffness * (at.displacement - slider)
        } else {
            sign(range) * at.limit[0]
        }
    }

    /// Derivatives of the force with respect to the displacement (N/m) and to the load (1).
    pub(super) fn slopes(&self, range: usize) -> [f64; 2] {
        if range == RESTING {
            [self.stiffness, 0.0]
        } else {
            let coefficient = self.load.map_or(0.0, |(_, coefficient)| coefficient);
            [0.0, sign(range) * coefficient]
        }
    }

    /// Velocity of the slider in the direction in which it slides: that of the ends without that of the spring.
    fn sliding_velocity(&self, range: usize, at: &Extension) -> f64 {
        sign(range) * at.velocity - at.limit[1] / self.stiffness
    }

    /// Distances to both ends of a range, positive inside. The velocity, not the displacement, ends sliding.
    pub(super) fn margins(&self, range: usize, at: &Extension, slider: f64) -> [f64; 2] {
        if range == RESTING {
            let (stretch, most) = (at.displacement - slider, at.limit[0] / self.stiffness);
            return [most + stretch + OVERLAP_M, most - stretch + OVERLAP_M];
        }
        [self.sliding_velocity(range, at) + OVERLAP_M_PER_S, 1.0]
    }

    /// Returns, for an element that was in `range`, the new range and the position of the slider.
    pub(super) fn settled(&self, range: usize, at: &Extension, slider: f64) -> (usize, f64) {
        let stretch = at.displacement - slider;
        let most = at.limit[0] / self.stiffness;
        let sliding = if range != RESTING {
            range
        } else if stretch.abs() - most <= 0.5 * OVERLAP_M {
            return (RESTING, slider);
        } else if stretch > 0.0 {
            RESTING + 1
        } else {
            RESTING - 1
        };
        if self.sliding_velocity(sliding, at) > -0.5 * OVERLAP_M_PER_S {
            return (sliding, slider);
        }
        (RESTING, at.displacement - sign(sliding) * most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(displacement: f64, velocity: f64) -> Extension {
        Extension {
            displacement,
            velocity,
            limit: [10e3, 0.0],
        }
    }

    #[test]
    fn a_slider_slides_at_its_limit_until_the_motion_turns() {
        let friction = Friction {
            stiffness: 5e6,
            constant: 10e3,
            load: None,
        };
        // The spring takes 2 mm.
        assert_eq!(friction.force(RESTING, &at(1.5e-3, 0.1), 0.0), 7.5e3);
        assert_eq!(
            friction.settled(RESTING, &at(1.5e-3, 0.1), 0.0),
            (RESTING, 0.0)
        );
        let past = at(2e-3 + 2.0 * OVERLAP_M, 0.1);
        assert!(friction.margins(RESTING, &past, 0.0)[1] < 0.0);
        let (range, _) = friction.settled(RESTING, &past, 0.0);
        assert_eq!(range, 2);
        assert_eq!(friction.force(range, &at(7e-3, 0.1), 0.0), 10e3);
        let turned = at(7e-3, -1e-9);
        assert!(friction.margins(range, &turned, 0.0)[0] < 0.0);
        let (range, slider) = friction.settled(range, &turned, 0.0);
        assert_eq!((range, slider), (RESTING, 5e-3));
        assert_eq!(friction.settled(RESTING, &at(2.9e-3, -0.1), slider).0, 0);
        assert_eq!(friction.force(0, &at(-9e-3, -0.1), slider), -10e3);
        // A limit that falls lets the slider move while the ends rest.
        let falling = Extension {
            limit: [10e3, -1e3],
            ..at(2e-3 + 2.0 * OVERLAP_M, 0.0)
        };
        assert_eq!(friction.settled(RESTING, &falling, 0.0).0, 2);
    }
}
