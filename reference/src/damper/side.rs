//! One direction of the chain: force, piston velocity and stretch of the springs while the damper is in contact with
//! the seat of that direction.

use dashpot_core::parameters::{DamperParameters, Element, Hydraulics, Mount, Reduced};

use super::bracket::increasing_root;
use super::oil::ColumnSpring;
use super::passage::Passage;
use super::paths::Areas;
use crate::error::ReferenceError;

/// Velocity law, and the coordinate in which it is smooth.
#[derive(Clone, Debug)]
enum Law {
    /// `F = C v`; coordinate `F` (N).
    Reduced { damping: f64 },
    /// `F = F_closed + A s^2`, `v = v(P)`; the coordinate `s` (Pa^1/2) removes the square roots.
    Hydraulic {
        passage: Passage,
        /// Working area (m^2).
        area: f64,
        /// Working pressure up to which the piston does not move (Pa).
        closed: f64,
    },
}

/// One direction of the element with its springs. Force, stretch and velocity are positive in the working direction.
#[derive(Clone, Debug)]
pub(crate) struct Side {
    law: Law,
    /// Seal friction (N).
    friction: f64,
    /// Mount springs in series (N/m).
    stiffness: f64,
    column: Option<ColumnSpring>,
    /// Force up to which the piston does not move (N).
    pub(crate) closed_force: f64,
    /// Stretch at the closed force (m).
    pub(crate) closed_stretch: f64,
    /// Force at which the damper yields (N).
    pub(crate) yield_force: f64,
    /// Coordinate at the yield force.
    pub(crate) yield_coordinate: f64,
    /// Piston velocity through the valves at the yield force (m/s).
    pub(crate) yield_velocity: f64,
    /// Coordinates at which a valve opens.
    pub(crate) kinks: Vec<f64>,
}

impl Side {
    /// Extension and compression side of a damper.
    pub(crate) fn both(parameters: &DamperParameters) -> Result<[Self; 2], ReferenceError> {
        let limit = parameters.limits.force_n;
        let stiffness = series_stiffness(&parameters.mount);
        match &parameters.element {
            Element::Reduced(reduced) => {
                let side = Self::reduced(reduced, stiffness, limit)?;
                Ok([side.clone(), side])
            }
            Element::Physical(hydraulics) => {
                let areas = Areas::new(hydraulics);
                Ok([
                    Self::hydraulic(
                        hydraulics,
                        Passage::extension(hydraulics, &areas),
                        areas.extension,
                        |column| column.rod_side_volume_m3,
                        (stiffness, limit),
                    )?,
                    Self::hydraulic(
                        hydraulics,
                        Passage::compression(hydraulics, &areas),
                        areas.compression,
                        |column| column.piston_side_volume_m3,
                        (stiffness, limit),
                    )?,
                ])
            }
            _ => Err(ReferenceError::Element),
        }
    }

    fn reduced(reduced: &Reduced, stiffness: f64, limit: f64) -> Result<Self, ReferenceError> {
        let damping = reduced.damping_n_s_per_m;
        Self {
            law: Law::Reduced { damping },
            friction: 0.0,
            stiffness,
            column: None,
            closed_force: 0.0,
            closed_stretch: 0.0,
            yield_force: limit.min(damping * reduced.saturation_velocity_m_per_s),
            yield_coordinate: 0.0,
            yield_velocity: 0.0,
            kinks: Vec::new(),
        }
        .completed()
    }

    fn hydraulic(
        hydraulics: &Hydraulics,
        passage: Passage,
        area: f64,
        volume: impl Fn(&dashpot_core::parameters::OilColumn) -> f64,
        (stiffness, limit): (f64, f64),
    ) -> Result<Self, ReferenceError> {
        let closed = passage.closed_up_to();
        let friction = hydraulics.seal.map_or(0.0, |seal| seal.friction_n);
        let kinks = passage
            .kinks((limit - friction).max(0.0) / area)
            .into_iter()
            .filter(|pressure| *pressure > closed)
            .map(|pressure| (pressure - closed).sqrt())
            .collect();
        Self {
            law: Law::Hydraulic {
                passage,
                area,
                closed,
            },
            friction,
            stiffness,
            column: hydraulics
                .oil
                .column
                .map(|column| ColumnSpring::new(column, volume(&column), area)),
            closed_force: friction + area * closed,
            closed_stretch: 0.0,
            yield_force: limit,
            yield_coordinate: 0.0,
            yield_velocity: 0.0,
            kinks,
        }
        .completed()
    }

    /// Fills in the values that follow from the laws.
    fn completed(mut self) -> Result<Self, ReferenceError> {
        let sound = self.stiffness > 0.0 && self.yield_force > self.closed_force;
        if !(sound && self.yield_force.is_finite()) {
            return Err(ReferenceError::ForceLimit {
                force_limit_n: self.yield_force,
                closed_force_n: self.closed_force,
                stiffness_n_per_m: self.stiffness,
            });
        }
        self.closed_stretch = self.stretch(self.closed_force);
        self.yield_coordinate = self.coordinate(self.yield_force);
        self.yield_velocity = self.velocity(self.yield_coordinate);
        self.kinks.retain(|kink| *kink < self.yield_coordinate);
        self.kinks.sort_by(f64::total_cmp);
        self.kinks.dedup();
        if self.yield_velocity.is_finite() && self.yield_velocity > 0.0 {
            Ok(self)
        } else {
            Err(ReferenceError::NoFlow {
                velocity_m_per_s: self.yield_velocity,
                force_limit_n: self.yield_force,
            })
        }
    }

    /// Force (N) at a coordinate.
    pub(crate) fn force(&self, y: f64) -> f64 {
        match &self.law {
            Law::Reduced { .. } => y,
            Law::Hydraulic { area, .. } => self.closed_force + area * y * y,
        }
    }

    /// Coordinate of a force not below the closed force.
    pub(crate) fn coordinate(&self, force: f64) -> f64 {
        match &self.law {
            Law::Reduced { .. } => force,
            Law::Hydraulic { area, .. } => ((force - self.closed_force).max(0.0) / area).sqrt(),
        }
    }

    /// Piston velocity (m/s) at a coordinate; an odd function, so it is smooth even for trial stages below 0.
    pub(crate) fn velocity(&self, y: f64) -> f64 {
        match &self.law {
            Law::Reduced { damping } => y / damping,
            Law::Hydraulic {
                passage, closed, ..
            } => passage.velocity(*closed, y * y).copysign(y),
        }
    }

    /// Stretch of mount springs and oil column (m) under a force.
    pub(crate) fn stretch(&self, force: f64) -> f64 {
        force / self.stiffness
            + self
                .column
                .as_ref()
                .map_or(0.0, |column| column.shortening(self.pressure(force)))
    }

    /// Working pressure `(F - F_c)+/A` (Pa).
    fn pressure(&self, force: f64) -> f64 {
        match &self.law {
            Law::Reduced { .. } => 0.0,
            Law::Hydraulic { area, .. } => (force - self.friction).max(0.0) / area,
        }
    }

    /// Force (N) while the piston is at rest, at a stretch (m) between 0 and `closed_stretch`.
    pub(crate) fn held_force(&self, stretch: f64) -> f64 {
        if stretch <= 0.0 {
            0.0
        } else if stretch >= self.closed_stretch {
            self.closed_force
        } else {
            increasing_root(0.0, self.closed_force, |force| {
                self.stretch(force) - stretch
            })
        }
    }

    /// Coordinate at which the piston moves at `velocity` (m/s), limited to the yield coordinate.
    pub(crate) fn coordinate_at(&self, velocity: f64) -> f64 {
        increasing_root(0.0, self.yield_coordinate, |y| self.velocity(y) - velocity)
    }

    /// Coordinate at which the springs are stretched by `stretch` (m), limited to the yield coordinate.
    pub(crate) fn coordinate_stretched(&self, stretch: f64) -> f64 {
        increasing_root(0.0, self.yield_coordinate, |y| {
            self.stretch(self.force(y)) - stretch
        })
    }

    /// Derivatives of the coordinate, the time and the piston position with respect to the clock of [`super::segment`].
    ///
    /// The seats separate at `speed` (m/s); `knee` is the coordinate of the equilibrium at `speed`. The stretch `delta`
    /// of the springs follows `d delta/dt = speed - v`. As `d delta/ds` vanishes with `s`, the clock
    /// `dt/d tau = s/sqrt(s^2 + knee^2)` cancels this zero, and `s` passes 0 at a finite rate.
    pub(crate) fn rates(&self, y: f64, speed: f64, knee: f64) -> [f64; 3] {
        match &self.law {
            Law::Reduced { .. } => {
                let velocity = self.velocity(y);
                [self.stiffness * (speed - velocity), 1.0, velocity]
            }
            Law::Hydraulic { area, closed, .. } => {
                let compliance = area / self.stiffness
                    + self
                        .column
                        .as_ref()
                        .map_or(0.0, |column| column.compliance(closed + y * y));
                if speed == 0.0 {
                    // At 0, v/s is replaced by its limit, which is evaluated close to 0.
                    let magnitude = y.abs().max(1e-100);
                    let slope = self.velocity(magnitude) / magnitude;
                    [-slope / (2.0 * compliance), 1.0, self.velocity(y)]
                } else {
                    let length = y.hypot(knee);
                    let velocity = self.velocity(y);
                    let clock = y / length;
                    [
                        (speed - velocity) / (2.0 * compliance * length),
                        clock,
                        velocity * clock,
                    ]
                }
            }
        }
    }
}

/// Stiffness of rubber and seat in series (N/m).
fn series_stiffness(mount: &Mount) -> f64 {
    mount
        .seat_stiffness_n_per_m
        .map_or(mount.stiffness_n_per_m, |seat| {
            1.0 / (1.0 / mount.stiffness_n_per_m + 1.0 / seat)
        })
}
