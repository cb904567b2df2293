//! A run: target and host step the same motion, tick by tick.

use std::collections::VecDeque;
use std::time::Instant;

use dashpot_core::link::{Counters, Refusal, Request, Response};
use dashpot_core::{Damper, DamperState};

use super::client::Patience;
use super::host_replica::HostReplica;
use super::report::Measured;
use super::{Client, Event, Link, LinkError, Pace, Report, SessionError, Target, TickRecord};
use dashpot_realtime::pacing::Clock;

/// Maximum number of attempts to recover a target before the run stops.
const MAX_RECOVERIES: u32 = 10;

/// An open session with a target.
pub struct Session<L> {
    client: Client<L>,
    target: Target,
}

impl<L: Link> Session<L> {
    /// Opens a session.
    ///
    /// # Errors
    /// The target does not answer, or its forces cannot be compared with those of this host.
    pub fn open(mut client: Client<L>) -> Result<Self, SessionError> {
        let target = target(&mut client)?;
        let version = env!("CARGO_PKG_VERSION");
        if target.core_version != version {
            return Err(SessionError::Version {
                target: target.core_version,
            });
        }
        Ok(Self { client, target })
    }

    /// Returns the target.
    pub fn target(&self) -> &Target {
        &self.target
    }

    /// Returns the link.
    pub fn link(&mut self) -> &mut L {
        self.client.link()
    }

    /// Drives all dampers of the target with `motion`, which returns one displacement (m) per tick, or `None` at its
    /// end. Damper i follows i ticks behind the first, like wheelsets on the same track. `dampers` contains one damper
    /// for all slots or one per slot. `pace` determines when ticks are sent, and `sink` receives the record of each
    /// tick.
    ///
    /// # Errors
    /// The dampers do not fit the target, `motion` or `sink` fails, or the target is lost and does not recover.
    pub fn run<C: Clock, E: From<SessionError>>(
        &mut self,
        dampers: &[Damper<f32>],
        mut motion: impl FnMut() -> Result<Option<f32>, E>,
        pace: &mut Pace<C>,
        mut sink: impl FnMut(&TickRecord<'_>) -> Result<(), E>,
    ) -> Result<Report, E> {
        let mut next = motion()?;
        let start = next.ok_or(SessionError::NoTick)?;
        let mut host = HostReplica::at_rest(dampers, &self.target, start)?;
        let mut displacements_m = VecDeque::from(vec![start; self.target.dampers]);
        let mut measured = Measured::default();
        self.recover(&host, &mut measured)?;
        measured.recoveries = 0;
        while let Some(displacement_m) = next {
            displacements_m.pop_back();
            displacements_m.push_front(displacement_m);
            let all = displacements_m.make_contiguous();
            self.tick(&mut host, all, pace, &mut measured, &mut sink)?;
            next = motion()?;
        }
        Ok(self.report(&host, &mut measured, pace)?)
    }

    /// Compares the states of target and host, and returns the report up to this tick.
    pub(super) fn report<C: Clock>(
        &mut self,
        host: &HostReplica,
        measured: &mut Measured,
        pace: &Pace<C>,
    ) -> Result<Report, SessionError> {
        let state_mismatches = self.compare_states(host, measured)?;
        let target_counters = self.counters()?;
        let clock_ticks = measured.cost();
        let per_tick = self.client.link().instructions_per_s();
        let per_tick = per_tick.map(|per_s| per_s / f64::from(self.target.clock_hz));
        Ok(Report {
            target: self.target.clone(),
            ticks: host.tick,
            mismatches: measured.mismatches,
            first_mismatch: measured.first_mismatch,
            state_mismatches,
            round_trip: measured.round_trip.figures(),
            pacing: pace.pacer().map(|pacer| pacer.report().into()),
            clock_ticks,
            instructions: per_tick.map(|per_tick| clock_ticks.times(per_tick)),
            recoveries: measured.recoveries,
            link_faults: self.client.faults(),
            target_counters,
        })
    }

    /// Steps target and host by one tick, compares them and passes the record to `sink`.
    pub(super) fn tick<C: Clock, E: From<SessionError>>(
        &mut self,
        host: &mut HostReplica,
        displacements_m: &[f32],
        pace: &mut Pace<C>,
        measured: &mut Measured,
        sink: &mut impl FnMut(&TickRecord<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let tick = host.tick.wrapping_add(1);
        let request = Request::Step {
            tick,
            displacements_m: displacements_m.iter().copied().collect(),
        };
        let before = self.event_counts(measured);
        let timing = pace.begin(u64::from(host.tick));
        let forces = self.retry(host, measured, |client| match client.request(&request)? {
            Response::Forces(forces) => Ok(forces),
            _ => Err(LinkError::Unreadable),
        })?;
        let finished = pace.end(timing);
        measured.round_trip.record_ns(finished.work_ns as f64);
        let all = displacements_m.len();
        if forces.tick != tick || forces.forces_n.len() != all || forces.status.len() != all {
            return Err(SessionError::from(LinkError::Unreadable).into());
        }
        measured.clock(&forces);
        host.step(displacements_m, &forces, measured);
        let after = self.event_counts(measured);
        let counted = before
            .iter()
            .zip(after)
            .filter(|((_, before), (_, after))| after > before);
        let late = (!finished.met_deadline).then_some(Event::Late);
        let events: Vec<Event> = counted.map(|(_, (event, _))| event).chain(late).collect();
        sink(&TickRecord {
            tick,
            displacements_m,
            target_forces_n: &forces.forces_n,
            host_forces_n: host.forces_n(),
            target_status: &forces.status,
            clock_ticks: forces.clock_ticks,
            round_trip_ns: finished.work_ns,
            events: &events,
        })
    }

    /// Returns how often each event except `Late` has happened so far.
    fn event_counts(&mut self, measured: &Measured) -> [(Event, u64); 9] {
        let injected = self.client.link().injected_faults();
        [
            (Event::Drop, injected.dropped),
            (Event::Corrupt, injected.corrupted),
            (Event::Delay, injected.delayed),
            (Event::Duplicate, injected.duplicated),
            (Event::Reorder, injected.reordered),
            (Event::Reset, injected.resets),
            (Event::Repeat, self.client.faults().repeated_requests),
            (Event::Recovery, measured.recoveries),
            (Event::Mismatch, measured.mismatches),
        ]
    }

    /// Ends the wait for the answers to steps at `end`, a time of the link; `None` leaves it to the retry limits.
    pub(super) fn wait_until(&mut self, end: Option<Instant>) {
        self.client
            .set_patience(end.map_or(Patience::Tries, Patience::Until));
    }

    /// Repeats a request until it succeeds. A lost target is first restored to the last state of the host.
    pub(super) fn retry<R>(
        &mut self,
        host: &HostReplica,
        measured: &mut Measured,
        request: impl Fn(&mut Client<L>) -> Result<R, LinkError>,
    ) -> Result<R, SessionError> {
        for _ in 0..MAX_RECOVERIES {
            match request(&mut self.client) {
                // Another program may have opened a session and stepped the target, so restore the state of the host.
                Err(LinkError::SessionLost | LinkError::Refused(Refusal::Tick(_))) => {}
                done => return done.map_err(|error| after(host.tick, error)),
            }
            self.recover(host, measured)?;
        }
        Err(SessionError::Lost {
            tick: host.tick,
            times: MAX_RECOVERIES,
            when: "in a row",
        })
    }

    /// Sends the dampers, states and tick of the host to the target. While steps may wait only until a given time, each
    /// request of the recovery waits once: the target has just answered.
    pub(super) fn recover(
        &mut self,
        host: &HostReplica,
        measured: &mut Measured,
    ) -> Result<(), SessionError> {
        let patience = self.client.patience();
        if patience != Patience::Tries {
            self.client.set_patience(Patience::FirstWait);
        }
        let recovered = self.restore(host, measured);
        self.client.set_patience(patience);
        recovered
    }

    fn restore(&mut self, host: &HostReplica, measured: &mut Measured) -> Result<(), SessionError> {
        measured.recoveries += 1;
        for _ in 0..MAX_RECOVERIES {
            match restore(&mut self.client, &self.target, host) {
                Err(LinkError::SessionLost) => {}
                done => return done.map_err(|error| after(host.tick, error)),
            }
        }
        Err(SessionError::Lost {
            tick: host.tick,
            times: MAX_RECOVERIES,
            when: "while its state was restored",
        })
    }

    fn compare_states(
        &mut self,
        host: &HostReplica,
        measured: &mut Measured,
    ) -> Result<usize, SessionError> {
        let saved = self.retry(host, measured, |client| {
            match client.request(&Request::Save)? {
                Response::Saved { states, .. } => Ok(states.to_vec()),
                _ => Err(LinkError::Unreadable),
            }
        })?;
        let expected = host.saved();
        let size = DamperState::<f32>::BYTES;
        let pairs = saved.chunks(size).zip(expected.chunks(size));
        let differing = pairs.filter(|(target, host)| target != host).count();
        let missing = saved.len().abs_diff(expected.len()).div_ceil(size);
        Ok(differing + missing)
    }

    pub(super) fn counters(&mut self) -> Result<Counters, SessionError> {
        let mut tries = 0;
        loop {
            match self.client.request(&Request::Counters) {
                Ok(Response::Counters(counters)) => return Ok(counters),
                Err(LinkError::SessionLost) if tries < MAX_RECOVERIES => {
                    tries += 1;
                    self.client.hello()?;
                }
                Ok(_) => return Err(LinkError::Unreadable.into()),
                Err(error) => return Err(error.into()),
            }
        }
    }
}

/// Adds the last tick that both sides confirmed to the error that ended a run.
fn after(tick: u32, source: LinkError) -> SessionError {
    SessionError::After { tick, source }
}

fn target<L: Link>(client: &mut Client<L>) -> Result<Target, LinkError> {
    let welcome = client.hello()?;
    Ok(Target {
        core_version: welcome.core_version.into(),
        dampers: welcome.revisions.len(),
        revisions: welcome.revisions.to_vec(),
        step_s: welcome.step_s,
        clock_hz: welcome.clock_hz,
    })
}

/// Opens a new session, and sends the changed dampers and all states.
fn restore<L: Link>(
    client: &mut Client<L>,
    expected: &Target,
    host: &HostReplica,
) -> Result<(), LinkError> {
    let found = target(client)?;
    if (found.dampers, found.step_s) != (expected.dampers, expected.step_s) {
        return Err(LinkError::OtherTarget);
    }
    for ((slot, damper), revision) in (0..).zip(&host.dampers).zip(&found.revisions) {
        if *revision != damper.revision() {
            let image = &damper.to_image();
            client.request(&Request::Load {
                damper: slot,
                image,
            })?;
        }
    }
    let states = host.saved();
    let tick = host.tick;
    client.request(&Request::Restore {
        tick,
        states: &states,
    })?;
    Ok(())
}
