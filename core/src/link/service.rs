//! Carries requests out on the loaded dampers.

use super::loaded::Loaded;
use super::loading::Loading;
use super::message::{
    Counters, MOST_DAMPERS, MOST_SAMPLES, PROTOCOL, Parameter, Refusal, Request, Response, Sample,
    Scalar, Welcome,
};
use super::safe_output::Watch;
use crate::damper::Damper;
use crate::state::DamperState;
use crate::telemetry::{self, Telemetry};

/// Samples kept for a link to read.
const RECORDED: usize = 64;

/// A free-running clock to measure steps with.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// Its count, upwards, wrapping.
    pub now: fn() -> u32,
    /// Its rate (Hz).
    pub hz: u32,
}

/// Dampers, and everything a request can ask of them.
#[derive(Clone, Debug)]
pub(crate) struct Service<const N: usize> {
    loaded: Loaded<N>,
    loading: Loading,
    watch: Watch<N>,
    running: bool,
    outputs_n: [f32; N],
    clock: Clock,
    clock_ticks: u32,
    telemetry: Telemetry<RECORDED>,
    recorded: u8,
    saved: [u8; MOST_DAMPERS * DamperState::<f32>::BYTES],
    pub(crate) counters: Counters,
}

impl<const N: usize> Service<N> {
    pub(crate) fn new(dampers: &[&Damper<f32>; N], clock: Clock) -> Self {
        const { assert!(N > 0 && N <= MOST_DAMPERS, "1 to MOST_DAMPERS dampers") };
        Self {
            loaded: Loaded::new(dampers),
            loading: Loading::new(),
            watch: Watch::new(),
            running: false,
            outputs_n: [0.0; N],
            clock,
            clock_ticks: 0,
            telemetry: Telemetry::new(),
            recorded: 0,
            saved: [0; MOST_DAMPERS * DamperState::<f32>::BYTES],
            counters: Counters::default(),
        }
    }

    pub(crate) fn outputs_n(&self) -> &[f32; N] {
        &self.outputs_n
    }

    pub(crate) fn step_s(&self) -> f32 {
        self.loaded.step_s()
    }

    /// The free-running ticks that are due; nothing while the host steps.
    pub(crate) fn tick(&mut self, due: u32) {
        if !self.running {
            return;
        }
        let overruns = &mut self.counters.overruns;
        *overruns = overruns.saturating_add(due.saturating_sub(1));
        for _ in 0..due {
            self.step();
            let (outputs_n, lost) = self.watch.output(self.loaded.forces_n());
            self.outputs_n = outputs_n;
            if lost {
                count(&mut self.counters.link_losses);
            }
        }
    }

    fn step(&mut self) {
        let start = (self.clock.now)();
        self.loaded.step();
        self.clock_ticks = (self.clock.now)().wrapping_sub(start);
        if let Some(state) = self.loaded.state(self.recorded) {
            self.telemetry.record(telemetry::Sample {
                tick: self.loaded.tick(),
                displacement_m: state.displacement(),
                force_n: state.force(),
                status: state.status(),
            });
        }
    }

    /// Carries out a request or says why not; then nothing has changed.
    pub(crate) fn execute(&mut self, request: &Request<'_>) -> Result<Response<'_>, Refusal> {
        match request {
            Request::Hello { protocol } if *protocol == PROTOCOL => {
                return Ok(Response::Welcome(self.welcome()));
            }
            Request::Hello { .. } => return Err(Refusal::Protocol(PROTOCOL)),
            Request::BeginLoad { damper, bytes } => {
                self.loaded.has(*damper)?;
                self.loading.begin(*damper, *bytes)?;
            }
            Request::Chunk { offset, bytes } => self.loading.chunk(*offset, bytes)?,
            Request::CommitLoad => {
                let (place, damper) = self.loading.commit(self.loaded.step_s())?;
                self.loaded.replace(place, damper)?;
            }
            Request::Set {
                damper,
                parameter,
                value,
            } => {
                self.loaded.has(*damper)?;
                if *parameter != Parameter::ClearanceM {
                    return Err(Refusal::NeedsRebuild);
                }
                self.loaded.set_clearance(*damper, *value)?;
            }
            Request::LossOfLink(configuration) => {
                if configuration.after_ticks == 0 {
                    return Err(Refusal::Range);
                }
                self.link_good()?;
                self.watch.configure(*configuration);
            }
            Request::Reset { displacements_m } => {
                self.stepped()?;
                self.loaded.reset(displacements_m)?;
                self.outputs_n = [0.0; N];
            }
            Request::Step {
                tick,
                displacements_m,
            } => {
                self.stepped()?;
                let expected = self.loaded.tick().wrapping_add(1);
                if *tick != expected {
                    return Err(Refusal::Tick(expected));
                }
                self.loaded.displace(displacements_m)?;
                self.step();
                // The answer alone has them: outputs are driven while the tick runs free.
                let forces = self.loaded.forces(self.loaded.forces_n(), self.clock_ticks);
                return Ok(Response::Forces(forces));
            }
            Request::Run { displacements_m } => {
                if self.running && !self.watch.lost() {
                    return Err(Refusal::Running);
                }
                self.loaded.reset(displacements_m)?;
                self.outputs_n = [0.0; N];
                self.watch.alive();
                self.running = true;
                return Ok(self.forces());
            }
            Request::Displace { displacements_m } => {
                if !self.running {
                    return Err(Refusal::NotRunning);
                }
                self.link_good()?;
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
                self.watch.alive();
            }
            Request::Save => {
                return Ok(Response::Saved {
                    tick: self.loaded.tick(),
                    states: self.loaded.save(&mut self.saved),
                });
            }
            Request::Restore { tick, states } => {
                self.stepped()?;
                self.loaded.restore(*tick, states)?;
            }
            Request::Telemetry { damper } => return self.telemetry(*damper),
            Request::Counters => return Ok(Response::Counters(self.counters)),
        }
        Ok(Response::Done)
    }

    fn welcome(&self) -> Welcome<'static> {
        Welcome {
            protocol: PROTOCOL,
            core_version: env!("CARGO_PKG_VERSION"),
            dampers: N as u8,
            bank_revision: self.loaded.revision(),
            scalar: Scalar::F32,
            step_s: self.loaded.step_s(),
            image_bytes: Damper::<f32>::IMAGE_BYTES as u32,
            tick: self.loaded.tick(),
            clock_hz: self.clock.hz,
            running: self.running,
        }
    }

    fn forces(&self) -> Response<'static> {
        Response::Forces(self.loaded.forces(&self.outputs_n, self.clock_ticks))
    }

    fn telemetry(&mut self, damper: u8) -> Result<Response<'static>, Refusal> {
        self.loaded.has(damper)?;
        if damper != self.recorded {
            self.recorded = damper;
            self.telemetry = Telemetry::new();
        }
        let ring = &mut self.telemetry;
        let samples = core::iter::from_fn(|| ring.take()).take(MOST_SAMPLES);
        let samples = samples
            .map(|sample| Sample {
                tick: sample.tick,
                displacement_m: sample.displacement_m,
                force_n: sample.force_n,
                status: sample.status.bits(),
            })
            .collect();
        Ok(Response::Telemetry {
            overwritten: ring.overwritten(),
            samples,
        })
    }

    /// Only while the host steps.
    fn stepped(&self) -> Result<(), Refusal> {
        if self.running {
            Err(Refusal::Running)
        } else {
            Ok(())
        }
    }

    fn link_good(&self) -> Result<(), Refusal> {
        if self.watch.lost() {
            Err(Refusal::LinkLost)
        } else {
            Ok(())
        }
    }
}

/// Counts one more.
pub(crate) fn count(counter: &mut u32) {
    *counter = counter.saturating_add(1);
}
