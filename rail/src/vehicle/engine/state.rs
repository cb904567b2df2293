//! The state of a running vehicle.

use dashpot_core::DamperState;

use super::block::{N, Vector};
use super::extremes::{Extremes, LastLoads};
use super::guidance::Guidance;
use super::identity::Identity;
use super::rail_equations::RailEquations;
use super::structure::Blocks;
use crate::contact::{Status, WheelsetForces};
use crate::vehicle::error::VehicleError;

/// The state of a running vehicle: plain data.
///
/// A clone saves it, [`Clone::clone_from`] restores it without allocation, and stepping the same state again gives the
/// same bits. A state belongs to the vehicle that created it; no other vehicle steps it ([`Stop::OtherVehicle`]).
///
/// Bodies are in the order of the parameters, followed by the wheelsets. Coordinates are in the order of
/// [`COORDINATES`](crate::vehicle::COORDINATES).
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VehicleState {
    /// Identity of the vehicle that the state belongs to.
    pub(super) identity: Identity,
    /// Number of bodies and wheelsets. Elastically supported rails follow them in all lists.
    pub(super) bodies: usize,
    pub(super) ticks: u64,
    pub(super) distance_m: f64,
    pub(super) speed_m_per_s: f64,
    pub(super) coordinates: Vec<Vector>,
    pub(super) velocities: Vec<Vector>,
    /// Accelerations of the integration method.
    pub(super) accelerations: Vec<Vector>,
    /// Accelerations one step earlier.
    pub(super) last_accelerations: Vec<Vector>,
    /// Total force on each body in excess of the forces at standstill, N and N m.
    pub(super) forces: Vec<Vector>,
    pub(super) inertia: Vec<Vector>,
    pub(super) pose: Vec<Vector>,
    pub(super) contacts: Vec<WheelsetForces>,
    /// Wheel loads of each wheelset in the last two steps.
    pub(super) last_loads: Vec<LastLoads>,
    /// Padded to whole banks with copies of the last damper.
    pub(super) dampers: Vec<DamperState<f64>>,
    pub(super) damper_displacements_m: Vec<f64>,
    pub(super) damper_velocities_m_per_s: Vec<f64>,
    pub(super) damper_forces_n: Vec<f64>,
    pub(super) outside_forces_n: Vec<Option<f64>>,
    pub(super) stop_forces_n: Vec<f64>,
    pub(super) friction_factor: f64,
    /// Applied force and moment on each body, N and N m.
    pub(super) applied: Vec<Vector>,
    pub(super) friction_forces_n: Vec<f64>,
    /// Position of the slider of each friction element, m.
    pub(super) sliders_m: Vec<f64>,
    pub(super) is_diverged: bool,
    /// True once the state was passed to the step of a vehicle that it does not belong to.
    pub(super) met_other_vehicle: bool,
    pub(super) work: Work,
}

/// Reason why a state is no longer stepped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stop {
    /// A value has exceeded its bounds or is not a number.
    Diverged,
    /// A vehicle to which the state does not belong was asked to step it.
    OtherVehicle,
}

/// Working memory of a step.
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Work {
    pub guidance: Guidance,
    /// Equations of the step, then their factors.
    pub system: Blocks,
    /// The same for elastically supported rails.
    pub rails: Vec<RailEquations>,
    pub residual: Vec<Vector>,
    /// Coordinates relative to the frame at the middle of the vehicle.
    pub in_middle: Vec<Vector>,
    /// Rates of `in_middle`.
    pub rates_in_middle: Vec<Vector>,
    /// Forces of dampers, stops and friction on each body at the start of the tick.
    pub tick_forces: Vec<Vector>,
    /// Change of `tick_forces` during the tick.
    pub tick_changes: Vec<Vector>,
    /// Damper forces at the end of the tick.
    pub target_damper_forces_n: Vec<f64>,
    /// Stop forces at the end of the tick.
    pub target_stop_forces_n: Vec<f64>,
    /// Friction forces at the end of the tick.
    pub target_friction_forces_n: Vec<f64>,
    /// Extremes of each wheelset over all steps of the tick.
    pub extremes: Vec<Extremes>,
}

impl VehicleState {
    /// Returns the number of ticks since the start.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Returns the distance of the middle of the vehicle along the track, m.
    pub fn distance_m(&self) -> f64 {
        self.distance_m
    }

    /// Returns the speed along the track, m/s.
    pub fn speed_m_per_s(&self) -> f64 {
        self.speed_m_per_s
    }

    /// Returns the displacement of each body from its equilibrium on straight track, relative to the track under it, m
    /// and rad. The pitch of a wheelset is always zero.
    pub fn coordinates(&self) -> &[[f64; N]] {
        &self.coordinates[..self.bodies]
    }

    /// Returns the displacements of elastically supported rails under each wheelset, relative to those at standstill,
    /// m: lateral and vertical of the left rail, lateral and vertical of the right rail, and zero.
    pub fn rail_coordinates(&self) -> &[[f64; N]] {
        &self.coordinates[self.bodies..]
    }

    /// Returns the absolute velocity of each body in the same axes, m/s and rad/s; in a curve the yaw rate includes
    /// that of the curve. The pitch rate of a wheelset is the amount by which its rotation falls short of free rolling
    /// in the middle of the track.
    pub fn velocities(&self) -> &[[f64; N]] {
        &self.velocities[..self.bodies]
    }

    /// Returns the acceleration that an accelerometer on a body would measure, in the axes of the track, m/s^2 and
    /// rad/s^2. It is the force divided by the inertia and does not include
    /// [`track_acceleration`](Self::track_acceleration).
    ///
    /// # Panics
    /// If the index of the body is out of range.
    pub fn acceleration(&self, body: usize) -> [f64; N] {
        let guidance = &self.work.guidance.acceleration[body];
        std::array::from_fn(|i| self.forces[body][i] / self.inertia[body][i] - guidance[i])
    }

    /// Returns gravity and centrifugal acceleration of a body in excess of those on straight level track, in the axes
    /// of the track, m/s^2. For a body at rest in these axes it is minus [`acceleration`](Self::acceleration).
    ///
    /// # Panics
    /// If the index of the body is out of range.
    pub fn track_acceleration(&self, body: usize) -> [f64; N] {
        self.work.guidance.acceleration[body]
    }

    /// Returns the forces of the rails on each wheelset.
    pub fn contacts(&self) -> &[WheelsetForces] {
        &self.contacts
    }

    /// Returns the extremes of each wheelset during the last tick.
    ///
    /// A tick consists of several steps, so an impact may be over before the tick ends. [`contacts`](Self::contacts)
    /// returns only the forces at the end of the tick. A greatest load is that of the parabola through the loads of
    /// three steps; it counts for the tick in which the third step lies.
    pub fn extremes(&self) -> &[Extremes] {
        &self.work.extremes
    }

    /// Returns the displacement of each damper, positive in extension, m.
    pub fn damper_displacements_m(&self) -> &[f64] {
        &self.damper_displacements_m
    }

    /// Returns the mean velocity of each damper during the last tick, positive in extension, m/s.
    pub fn damper_velocities_m_per_s(&self) -> &[f64] {
        &self.damper_velocities_m_per_s
    }

    /// Returns the force of each damper, positive if it resists extension, N.
    pub fn damper_forces_n(&self) -> &[f64] {
        &self.damper_forces_n
    }

    /// Returns the force of each stop, positive if it resists a positive displacement of its second end, N.
    pub fn stop_forces_n(&self) -> &[f64] {
        &self.stop_forces_n
    }

    /// Returns the force of each friction element, positive if it resists a positive displacement of its second end, N.
    pub fn friction_forces_n(&self) -> &[f64] {
        &self.friction_forces_n
    }

    /// Returns the position of the slider of each friction element, m: the displacement at which the element exerts no
    /// force. It does not change at all while the slider sticks.
    pub fn sliders_m(&self) -> &[f64] {
        &self.sliders_m
    }

    /// Replaces the force of a damper with an external force from the next tick on; `None` returns to the damper's own
    /// model.
    ///
    /// An external force computed from the displacement of this tick therefore acts one tick late.
    ///
    /// # Errors
    /// An index out of range or a force that is not finite. The state is then unchanged.
    pub fn set_outside_force_n(
        &mut self,
        damper: usize,
        force_n: Option<f64>,
    ) -> Result<(), VehicleError> {
        let dampers = self.outside_forces_n.len();
        let Some(outside) = self.outside_forces_n.get_mut(damper) else {
            return Err(VehicleError::NoSuchDamper { damper, dampers });
        };
        if let Some(force_n) = force_n.filter(|force_n| !force_n.is_finite()) {
            return Err(VehicleError::OutsideForce { damper, force_n });
        }
        *outside = force_n;
        Ok(())
    }

    /// Returns the external force of a damper, N; `None` if its own model gives the force or there is no such damper.
    pub fn outside_force_n(&self, damper: usize) -> Option<f64> {
        self.outside_forces_n.get(damper).copied().flatten()
    }

    /// Returns the worst status of all wheels.
    pub fn status(&self) -> Status {
        let statuses = self.contacts.iter().map(|contact| contact.status);
        statuses.max().unwrap_or_default()
    }

    /// Returns why the state is no longer stepped, or `None` if it still is. A stopped state stays stopped.
    pub fn stop(&self) -> Option<Stop> {
        if self.met_other_vehicle {
            Some(Stop::OtherVehicle)
        } else {
            self.is_diverged.then_some(Stop::Diverged)
        }
    }

    /// Returns true if the state is no longer stepped; [`stop`](Self::stop) gives the reason.
    pub fn is_diverged(&self) -> bool {
        self.stop().is_some()
    }
}
