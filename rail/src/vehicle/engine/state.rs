//! What changes from one step of a vehicle to the next.

use dashpot_core::DamperState;

use super::block::{N, Vector};
use super::guidance::Guidance;
use super::identity::Identity;
use super::structure::Blocks;
use crate::contact::{Status, WheelsetForces};
use crate::vehicle::error::VehicleError;

/// Number of bodies of a state, and all of its lengths.
pub(super) type Shape = [usize; 30];

/// The state of a running vehicle: plain data. A clone saves it, [`Clone::clone_from`] restores it without allocation, and a step from
/// the same state gives the same bits. It belongs to the vehicle that made it: another one does not step it ([`Stop::OtherVehicle`]).
///
/// Bodies come in the order of the parameters, wheelsets after them; coordinates in that of
/// [`COORDINATES`](crate::vehicle::COORDINATES).
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct VehicleState {
    /// The vehicle that it belongs to.
    pub(super) identity: Identity,
    /// Bodies and wheelsets; rails that give way follow them.
    pub(super) bodies: usize,
    pub(super) ticks: u64,
    pub(super) distance_m: f64,
    pub(super) speed_m_per_s: f64,
    pub(super) coordinates: Vec<Vector>,
    pub(super) velocities: Vec<Vector>,
    /// As the method carries them on, those of the step before beside.
    pub(super) accelerations: Vec<Vector>,
    pub(super) last_accelerations: Vec<Vector>,
    /// All that acts on each body, N and N m, beyond what balances its weight at standstill.
    pub(super) forces: Vec<Vector>,
    pub(super) inertia: Vec<Vector>,
    pub(super) pose: Vec<Vector>,
    pub(super) contacts: Vec<WheelsetForces>,
    /// In whole banks: the last damper also in the places left over.
    pub(super) dampers: Vec<DamperState<f64>>,
    pub(super) damper_displacements_m: Vec<f64>,
    pub(super) damper_forces_n: Vec<f64>,
    pub(super) outside_forces_n: Vec<Option<f64>>,
    pub(super) stop_forces_n: Vec<f64>,
    pub(super) is_diverged: bool,
    /// Another vehicle was asked to step it.
    pub(super) met_other_vehicle: bool,
    pub(super) work: Work,
}

/// Why a state is stepped no further.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Stop {
    /// A number has grown beyond all bounds, or is none.
    Diverged,
    /// A vehicle that it does not belong to was asked to step it.
    OtherVehicle,
}

/// What a step writes over.
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Work {
    pub guidance: Guidance,
    pub system: Blocks,
    pub residual: Vec<Vector>,
    pub in_middle: Vec<Vector>,
    pub rates_in_middle: Vec<Vector>,
    /// Of dampers and stops at the start of the tick, and their change until its end.
    pub tick_forces: Vec<Vector>,
    pub tick_changes: Vec<Vector>,
    pub target_damper_forces_n: Vec<f64>,
    pub target_stop_forces_n: Vec<f64>,
    /// Of each wheel, left and right, over all steps inside the tick.
    pub greatest_loads_n: Vec<[f64; 2]>,
}

impl VehicleState {
    /// Ticks since the start.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// Distance of the middle of the vehicle along the track, m.
    pub fn distance_m(&self) -> f64 {
        self.distance_m
    }

    /// Speed along the track, m/s.
    pub fn speed_m_per_s(&self) -> f64 {
        self.speed_m_per_s
    }

    /// Displacement of each body from where it stands on straight track, relative to the track under it, m and rad; the pitch of a
    /// wheelset is not kept.
    pub fn coordinates(&self) -> &[[f64; N]] {
        &self.coordinates[..self.bodies]
    }

    /// Displacements of the rails under each wheelset where they give way, beyond those under the standing vehicle: lateral and vertical of
    /// the left one, then of the right one, m; the fifth number is zero.
    pub fn rail_coordinates(&self) -> &[[f64; N]] {
        &self.coordinates[self.bodies..]
    }

    /// Velocity of each body over ground in the same axes, m/s and rad/s: in a curve its yaw rate is that of the curve. The pitch rate
    /// of a wheelset is what its rotation lacks of rolling freely in the middle of the track.
    pub fn velocities(&self) -> &[[f64; N]] {
        &self.velocities[..self.bodies]
    }

    /// Acceleration of a body in the track's axes, m/s^2 and rad/s^2: forces over inertia, without the centripetal one and the weight's
    /// part along the cant, as an accelerometer on it has them.
    ///
    /// # Panics
    /// As a slice does, if the vehicle has no such body.
    pub fn acceleration(&self, body: usize) -> [f64; N] {
        let guidance = &self.work.guidance.acceleration[body];
        std::array::from_fn(|i| self.forces[body][i] / self.inertia[body][i] - guidance[i])
    }

    /// What [`acceleration`](Self::acceleration) of a body at rest in the track's axes would be, with the opposite sign: the weight's part
    /// along the cant and the centripetal acceleration, m/s^2.
    ///
    /// # Panics
    /// As a slice does, if the vehicle has no such body.
    pub fn track_acceleration(&self, body: usize) -> [f64; N] {
        self.work.guidance.acceleration[body]
    }

    /// Forces of the rails on each wheelset.
    pub fn contacts(&self) -> &[WheelsetForces] {
        &self.contacts
    }

    /// Greatest load of the left and the right wheel of each wheelset during the last tick, N. A tick has several steps inside, and an impact
    /// may be over before the tick ends: [`contacts`](Self::contacts) has the forces at its end only.
    pub fn greatest_wheel_loads_n(&self) -> &[[f64; 2]] {
        &self.work.greatest_loads_n
    }

    /// Displacement of each damper, extension positive, m.
    pub fn damper_displacements_m(&self) -> &[f64] {
        &self.damper_displacements_m
    }

    /// Force of each damper, positive where it resists extension, N.
    pub fn damper_forces_n(&self) -> &[f64] {
        &self.damper_forces_n
    }

    /// Force of each stop, positive where it resists a displacement of its second end along the axis, N.
    pub fn stop_forces_n(&self) -> &[f64] {
        &self.stop_forces_n
    }

    /// Takes the force of a damper from outside from the next tick on, where a number is given, and from its own model again where none
    /// is. A force that is answered to the displacement of this tick comes one tick late.
    ///
    /// # Errors
    /// A damper that the vehicle does not have, a force that is not finite; then nothing changes.
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

    /// The number of bodies, and all lengths: one that was read may have any.
    pub(super) fn shape(&self) -> Shape {
        let (work, guidance, system) = (&self.work, &self.work.guidance, &self.work.system);
        [
            self.bodies,
            self.coordinates.len(),
            self.velocities.len(),
            self.accelerations.len(),
            self.last_accelerations.len(),
            self.forces.len(),
            self.inertia.len(),
            self.pose.len(),
            self.contacts.len(),
            self.dampers.len(),
            self.damper_displacements_m.len(),
            self.damper_forces_n.len(),
            self.outside_forces_n.len(),
            self.stop_forces_n.len(),
            guidance.pose.len(),
            guidance.pose_rate.len(),
            guidance.relative.len(),
            guidance.relative_rate.len(),
            guidance.acceleration.len(),
            system.diagonal.len(),
            system.couplings.len(),
            system.carried.len(),
            work.residual.len(),
            work.in_middle.len(),
            work.rates_in_middle.len(),
            work.tick_forces.len(),
            work.tick_changes.len(),
            work.target_damper_forces_n.len(),
            work.target_stop_forces_n.len(),
            work.greatest_loads_n.len(),
        ]
    }

    /// The worst status of all wheels.
    pub fn status(&self) -> Status {
        let statuses = self.contacts.iter().map(|contact| contact.status);
        statuses.max().unwrap_or_default()
    }

    /// Why the state is stepped no further, if it is not; it stays so.
    pub fn stop(&self) -> Option<Stop> {
        if self.met_other_vehicle {
            Some(Stop::OtherVehicle)
        } else {
            self.is_diverged.then_some(Stop::Diverged)
        }
    }

    /// Whether the state is stepped no further; [`stop`](Self::stop) says why.
    pub fn is_diverged(&self) -> bool {
        self.stop().is_some()
    }
}

/// [`Clone`] field by field: the one that is derived allocates in [`Clone::clone_from`].
macro_rules! clone_by_field {
    ($type:ident { $($field:ident),* $(,)? }) => {
        impl Clone for $type {
            fn clone(&self) -> Self {
                Self { $($field: self.$field.clone()),* }
            }

            fn clone_from(&mut self, source: &Self) {
                let Self { $($field),* } = source;
                $(self.$field.clone_from($field);)*
            }
        }
    };
}

clone_by_field!(VehicleState {
    identity,
    bodies,
    ticks,
    distance_m,
    speed_m_per_s,
    coordinates,
    velocities,
    accelerations,
    last_accelerations,
    forces,
    inertia,
    pose,
    contacts,
    dampers,
    damper_displacements_m,
    damper_forces_n,
    outside_forces_n,
    stop_forces_n,
    is_diverged,
    met_other_vehicle,
    work,
});
clone_by_field!(Work {
    guidance,
    system,
    residual,
    in_middle,
    rates_in_middle,
    tick_forces,
    tick_changes,
    target_damper_forces_n,
    target_stop_forces_n,
    greatest_loads_n,
});
clone_by_field!(Guidance {
    pose,
    pose_rate,
    relative,
    relative_rate,
    acceleration,
});
clone_by_field!(Blocks {
    diagonal,
    couplings,
    carried,
});
