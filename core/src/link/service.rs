//! Carries out requests on the loaded dampers.

use super::guard::Guard;
use super::limits::{MAX_DAMPERS, PROTOCOL};
use super::lists::Reals;
use super::load::Progress;
use super::loaded::{Loaded, SavedStates, StepSizeError};
use super::message::{Counters, Parameter, Request, Response, Scalar, Welcome};
use super::recorder::Recorder;
use super::refusal::Refusal;
use super::safe_output::{LossOfLink, Watch};
use super::watched::Watched;
use crate::damper::Damper;
use crate::state::DamperState;

/// A free-running clock that measures the duration of steps.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    now: fn() -> u32,
    hz: u32,
}

impl Clock {
    /// A clock whose count `now` rises at a rate (Hz) and wraps.
    pub const fn new(now: fn() -> u32, hz: u32) -> Self {
        Self { now, hz }
    }
}

/// The dampers and everything else that requests read or change.
#[derive(Debug)]
pub(crate) struct Service<const N: usize, const WATCHED: usize> {
    loaded: Loaded<N>,
    guard: Guard<N>,
    watch: Watch<N>,
    running: bool,
    outputs_n: [f32; N],
    clock: Option<Clock>,
    clock_ticks: u32,
    recorder: Recorder<N>,
    saved: SavedStates,
    pub(crate) watched: Watched<WATCHED>,
    pub(crate) counters: Counters,
}

impl<const N: usize, const WATCHED: usize> Service<N, WATCHED> {
    /// A service without dampers: all bits are zero.
    pub(crate) const fn new() -> Self {
        const { assert!(N > 0 && N <= MAX_DAMPERS, "1 to MAX_DAMPERS dampers") };
        const { assert!(WATCHED <= N, "at most as many watched dampers as dampers") };
        Self {
            loaded: Loaded::new(),
            guard: Guard::new(),
            watch: Watch::new(),
            running: false,
            outputs_n: [0.0; N],
            clock: None,
            clock_ticks: 0,
            recorder: Recorder::new(),
            saved: [0; MAX_DAMPERS * DamperState::<f32>::BYTES],
            watched: Watched::new(),
            counters: Counters::NONE,
        }
    }

    pub(crate) fn start(
        &mut self,
        dampers: &[&Damper<f32>; N],
        clock: Clock,
    ) -> Result<(), StepSizeError> {
        self.loaded.start(dampers)?;
        self.watch.configure(LossOfLink::default());
        self.clock = Some(clock);
        Ok(())
    }

    pub(crate) fn outputs_n(&self) -> &[f32; N] {
        &self.outputs_n
    }

    pub(crate) fn loaded(&self) -> &Loaded<N> {
        &self.loaded
    }

    /// Runs the free-running ticks that are due. Does nothing while the host steps.
    pub(crate) fn tick(&mut self, due: u32) {
        if !self.running {
            return;
        }
        let overruns = &mut self.counters.overruns;
        *overruns = overruns.saturating_add(due.saturating_sub(1));
        for _ in 0..due {
            self.step();
            let damaged = self.guard.damaged().is_some();
            let (outputs_n, lost) = self.watch.output(self.loaded.forces_n(), damaged);
            self.outputs_n = outputs_n;
            if lost {
                count(&mut self.counters.link_losses);
            }
        }
    }

    fn step(&mut self) {
        let now = |clock: Option<Clock>| clock.map_or(0, |clock| (clock.now)());
        let start = now(self.clock);
        self.loaded.step();
        self.clock_ticks = now(self.clock).wrapping_sub(start);
        let found = self.guard.check(&mut self.loaded);
        if found > 0 {
            self.guard.replace_damaged(self.watch.last_good_mut());
        }
        self.counters.corruptions = self.counters.corruptions.saturating_add(found);
        self.recorder
            .record(self.loaded.tick(), self.loaded.states());
    }

    /// Counts a request in sequence as accepted or refused.
    pub(crate) fn count_done(&mut self, carried_out: bool) {
        let counters = &mut self.counters;
        count(if carried_out {
            &mut counters.accepted
        } else {
            &mut counters.refused
        });
    }

    /// Loads a slice of an image. Returns true once the damper or the health model is in use.
    pub(crate) fn load_slice(
        &mut self,
        damper: u8,
        image: &[u8],
        progress: &mut Progress,
    ) -> Result<bool, Refusal> {
        let loading = match progress {
            Progress::Damper(loading) => loading,
            Progress::Health(loading) => {
                let step_s = self.loaded.step_s();
                return self.watched.load_slice(damper, image, loading, step_s);
            }
        };
        let done = self.loaded.spare().load_slice(image, loading);
        let done = done.map_err(Refusal::Image)?;
        if done {
            self.loaded.replace(damper)?;
            self.guard.loaded(damper);
        }
        Ok(done)
    }

    /// Carries out a request. A refused request changes nothing.
    pub(crate) fn execute(&mut self, request: &Request<'_>) -> Result<Response<'_>, Refusal> {
        match request {
            Request::Hello { protocol } if *protocol == PROTOCOL => {
                return Ok(Response::Welcome(self.welcome()));
            }
            Request::Hello { .. } => return Err(Refusal::Protocol(PROTOCOL)),
            // `load_slice` then loads the image.
            Request::Load { damper, .. } => self.loaded.require_damper(*damper)?,
            Request::Set {
                damper,
                parameter,
                value,
            } => {
                self.loaded.require_damper(*damper)?;
                if *parameter != Parameter::ClearanceM {
                    return Err(Refusal::NeedsRebuild);
                }
                self.loaded.set_clearance(*damper, *value)?;
            }
            Request::LossOfLink(configuration) => {
                if configuration.after_ticks == 0 {
                    return Err(Refusal::Range);
                }
                self.require_outputs_good()?;
                self.watch.configure(*configuration);
            }
            Request::Reset { displacements_m } => {
                self.require_host_steps()?;
                self.put_at_rest(displacements_m)?;
            }
            Request::Step {
                tick,
                displacements_m,
            } => {
                self.require_host_steps()?;
                let expected = self.loaded.tick().wrapping_add(1);
                if *tick != expected {
                    return Err(Refusal::Tick(expected));
                }
                self.loaded.displace(displacements_m)?;
                self.step();
                // The outputs are driven only while the device is free-running, so these forces are not outputs.
                let forces = self.loaded.forces(self.loaded.forces_n(), self.clock_ticks);
                return Ok(Response::Forces(forces));
            }
            Request::Run { displacements_m } => {
                if self.running && self.require_outputs_good().is_ok() {
                    return Err(Refusal::Running);
                }
                if let Some(damper) = self.guard.damaged_constants() {
                    return Err(Refusal::Corrupted(damper));
                }
                self.put_at_rest(displacements_m)?;
                self.watch.restart();
                self.running = true;
                return Ok(self.forces());
            }
            Request::Displace { displacements_m } => {
                if !self.running {
                    return Err(Refusal::NotRunning);
                }
                self.require_outputs_good()?;
                self.loaded.displace(displacements_m)?;
                self.watch.alive();
                return Ok(self.forces());
            }
            Request::Stop => {
                if !self.running {
                    return Err(Refusal::NotRunning);
                }
                self.running = false;
                self.outputs_n = [0.0; N];
                self.watch.restart();
            }
            Request::Save => {
                return Ok(Response::Saved {
                    tick: self.loaded.tick(),
                    states: self.loaded.save(&mut self.saved),
                });
            }
            Request::Restore { tick, states } => {
                self.require_host_steps()?;
                self.loaded.restore(*tick, states)?;
                self.guard.new_states();
            }
            Request::Telemetry { damper } => return self.recorder.take(*damper),
            Request::Counters => return Ok(Response::Counters(self.counters)),
            Request::Outputs => {
                let outputs_n = self.outputs_n.iter().copied().collect();
                return Ok(Response::Outputs { outputs_n });
            }
            Request::Status => return Ok(self.loaded.status()),
            Request::ClearStatus => {
                let cleared = self.loaded.status();
                self.loaded.clear_status();
                return Ok(cleared);
            }
            // `load_slice` then loads the image.
            Request::LoadHealth { damper, .. } => {
                self.loaded.require_damper(*damper)?;
                self.watched.require_slot(*damper)?;
            }
            Request::Measure { damper, samples } => {
                self.loaded.require_damper(*damper)?;
                self.watched.samples(*damper, samples)?;
            }
            Request::Health { damper } => {
                self.loaded.require_damper(*damper)?;
                return self.watched.reading(*damper).map(Response::Health);
            }
            Request::ClearHealth { damper } => {
                self.loaded.require_damper(*damper)?;
                let cleared = self.watched.reading(*damper)?;
                self.watched.clear_status(*damper)?;
                return Ok(Response::Health(cleared));
            }
        }
        Ok(Response::Done)
    }

    fn welcome(&self) -> Welcome<'static> {
        Welcome {
            protocol: PROTOCOL,
            core_version: env!("CARGO_PKG_VERSION"),
            revisions: self.loaded.revisions(),
            scalar: Scalar::F32,
            step_s: self.loaded.step_s(),
            image_bytes: Damper::<f32>::IMAGE_BYTES as u32,
            tick: self.loaded.tick(),
            clock_hz: self.clock.map_or(0, |clock| clock.hz),
            running: self.running,
        }
    }

    fn forces(&self) -> Response<'static> {
        Response::Forces(self.loaded.forces(&self.outputs_n, self.clock_ticks))
    }

    /// Puts every damper at rest and sets the outputs to 0.
    fn put_at_rest(&mut self, displacements_m: &Reals) -> Result<(), Refusal> {
        self.loaded.reset(displacements_m)?;
        self.guard.new_states();
        self.outputs_n = [0.0; N];
        Ok(())
    }

    /// Refuses a request while the device is free-running.
    fn require_host_steps(&self) -> Result<(), Refusal> {
        if self.running {
            Err(Refusal::Running)
        } else {
            Ok(())
        }
    }

    /// Refuses a request while the safe outputs are active.
    fn require_outputs_good(&self) -> Result<(), Refusal> {
        match self.guard.damaged() {
            _ if self.watch.lost() => Err(Refusal::LinkLost),
            Some(damper) => Err(Refusal::Corrupted(damper)),
            None => Ok(()),
        }
    }
}

/// Increments a counter, saturating.
pub(crate) fn count(counter: &mut u32) {
    *counter = counter.saturating_add(1);
}
