//! A bank of dampers that returns its forces at each tick, for example to a simulated vehicle.

use dashpot_core::Damper;

use super::host_replica::HostReplica;
use super::report::Measured;
use super::{Link, Pace, Report, Session, SessionError};

/// Dampers of a target, stepped tick by tick. The host steps a replica, so that a target can continue after a reset.
pub struct Bank<L> {
    session: Session<L>,
    host: HostReplica,
    pace: Pace,
    measured: Measured,
    displacements_m: Vec<f32>,
    forces_n: Vec<f32>,
}

impl<L: Link> Bank<L> {
    /// Loads `dampers` into the first slots of the target, at rest at displacement zero. The remaining slots get the
    /// first damper and stay at rest.
    ///
    /// # Errors
    /// There is no damper, there are more dampers than slots, a damper is built for a different step than the target,
    /// or the target is lost.
    pub fn start(mut session: Session<L>, dampers: &[Damper<f32>]) -> Result<Self, SessionError> {
        let slots = session.target().dampers;
        let count = dampers.len();
        let (Some(first), true) = (dampers.first(), count <= slots) else {
            return Err(SessionError::TooManyDampers {
                dampers: count,
                slots,
            });
        };
        let mut all = dampers.to_vec();
        all.resize(slots, *first);
        let host = HostReplica::at_rest(&all, session.target(), 0.0)?;
        let mut measured = Measured::default();
        session.recover(&host, &mut measured)?;
        measured.recoveries = 0;
        Ok(Self {
            session,
            host,
            pace: Pace::default(),
            measured,
            displacements_m: vec![0.0; slots],
            forces_n: vec![0.0; slots],
        })
    }

    /// Steps the target by one tick: sends the displacements (m) of its first slots and returns the forces (N) of all
    /// slots.
    ///
    /// # Errors
    /// The target is lost and does not recover, or a force is not finite.
    pub fn step(&mut self, displacements_m: &[f32]) -> Result<&[f32], SessionError> {
        for (slot, displacement_m) in self.displacements_m.iter_mut().zip(displacements_m) {
            *slot = *displacement_m;
        }
        let forces_n = &mut self.forces_n;
        self.session.tick(
            &mut self.host,
            &self.displacements_m,
            &mut self.pace,
            &mut self.measured,
            &mut |record| {
                forces_n.copy_from_slice(record.target_forces_n);
                let invalid = forces_n.iter().find(|force_n| !force_n.is_finite());
                invalid.map_or(Ok(()), |force_n| {
                    Err(SessionError::Force {
                        tick: record.tick,
                        force_n: *force_n,
                    })
                })
            },
        )?;
        Ok(&self.forces_n)
    }

    /// Compares the states of target and host, and returns the report.
    ///
    /// # Errors
    /// The target is lost and does not recover.
    pub fn finish(mut self) -> Result<Report, SessionError> {
        self.session.report(&self.host, self.measured, &self.pace)
    }
}
