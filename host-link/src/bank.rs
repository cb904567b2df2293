//! A bank whose forces are needed as they come, such as those of dampers outside a simulated vehicle.

use dashpot_core::Damper;

use super::host_replica::HostReplica;
use super::report::Measured;
use super::{Link, Pace, Report, Session, SessionError};

/// The dampers of a target, a tick at a time; the host's own beside them, so that a target that was reset goes on where it was.
pub struct Bank<L> {
    session: Session<L>,
    host: HostReplica,
    pace: Pace,
    measured: Measured,
    displacements_m: Vec<f32>,
    forces_n: Vec<f32>,
}

impl<L: Link> Bank<L> {
    /// Gives the first places of the target `dampers` at rest at displacement zero. The places left over have the first damper and stay
    /// at rest.
    ///
    /// # Errors
    /// No damper or more than places, dampers built for another step than the target's, or a target that is lost.
    pub fn start(mut session: Session<L>, dampers: &[Damper<f32>]) -> Result<Self, SessionError> {
        let places = session.target().dampers;
        let count = dampers.len();
        let (Some(first), true) = (dampers.first(), count <= places) else {
            return Err(SessionError::Places {
                dampers: count,
                places,
            });
        };
        let mut all = dampers.to_vec();
        all.resize(places, *first);
        let host = HostReplica::at_rest(&all, session.target(), 0.0)?;
        let mut measured = Measured::default();
        session.recover(&host, &mut measured)?;
        measured.recoveries = 0;
        Ok(Self {
            session,
            host,
            pace: Pace::default(),
            measured,
            displacements_m: vec![0.0; places],
            forces_n: vec![0.0; places],
        })
    }

    /// One tick of the target: `displacements_m` of its first places (m) to their forces (N).
    ///
    /// # Errors
    /// A target that is lost and does not come back, or a force that is not finite.
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
                let wrong = forces_n.iter().find(|force_n| !force_n.is_finite());
                wrong.map_or(Ok(()), |force_n| {
                    Err(SessionError::Force {
                        tick: record.tick,
                        force_n: *force_n,
                    })
                })
            },
        )?;
        Ok(&self.forces_n)
    }

    /// What was found, the states of both sides compared.
    ///
    /// # Errors
    /// A target that is lost and does not come back.
    pub fn finish(mut self) -> Result<Report, SessionError> {
        self.session.report(&self.host, self.measured, &self.pace)
    }
}
