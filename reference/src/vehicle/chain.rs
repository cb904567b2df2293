//! A damper between two bodies: clearance, springs and velocity law of the reference damper. Its state is the position
//! of its piston.
//!
//! Displacement and force are positive in extension. The displacement from the piston has seven ranges: yielding,
//! flowing and held in compression, clearance, then held, flowing and yielding in extension.

use dashpot_core::DamperParameters;

use super::ranges::Ranges;
use crate::damper::side::Side;
use crate::error::ReferenceError;

/// Index of the clearance range.
pub(super) const CLEARANCE: usize = 3;

/// Overlap of the velocity ranges at the end of yielding (m/s).
const OVERLAP_M_PER_S: f64 = 1e-10;

/// Step of central differences (m).
const STEP_M: f64 = 1e-9;

/// One direction of the damper, with its yield point.
#[derive(Clone, Debug)]
struct Direction {
    side: Side,
    yield_stretch: f64,
    /// Slopes of force and velocity over stretch at the yield force (N/m, 1/s).
    slopes: [f64; 2],
}

/// A damper with clearance and springs.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    directions: [Direction; 2],
    half_clearance: f64,
    pub(super) ranges: Ranges,
}

impl Chain {
    pub(super) fn new(parameters: &DamperParameters) -> Result<Self, ReferenceError> {
        let directions = Side::both(parameters)?.map(|side| {
            let yield_stretch = side.stretch(side.yield_force);
            let below = 0.999 * side.yield_coordinate;
            let change = yield_stretch - side.stretch(side.force(below));
            let slopes = [
                (side.yield_force - side.force(below)) / change,
                (side.yield_velocity - side.velocity(below)) / change,
            ];
            Direction {
                side,
                yield_stretch,
                slopes,
            }
        });
        let half_clearance = 0.5 * parameters.mount.clearance_m;
        let edges = |direction: &Direction| {
            [0.0, direction.side.closed_stretch, direction.yield_stretch]
                .map(|x| x + half_clearance)
        };
        let [extension, compression] = &directions;
        let inward = edges(compression).into_iter().rev().map(|edge| -edge);
        Ok(Self {
            ranges: Ranges {
                edges: inward.chain(edges(extension)).collect(),
            },
            directions,
            half_clearance,
        })
    }

    /// Working direction of a range, and its sign.
    fn working(&self, range: usize) -> (&Direction, f64) {
        if range > CLEARANCE {
            (&self.directions[0], 1.0)
        } else {
            (&self.directions[1], -1.0)
        }
    }

    /// Force (N) at a displacement from the piston (m).
    pub(super) fn force(&self, range: usize, from_piston: f64) -> f64 {
        let (direction, sign) = self.working(range);
        let stretch = sign * from_piston - self.half_clearance;
        sign * match range.abs_diff(CLEARANCE) {
            0 => 0.0,
            1 => direction.held_force(stretch),
            2 => direction.flow(stretch)[0],
            _ => direction.side.yield_force,
        }
    }

    /// Velocity of the piston (m/s) while the ends separate at `velocity` (m/s).
    pub(super) fn piston_velocity(&self, range: usize, from_piston: f64, velocity: f64) -> f64 {
        let (direction, sign) = self.working(range);
        match range.abs_diff(CLEARANCE) {
            0 | 1 => 0.0,
            2 => sign * direction.flow(sign * from_piston - self.half_clearance)[1],
            _ => velocity,
        }
    }

    /// Derivatives of the force (N/m) and of the piston velocity (1/s) with respect to the displacement from the
    /// piston, and of the piston velocity with respect to the velocity of the ends (1).
    ///
    /// Central differences are accurate enough for an iteration.
    pub(super) fn slopes(&self, range: usize, from_piston: f64) -> [f64; 3] {
        match range.abs_diff(CLEARANCE) {
            0 => [0.0; 3],
            3 => [0.0, 0.0, 1.0],
            _ => {
                let at = |x: f64| [self.force(range, x), self.piston_velocity(range, x, 0.0)];
                let (behind, ahead) = (at(from_piston - STEP_M), at(from_piston + STEP_M));
                let slope = |output: usize| (ahead[output] - behind[output]) / (2.0 * STEP_M);
                [slope(0), slope(1), 0.0]
            }
        }
    }

    /// Distances to both ends of a range, positive inside. The velocity, not the displacement, ends yielding.
    pub(super) fn margins(&self, range: usize, from_piston: f64, velocity: f64) -> [f64; 2] {
        let (direction, sign) = self.working(range);
        if range.abs_diff(CLEARANCE) == 3 {
            let speed = sign * velocity;
            return [speed - direction.side.yield_velocity + OVERLAP_M_PER_S, 1.0];
        }
        self.ranges.margins(range, from_piston)
    }

    /// Returns the new range, and the displacement from the piston, of a damper that was in `range`.
    pub(super) fn settled(&self, range: usize, from_piston: f64, velocity: f64) -> (usize, f64) {
        let yields = |range: usize| {
            let (direction, sign) = self.working(range);
            range.abs_diff(CLEARANCE) == 3
                && sign * velocity - direction.side.yield_velocity > -0.5 * OVERLAP_M_PER_S
        };
        if range.abs_diff(CLEARANCE) == 3 {
            if yields(range) {
                return (range, from_piston);
            }
            let (direction, sign) = self.working(range);
            let at_edge = sign * (self.half_clearance + direction.yield_stretch);
            return (if range == 0 { 1 } else { 5 }, at_edge);
        }
        let settled = self.ranges.settled(range, from_piston);
        if settled.abs_diff(CLEARANCE) == 3 && !yields(settled) {
            return (if settled == 0 { 1 } else { 5 }, from_piston);
        }
        (settled, from_piston)
    }
}

impl Direction {
    /// Force with the piston at rest, extrapolated linearly beyond its range of stretch.
    fn held_force(&self, stretch: f64) -> f64 {
        let (force, max) = (self.side.closed_force, self.side.closed_stretch);
        if max > 0.0 {
            let within = stretch.clamp(0.0, max);
            self.side.held_force(within) + (stretch - within) * force / max
        } else {
            0.0
        }
    }

    /// Force and piston velocity in flow at a stretch, continued as an odd function below the range and linearly above.
    fn flow(&self, stretch: f64) -> [f64; 2] {
        let closed = self.side.closed_stretch;
        let beyond = stretch - self.yield_stretch;
        if beyond > 0.0 {
            return [
                self.side.yield_force + beyond * self.slopes[0],
                self.side.yield_velocity + beyond * self.slopes[1],
            ];
        }
        let y = self
            .side
            .coordinate_stretched(closed + (stretch - closed).abs());
        let (above, velocity) = (
            self.side.force(y) - self.side.closed_force,
            self.side.velocity(y),
        );
        let sign = if stretch < closed { -1.0 } else { 1.0 };
        [self.side.closed_force + sign * above, sign * velocity]
    }
}
