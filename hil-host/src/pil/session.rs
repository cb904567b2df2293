//! A run: the same motion through the target and through the host's core, tick by tick.

use std::collections::VecDeque;
use std::time::Instant;

use dashpot_core::link::{Counters, Forces, Refusal, Request, Response, Scalar};
use dashpot_core::{Damper, DamperState};
use serde::Serialize;

use super::{Client, Link, LinkError, LinkFaults};
use crate::failure::{Failure, Outcome};
use crate::timing::{Distribution, Figures};

/// Attempts to bring a target back before the run stops.
const MOST_RECOVERIES: u32 = 10;

/// What a target said of itself.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Target {
    /// Version of its core.
    pub core_version: String,
    /// Dampers it holds.
    pub dampers: usize,
    /// Revision of each.
    pub revisions: Vec<u32>,
    /// Step of every damper (s).
    pub step_s: f32,
    /// Rate of the clock that measures its steps (Hz).
    pub clock_hz: u32,
}

/// Clock ticks or instructions of one tick of the bank.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Cost {
    /// Least.
    pub min: f64,
    /// Mean.
    pub mean: f64,
    /// Most.
    pub max: f64,
}

/// A force or status that is not the host's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mismatch {
    /// Tick, from 1.
    pub tick: u32,
    /// Damper, from 0.
    pub damper: usize,
    /// Force of the target (N).
    pub target_force_n: f32,
    /// Force of the host (N).
    pub host_force_n: f32,
    /// Status bits of the target.
    pub target_status: u16,
    /// Status bits of the host.
    pub host_status: u16,
}

/// What a run found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The target.
    pub target: Target,
    /// Ticks stepped.
    pub ticks: u32,
    /// Forces and status words that differ from the host's, in bits.
    pub mismatches: u64,
    /// The first of them.
    pub first_mismatch: Option<Mismatch>,
    /// Dampers whose state at the end differs from the host's, in bits.
    pub state_mismatches: usize,
    /// From a step request to its answer, repetitions included.
    pub round_trip: Figures,
    /// Clock ticks of the target that a step of the whole bank takes.
    pub clock_ticks: Cost,
    /// The same in instructions, where the link counts them.
    pub instructions: Option<Cost>,
    /// Times the target was given its dampers and states again.
    pub recoveries: u64,
    /// Faults the host noticed.
    pub link_faults: LinkFaults,
    /// The target's own counters, since it was last reset.
    pub target_counters: Counters,
}

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
    pub fn open(mut client: Client<L>) -> Outcome<Self> {
        let mut tries = 0;
        let target = loop {
            match target(&mut client) {
                Ok(target) => break target,
                Err(LinkError::SessionLost) if tries < MOST_RECOVERIES => tries += 1,
                Err(error) => return Err(error.into()),
            }
        };
        let version = env!("CARGO_PKG_VERSION");
        if target.core_version != version {
            return Err(Failure::new(format!(
                "the target runs dashpot-core {}, this host {version}; bits are the same only \
                 between the same versions",
                target.core_version
            )));
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
    /// i ticks behind the first, as wheelsets run over the same track. Every damper is `damper`.
    /// `progress` is told the ticks done.
    ///
    /// # Errors
    /// `motion`'s, or a target that is lost and does not come back.
    pub fn run(
        &mut self,
        damper: &Damper<f32>,
        mut motion: impl FnMut() -> Outcome<Option<f32>>,
        mut progress: impl FnMut(u32),
    ) -> Outcome<Report> {
        if damper.step_s() != self.target.step_s {
            return Err(Failure::new(format!(
                "the damper is built for {} s, the target steps {} s",
                damper.step_s(),
                self.target.step_s
            )));
        }
        let dampers = self.target.dampers;
        let mut next = motion()?;
        let start = next.ok_or_else(|| Failure::new("the motion has no tick"))?;
        let mut displacements_m = VecDeque::from(vec![start; dampers]);
        let mut host = Mirror {
            damper,
            tick: 0,
            states: vec![damper.at_rest(start); dampers],
        };
        let mut measured = Measured::default();
        self.recover(&host, &mut measured)?;
        measured.recoveries = 0;
        while let Some(displacement_m) = next {
            displacements_m.pop_back();
            displacements_m.push_front(displacement_m);
            self.tick(&mut host, displacements_m.make_contiguous(), &mut measured)?;
            progress(host.tick);
            next = motion()?;
        }
        let state_mismatches = self.compare_states(&host, &mut measured)?;
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
            clock_ticks,
            instructions: per_tick.map(|per_tick| clock_ticks.times(per_tick)),
            recoveries: measured.recoveries,
            link_faults: self.client.faults(),
            target_counters,
        })
    }

    /// One tick on both sides, compared.
    fn tick(
        &mut self,
        host: &mut Mirror<'_>,
        displacements_m: &[f32],
        measured: &mut Measured,
    ) -> Outcome<()> {
        let tick = host.tick.wrapping_add(1);
        let request = Request::Step {
            tick,
            displacements_m: displacements_m.iter().copied().collect(),
        };
        let begin = Instant::now();
        let forces = self.insist(host, measured, |client| match client.request(&request)? {
            Response::Forces(forces) => Ok(forces),
            _ => Err(LinkError::Unreadable),
        })?;
        measured
            .round_trip
            .record_ns(begin.elapsed().as_nanos() as f64);
        let all = displacements_m.len();
        if forces.tick != tick || forces.forces_n.len() != all || forces.status.len() != all {
            return Err(LinkError::Unreadable.into());
        }
        measured.clock(&forces);
        host.step(displacements_m, &forces, measured);
        Ok(())
    }

    /// Asks until the target does it, bringing it back to the host's last state when it was lost.
    fn insist<R>(
        &mut self,
        host: &Mirror<'_>,
        measured: &mut Measured,
        ask: impl Fn(&mut Client<L>) -> Result<R, LinkError>,
    ) -> Outcome<R> {
        for _ in 0..MOST_RECOVERIES {
            match ask(&mut self.client) {
                // Another session may have been opened and have stepped: start over from our state.
                Err(LinkError::SessionLost | LinkError::Refused(Refusal::Tick(_))) => {}
                done => return done.map_err(|error| after(host.tick, error)),
            }
            self.recover(host, measured)?;
        }
        Err(Failure::new(format!(
            "after tick {}: the target was lost {MOST_RECOVERIES} times in a row",
            host.tick
        )))
    }

    /// Gives the target the host's dampers, states and tick.
    fn recover(&mut self, host: &Mirror<'_>, measured: &mut Measured) -> Outcome<()> {
        measured.recoveries += 1;
        for _ in 0..MOST_RECOVERIES {
            match give(&mut self.client, &self.target, host) {
                Err(LinkError::SessionLost) => {}
                done => return done.map_err(|error| after(host.tick, error)),
            }
        }
        Err(Failure::new(format!(
            "after tick {}: the target was lost {MOST_RECOVERIES} times while it was given its \
             state again",
            host.tick
        )))
    }

    fn compare_states(&mut self, host: &Mirror<'_>, measured: &mut Measured) -> Outcome<usize> {
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

    fn counters(&mut self) -> Outcome<Counters> {
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

/// The same dampers on the host, at the last tick that both sides confirmed.
struct Mirror<'a> {
    damper: &'a Damper<f32>,
    tick: u32,
    states: Vec<DamperState<f32>>,
}

impl Mirror<'_> {
    fn saved(&self) -> Vec<u8> {
        self.states.iter().flat_map(|s| s.to_bytes()).collect()
    }

    /// The tick of `forces` on this side, compared with them.
    fn step(&mut self, displacements_m: &[f32], forces: &Forces, measured: &mut Measured) {
        self.tick = forces.tick;
        let places = self.states.iter_mut().zip(displacements_m);
        let target = forces.forces_n.iter().zip(&forces.status);
        for (place, ((state, x), (target_force_n, target_status))) in places.zip(target).enumerate()
        {
            let host_force_n = self.damper.step(state, *x);
            let host_status = state.status().bits();
            if host_force_n.to_bits() != target_force_n.to_bits() || host_status != *target_status {
                measured.mismatches += 1;
                measured.first_mismatch.get_or_insert(Mismatch {
                    tick: self.tick,
                    damper: place,
                    target_force_n: *target_force_n,
                    host_force_n,
                    target_status: *target_status,
                    host_status,
                });
            }
        }
    }
}

#[derive(Default)]
struct Measured {
    mismatches: u64,
    first_mismatch: Option<Mismatch>,
    round_trip: Distribution,
    clock_ticks: u64,
    clock_range: Option<(u32, u32)>,
    steps: u64,
    recoveries: u64,
}

impl Measured {
    fn clock(&mut self, forces: &Forces) {
        let taken = forces.clock_ticks;
        self.steps += 1;
        self.clock_ticks += u64::from(taken);
        let (least, most) = self.clock_range.unwrap_or((taken, taken));
        self.clock_range = Some((least.min(taken), most.max(taken)));
    }

    fn cost(&self) -> Cost {
        let (least, most) = self.clock_range.unwrap_or_default();
        Cost {
            min: f64::from(least),
            mean: self.clock_ticks as f64 / self.steps.max(1) as f64,
            max: f64::from(most),
        }
    }
}

impl Cost {
    fn times(self, factor: f64) -> Self {
        Self {
            min: self.min * factor,
            mean: self.mean * factor,
            max: self.max * factor,
        }
    }
}

/// The reason a run stopped, with the last tick that both sides confirmed.
fn after(tick: u32, error: LinkError) -> Failure {
    Failure::new(format!("after tick {tick}: {error}"))
}

fn target<L: Link>(client: &mut Client<L>) -> Result<Target, LinkError> {
    let welcome = client.hello()?;
    if welcome.scalar != Scalar::F32 {
        return Err(LinkError::Broken(Failure::new(
            "the target steps in f64; this host compares f32",
        )));
    }
    if welcome.image_bytes as usize != Damper::<f32>::IMAGE_BYTES {
        return Err(LinkError::Unreadable);
    }
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
    host: &Mirror<'_>,
) -> Result<(), LinkError> {
    let found = target(client)?;
    if (found.dampers, found.step_s) != (expected.dampers, expected.step_s) {
        return Err(LinkError::Broken(Failure::new(
            "another target answers than at the start",
        )));
    }
    let image = host.damper.to_image();
    for (damper, revision) in (0..).zip(&found.revisions) {
        if *revision != host.damper.revision() {
            let image = &image;
            client.request(&Request::Load { damper, image })?;
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
