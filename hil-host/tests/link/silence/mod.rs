//! Targets that fall silent during a run, on a simulated clock and as the command sees them.

mod bank;
mod command;
mod vehicle;

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use dashpot_core::link::{FrameReader, Header, REQUEST_BYTES, Request};
use dashpot_host_link::{Desk, Link, LinkError};
use dashpot_realtime::pacing::Clock;

use crate::pil_common::desk;

/// Clock of the simulated links and of the pacer. It advances by sleeping, waiting and explicit steps.
#[derive(Clone, Default)]
struct SimulatedClock(Arc<AtomicU64>);

impl SimulatedClock {
    fn advance(&self, by: Duration) {
        self.0.fetch_add(by.as_nanos() as u64, Ordering::Relaxed);
    }
}

impl Clock for SimulatedClock {
    fn now_ns(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
    fn sleep_until_ns(&self, deadline_ns: u64) {
        self.0.store(deadline_ns, Ordering::Relaxed);
    }
}

/// How a silent target treats requests.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Silent {
    /// It does not receive them.
    Deaf,
    /// It carries them out, but the answers are lost.
    Mute,
    /// It carries them out, but the answers come after the silence.
    Late,
}

/// Simulated target that falls silent at a tick, until the host sends the step of a later tick.
struct FallsSilent {
    desk: Desk<3>,
    clock: SimulatedClock,
    start: Instant,
    kind: Silent,
    ticks: Range<u32>,
    is_silent: bool,
    /// True if any request but a step ends the silence.
    ends_with_hello: bool,
    late: Vec<u8>,
    /// Number of frames sent to it while it was silent.
    unheard: Arc<AtomicU64>,
}

/// Time that a request and its answer take.
const ROUND_TRIP: Duration = Duration::from_micros(200);

impl FallsSilent {
    fn new(kind: Silent, ticks: Range<u32>, clock: &SimulatedClock) -> Self {
        Self {
            desk: desk(),
            clock: clock.clone(),
            start: Instant::now(),
            kind,
            ticks,
            is_silent: false,
            ends_with_hello: false,
            late: Vec::new(),
            unheard: Arc::default(),
        }
    }
}

/// The tick of a step request.
fn step_of(frame: &[u8]) -> Option<u32> {
    let mut reader = FrameReader::<REQUEST_BYTES>::new();
    let messages = frame.iter().filter_map(|byte| match reader.push(*byte)? {
        Ok(message) => {
            let (_, request): (Header, Request<'_>) = postcard::from_bytes(message.bytes).ok()?;
            match request {
                Request::Step { tick, .. } => Some(tick),
                _ => None,
            }
        }
        Err(_) => None,
    });
    messages.last()
}

impl Link for FallsSilent {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        match step_of(bytes) {
            Some(tick) => self.is_silent = self.ticks.contains(&tick),
            None => self.is_silent &= !self.ends_with_hello,
        }
        if !self.is_silent {
            self.clock.advance(ROUND_TRIP);
            return self.desk.send(bytes);
        }
        self.unheard.fetch_add(1, Ordering::Relaxed);
        if self.kind != Silent::Deaf {
            self.desk.send(bytes)?;
            let mut answer = [0; 1024];
            let count = self.desk.receive(&mut answer, Duration::ZERO)?;
            if self.kind == Silent::Late {
                self.late.extend_from_slice(&answer[..count]);
            }
        }
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
        if !self.is_silent {
            let count = buffer.len().min(self.late.len());
            for (slot, byte) in buffer.iter_mut().zip(self.late.drain(..count)) {
                *slot = byte;
            }
            if count > 0 {
                return Ok(count);
            }
            let count = self.desk.receive(buffer, timeout)?;
            if count > 0 {
                return Ok(count);
            }
        }
        self.clock.advance(timeout);
        Ok(0)
    }

    fn now(&self) -> Instant {
        self.start + Duration::from_nanos(self.clock.now_ns())
    }
}
