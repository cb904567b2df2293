//! A run: the same motion through the target and through the host's core, tick by tick.

use std::collections::VecDeque;

use dashpot_core::link::{Counters, Refusal, Request, Response};
use dashpot_core::{Damper, DamperState};

use super::host_replica::HostReplica;
use super::report::Measured;
use super::{Client, Event, Link, LinkError, Pace, Report, SessionError, Target, TickRecord};
use dashpot_realtime::pacing::Clock;

/// Attempts to bring a target back before the run stops.
const MOST_RECOVERIES: u32 = 10;

/// A target that said hello.
pub struct Session<L> {
    client: Client<L>,
    target: Target,
}

impl<L: Link> Session<L> {
    /// Says hello.
    ///
    /// # Errors
    /// No answer, or a target whose forces cannot be compared with this host's.
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

    /// The target.
    pub fn target(&self) -> &Target {
        &self.target
    }

    /// The link.
    pub fn link(&mut self) -> &mut L {
        self.client.link()
    }

    /// Drives every damper of the target with `motion` (m), one displacement a tick until it ends, damper i
    /// i ticks behind the first, as wheelsets run over the same track. `dampers` is one for all places or
    /// one for each; ticks are sent as `pace` has it. `sink` receives the record of every tick.
    ///
    /// # Errors
    /// Dampers that do not fit the target, `motion`'s, `sink`'s, or a target that is lost and does not
    /// come back.
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
        Ok(self.report(&host, measured, pace)?)
    }

    /// What was found up to here, the states of both sides compared.
    pub(super) fn report<C: Clock>(
        &mut self,
        host: &HostReplica,
        mut measured: Measured,
        pace: &Pace<C>,
    ) -> Result<Report, SessionError> {
        let state_mismatches = self.compare_states(host, &mut measured)?;
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

    /// One tick on both sides: compared, and its record handed to `sink`.
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
        let forces = self.insist(host, measured, |client| match client.request(&request)? {
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

    /// How often each event but `Late` happened so far.
    fn event_counts(&mut self, measured: &Measured) -> [(Event, u64); 9] {
        let made = self.client.link().faults_made();
        [
            (Event::Drop, made.dropped),
            (Event::Corrupt, made.corrupted),
            (Event::Delay, made.delayed),
            (Event::Duplicate, made.duplicated),
            (Event::Reorder, made.reordered),
            (Event::Reset, made.resets),
            (Event::Repeat, self.client.faults().repeated_requests),
            (Event::Recovery, measured.recoveries),
            (Event::Mismatch, measured.mismatches),
        ]
    }

    /// Asks until the target does it, bringing it back to the host's last state when it was lost.
    fn insist<R>(
        &mut self,
        host: &HostReplica,
        measured: &mut Measured,
        ask: impl Fn(&mut Client<L>) -> Result<R, LinkError>,
    ) -> Result<R, SessionError> {
        for _ in 0..MOST_RECOVERIES {
            match ask(&mut self.client) {
                // Another session may have been opened and have stepped: start over from our state.
                Err(LinkError::SessionLost | LinkError::Refused(Refusal::Tick(_))) => {}
                done => return done.map_err(|error| after(host.tick, error)),
            }
            self.recover(host, measured)?;
        }
        Err(SessionError::Lost {
            tick: host.tick,
            times: MOST_RECOVERIES,
            when: "in a row",
        })
    }

    /// Gives the target the host's dampers, states and tick.
    pub(super) fn recover(
        &mut self,
        host: &HostReplica,
        measured: &mut Measured,
    ) -> Result<(), SessionError> {
        measured.recoveries += 1;
        for _ in 0..MOST_RECOVERIES {
            match give(&mut self.client, &self.target, host) {
                Err(LinkError::SessionLost) => {}
                done => return done.map_err(|error| after(host.tick, error)),
            }
        }
        Err(SessionError::Lost {
            tick: host.tick,
            times: MOST_RECOVERIES,
            when: "while it was given its state again",
        })
    }

    fn compare_states(
        &mut self,
        host: &HostReplica,
        measured: &mut Measured,
    ) -> Result<usize, SessionError> {
        let saved = self.insist(host, measured, |client| {
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

    fn counters(&mut self) -> Result<Counters, SessionError> {
        let mut tries = 0;
        loop {
            match self.client.request(&Request::Counters) {
                Ok(Response::Counters(counters)) => return Ok(counters),
                Err(LinkError::SessionLost) if tries < MOST_RECOVERIES => {
                    tries += 1;
                    self.client.hello()?;
                }
                Ok(_) => return Err(LinkError::Unreadable.into()),
                Err(error) => return Err(error.into()),
            }
        }
    }
}

/// The reason a run stopped, with the last tick that both sides confirmed.
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

/// Hello, the dampers where they are others, the states.
fn give<L: Link>(
    client: &mut Client<L>,
    expected: &Target,
    host: &HostReplica,
) -> Result<(), LinkError> {
    let found = target(client)?;
    if (found.dampers, found.step_s) != (expected.dampers, expected.step_s) {
        return Err(LinkError::OtherTarget);
    }
    for ((place, damper), revision) in (0..).zip(&host.dampers).zip(&found.revisions) {
        if *revision != damper.revision() {
            let image = &damper.to_image();
            client.request(&Request::Load {
                damper: place,
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
