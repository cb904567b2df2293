//! A bank of dampers that returns its forces at each tick, for example to a simulated vehicle.

use std::time::Duration;

use dashpot_core::Damper;
use dashpot_core::link::{Counters, Request};
use dashpot_realtime::pacing::Pacer;

use super::host_replica::HostReplica;
use super::report::Measured;
use super::{
    Hold, Link, LinkError, MissingAnswers, Pace, Report, Session, SessionError, TickRecord,
};

/// Longest wait for the answer to a step.
const MAX_WAIT: Duration = Duration::from_secs(3600);

/// Dampers of a target, stepped tick by tick. The host steps a replica, so that a target can continue after a reset.
pub struct Bank<L> {
    session: Session<L>,
    host: HostReplica,
    pace: Pace,
    measured: Measured,
    displacements_m: Vec<f32>,
    forces_n: Vec<f32>,
    missing: MissingAnswers,
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
            missing: MissingAnswers::default(),
        })
    }

    /// Lets [`Self::step`] wait until each tick is due.
    #[must_use]
    pub fn paced(mut self, pacer: Pacer) -> Self {
        self.pace = Pace::Paced(Box::new(pacer));
        self
    }

    /// Steps the target by one tick: sends the displacements (m) of its first slots and returns the forces (N) of all
    /// slots.
    ///
    /// # Errors
    /// The target is lost and does not recover, or a force is not finite.
    pub fn step(&mut self, displacements_m: &[f32]) -> Result<&[f32], SessionError> {
        self.step_recorded(displacements_m, |_| {})
    }

    /// Like [`Self::step`], and passes the record of the tick to `sink`.
    ///
    /// # Errors
    /// Same errors as [`Self::step`].
    pub fn step_recorded(
        &mut self,
        displacements_m: &[f32],
        mut sink: impl FnMut(&TickRecord<'_>),
    ) -> Result<&[f32], SessionError> {
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
                let found_n = record.target_forces_n;
                if let Some(invalid_n) = found_n.iter().find(|force_n| !force_n.is_finite()) {
                    return Err(SessionError::Force {
                        tick: record.tick,
                        force_n: *invalid_n,
                    });
                }
                forces_n.copy_from_slice(found_n);
                sink(record);
                Ok(())
            },
        )?;
        self.missing.answered();
        Ok(&self.forces_n)
    }

    /// Puts another damper into a slot of the target and of the replica. Its force continues where the other's was.
    ///
    /// # Errors
    /// There is no such slot, the damper is built for another step than the target, or the target is lost and does not
    /// recover.
    ///
    /// ```
    /// use dashpot_core::Damper;
    /// use dashpot_core::parameters::{DamperParameters, Mount};
    /// use dashpot_host_link::{Bank, Client, Desk, RetryLimits, Session};
    ///
    /// let [stiff, soft] = [8e6, 2e6].map(|stiffness| {
    ///     DamperParameters::reduced(120e3, 0.03, Mount::new(stiffness)).build::<f32>(1e-3)
    /// });
    /// let (stiff, soft) = (stiff?, soft?);
    /// let client = Client::new(Desk::new([stiff; 3])?, RetryLimits::default(), 7);
    /// let mut bank = Bank::start(Session::open(client)?, &[stiff])?;
    /// let before_n = bank.step(&[1e-4])?[0];
    /// bank.replace(0, soft)?;
    /// let after_n = bank.step(&[1e-4])?[0];
    /// assert!((after_n - before_n).abs() < 0.3 * before_n, "{before_n} {after_n}");
    /// assert_eq!(bank.finish()?.mismatches, 0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn replace(&mut self, slot: usize, damper: Damper<f32>) -> Result<(), SessionError> {
        let slots = self.host.dampers.len();
        let (Some(place), Ok(number)) = (self.host.dampers.get_mut(slot), u8::try_from(slot))
        else {
            return Err(SessionError::TooManyDampers {
                dampers: slot.saturating_add(1),
                slots,
            });
        };
        if damper.step_s() != place.step_s() {
            return Err(SessionError::Step {
                damper_s: damper.step_s(),
                target_s: place.step_s(),
            });
        }
        *place = damper;
        let image = damper.to_image();
        let load = Request::Load {
            damper: number,
            image: &image,
        };
        self.order(&load)
    }

    /// Clears status bits and rejected inputs of all dampers, on the target and in the replica.
    ///
    /// # Errors
    /// The target is lost and does not recover.
    pub fn clear_status(&mut self) -> Result<(), SessionError> {
        self.order(&Request::ClearStatus)?;
        self.host.clear_status();
        Ok(())
    }

    /// Counters of the target since power-on.
    ///
    /// # Errors
    /// The target is lost and does not recover.
    pub fn counters(&mut self) -> Result<Counters, SessionError> {
        self.session.counters()
    }

    /// Sends a request that has no figures in its answer.
    fn order(&mut self, request: &Request<'_>) -> Result<(), SessionError> {
        let (session, host, measured) = (&mut self.session, &self.host, &mut self.measured);
        session.retry(host, measured, |client| client.request(request).map(drop))
    }

    /// Like [`Self::step`], but in real time: returns the last forces if the answer does not come in time, and steps
    /// the replica alone. The forces are 0 before the first answer. `time_left` is the time until the deadline of this
    /// tick.
    ///
    /// The tick waits for [`Hold::answer_wait`] if the last step was answered, and for `time_left` otherwise. A target
    /// that answers again, even after a reset, continues with the state of the replica. To restore it may take longer
    /// than a tick.
    ///
    /// # Errors
    /// More answers in a row are missing than `hold` allows, the link is broken, the target is lost and does not
    /// recover, or a force is not finite.
    ///
    /// ```
    /// use std::time::Duration;
    /// use dashpot_core::Damper;
    /// use dashpot_core::parameters::{DamperParameters, Mount};
    /// use dashpot_host_link::{Bank, Client, Desk, Hold, RetryLimits, Session};
    ///
    /// let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
    /// let damper: Damper<f32> = parameters.build(1e-3)?;
    /// let client = Client::new(Desk::new([damper; 3])?, RetryLimits::default(), 7);
    /// let mut bank = Bank::start(Session::open(client)?, &[damper])?;
    /// let (step, hold) = (Duration::from_millis(1), Hold::new(Duration::from_millis(1), 100));
    /// let force_n = bank.step_or_hold(&[1e-4], step, &hold)?[0];
    /// assert_eq!(force_n, damper.step(&mut damper.at_rest(0.0), 1e-4));
    /// assert_eq!(bank.missing_answers().missing_answers, 0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn step_or_hold(
        &mut self,
        displacements_m: &[f32],
        time_left: Duration,
        hold: &Hold,
    ) -> Result<&[f32], SessionError> {
        let wait = match self.missing.in_a_row {
            0 => hold.answer_wait,
            _ => time_left,
        };
        let end = self.session.link().now() + wait.min(MAX_WAIT);
        self.session.wait_until(Some(end));
        let stepped = self.step(displacements_m).map(drop);
        self.session.wait_until(None);
        match stepped {
            Err(SessionError::After {
                source: LinkError::Silent { .. },
                ..
            }) => {
                self.host.step_alone(&self.displacements_m);
                self.missing.missed(self.host.tick, hold)?;
            }
            done => done?,
        }
        Ok(&self.forces_n)
    }

    /// Forces of the last answer of all slots (N); 0 before the first one.
    pub fn forces_n(&self) -> &[f32] {
        &self.forces_n
    }

    /// Answers that did not come in time.
    pub fn missing_answers(&self) -> MissingAnswers {
        self.missing
    }

    /// Compares the states of target and host, and returns the report.
    ///
    /// # Errors
    /// The target is lost and does not recover.
    pub fn finish(&mut self) -> Result<Report, SessionError> {
        if self.missing.in_a_row > 0 {
            // The target may not have made the last steps.
            self.session.recover(&self.host, &mut self.measured)?;
        }
        self.session
            .report(&self.host, &mut self.measured, &self.pace)
    }
}
