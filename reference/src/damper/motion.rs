//! Steps the chain (clearance, springs and piston in series) through its modes over a piecewise linear motion.
//!
//! While the damper crosses its clearance, is held by a piston at rest, or yields, the force follows from the geometry;
//! only flow through the valves is integrated. Within one linear piece the pressure coordinate changes in one
//! direction, so the next bound that it can reach is known in advance.

use std::rc::Rc;

use super::segment::{Integrator, Scales, Segment};
use super::side::Side;
use crate::error::ReferenceError;

/// Seat velocity, relative to the typical velocity, below which the seats count as at rest: the equilibrium force and
/// the neglected stretch are then below any tolerance.
const REST: f64 = 1e-8;

/// Maximum number of mode changes within one linear piece; each side causes at most two, plus one per kink.
const MAX_CHANGES: usize = 1000;

/// Mode of the chain.
#[derive(Clone, Copy, Debug)]
pub(super) enum Mode {
    /// Between the seats, without force.
    Clearance { piston: f64 },
    /// In contact; friction or closed valves hold the piston.
    Held { side: usize, piston: f64 },
    /// In contact; oil flows.
    Flow { side: usize, coordinate: f64 },
    /// Yielding at the force limit.
    Yield { side: usize },
}

/// A linear piece of motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// Displacement at the start (m).
    pub(super) start: f64,
    /// Displacement at the end (m).
    pub(super) end: f64,
    /// Duration (s).
    pub(super) duration: f64,
}

/// Statistics of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Accepted steps of the solver.
    pub steps: usize,
    /// Changes of mode.
    pub events: usize,
    /// Largest difference over a segment between the integrated piston travel and the travel that follows from the
    /// geometry of the chain (m).
    pub closure_m: f64,
}

/// State of the chain while it follows a motion.
pub(super) struct Motion {
    pub(super) sides: Rc<[Side; 2]>,
    pub(super) scales: Scales,
    /// Half the clearance (m).
    pub(super) half_clearance: f64,
    pub(super) mode: Mode,
    pub(super) statistics: Statistics,
}

/// +1 extension, -1 compression.
fn sign(side: usize) -> f64 {
    if side == 0 { 1.0 } else { -1.0 }
}

impl Motion {
    /// Force (N) at the displacement `x` (m) of the seats, positive if it resists extension.
    pub(super) fn force(&self, x: f64) -> f64 {
        match self.mode {
            Mode::Clearance { .. } => 0.0,
            Mode::Held { side, piston } => {
                let stretch = sign(side) * (x - piston) - self.half_clearance;
                sign(side) * self.sides[side].held_force(stretch)
            }
            Mode::Flow { side, coordinate } => sign(side) * self.sides[side].force(coordinate),
            Mode::Yield { side } => sign(side) * self.sides[side].yield_force,
        }
    }

    /// Moves the seats along one linear piece.
    pub(super) fn follow(
        &mut self,
        piece: &Piece,
        solver: &mut dyn Integrator,
    ) -> Result<(), ReferenceError> {
        let velocity = (piece.end - piece.start) / piece.duration;
        let mut elapsed = 0.0;
        for _ in 0..MAX_CHANGES {
            let left = piece.duration - elapsed;
            let x = if elapsed == 0.0 {
                piece.start
            } else {
                piece.start + velocity * elapsed
            };
            let (spent, next) = match self.mode {
                Mode::Clearance { piston } => self.cross_clearance(piston, x, velocity),
                Mode::Held { side, piston } => self.hold(side, piston, x, velocity),
                Mode::Flow { side, coordinate } => {
                    let start = (coordinate, x);
                    self.flow(side, start, velocity, left, solver)?
                }
                Mode::Yield { side } => self.give(side, velocity),
            };
            // Flow has been integrated up to its event or end; the other modes last until their event.
            let flowed = matches!(self.mode, Mode::Flow { .. });
            if spent >= left && !flowed {
                return Ok(());
            }
            if std::mem::discriminant(&self.mode) != std::mem::discriminant(&next) {
                self.statistics.events += 1;
            }
            elapsed += spent;
            self.mode = next;
            if spent >= left {
                return Ok(());
            }
        }
        Err(ReferenceError::Changes {
            max: MAX_CHANGES,
            start_m: piece.start,
            end_m: piece.end,
        })
    }

    fn cross_clearance(&self, piston: f64, x: f64, velocity: f64) -> (f64, Mode) {
        let stay = Mode::Clearance { piston };
        if velocity == 0.0 {
            return (f64::INFINITY, stay);
        }
        let side = usize::from(velocity < 0.0);
        let distance = (self.half_clearance - sign(side) * (x - piston)).max(0.0);
        (distance / velocity.abs(), Mode::Held { side, piston })
    }

    fn hold(&self, side: usize, piston: f64, x: f64, velocity: f64) -> (f64, Mode) {
        let stay = Mode::Held { side, piston };
        let stretch = (sign(side) * (x - piston) - self.half_clearance).max(0.0);
        let speed = sign(side) * velocity;
        if speed > 0.0 {
            let opening = (self.sides[side].closed_stretch - stretch).max(0.0);
            let flow = Mode::Flow {
                side,
                coordinate: 0.0,
            };
            (opening / speed, flow)
        } else if speed < 0.0 {
            (stretch / -speed, Mode::Clearance { piston })
        } else {
            (f64::INFINITY, stay)
        }
    }

    fn give(&self, side: usize, velocity: f64) -> (f64, Mode) {
        let limits = &self.sides[side];
        if sign(side) * velocity >= limits.yield_velocity {
            (f64::INFINITY, self.mode)
        } else {
            let coordinate = limits.yield_coordinate;
            (0.0, Mode::Flow { side, coordinate })
        }
    }

    /// Integrates flow until the next event, from the coordinate `start` at the displacement `x` of the seats.
    fn flow(
        &mut self,
        side: usize,
        (start, x): (f64, f64),
        velocity: f64,
        left: f64,
        solver: &mut dyn Integrator,
    ) -> Result<(f64, Mode), ReferenceError> {
        let laws = &self.sides[side];
        let mut speed = sign(side) * velocity;
        if speed.abs() < REST * self.scales.velocity {
            speed = 0.0;
        }
        let excess = speed - laws.velocity(start);
        let stay = |coordinate| (f64::INFINITY, Mode::Flow { side, coordinate });
        if excess == 0.0 {
            return Ok(stay(start));
        }
        let released = |x: f64| Mode::Held {
            side,
            piston: x - sign(side) * (self.half_clearance + laws.closed_stretch),
        };
        let bound = if excess > 0.0 {
            if start >= laws.yield_coordinate {
                return Ok((0.0, Mode::Yield { side }));
            }
            let ahead = laws.kinks.iter().find(|kink| **kink > start);
            ahead.copied().unwrap_or(laws.yield_coordinate)
        } else {
            if start <= 0.0 {
                return Ok((0.0, released(x)));
            }
            let behind = laws.kinks.iter().rfind(|kink| **kink < start);
            behind.copied().unwrap_or(0.0)
        };
        let segment = Segment {
            sides: Rc::clone(&self.sides),
            scales: self.scales,
            side,
            speed,
            start,
            bound,
            duration: left,
            knee: speed.abs() / self.scales.velocity * self.scales.coordinate[side],
        };
        let arrival = solver.advance(&segment)?;
        let end = if arrival.at_bound {
            bound
        } else {
            (arrival.state[0] * self.scales.coordinate[side]).max(0.0)
        };
        let spent = arrival.state[1] * self.scales.time;
        let stretched = laws.stretch(laws.force(end)) - laws.stretch(laws.force(start));
        let travel = arrival.state[2] * self.scales.stretch;
        let closure = (speed * spent - stretched - travel).abs();
        let next = if !arrival.at_bound {
            stay(end)
        } else if bound == laws.yield_coordinate {
            (spent, Mode::Yield { side })
        } else if bound > 0.0 {
            (
                spent,
                Mode::Flow {
                    side,
                    coordinate: bound,
                },
            )
        } else if speed > 0.0 {
            // An equilibrium just above zero can be closer to zero than the tolerance, so the solver can reach zero.
            stay(laws.coordinate_at(speed))
        } else {
            (spent, released(x + velocity * spent))
        };
        self.statistics.closure_m = self.statistics.closure_m.max(closure);
        Ok(next)
    }
}
