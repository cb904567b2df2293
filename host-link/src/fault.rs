//! Fault injection: a wrapper around any link.

use std::collections::VecDeque;
use std::str::FromStr;
use std::time::{Duration, Instant};

use fastrand::Rng;

use super::{FaultCounts, Link, LinkError};

/// Probability of each fault per frame (1), in both directions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FaultRates {
    /// The frame is lost.
    pub drop: f64,
    /// One bit of the frame is flipped.
    pub corrupt: f64,
    /// The frame arrives after its receiver has stopped waiting.
    pub delay: f64,
    /// The frame arrives twice.
    pub duplicate: f64,
    /// The frame arrives after the next frame.
    pub reorder: f64,
    /// The target is reset before the frame reaches it.
    pub reset: f64,
}

const KINDS: &str = "drop, corrupt, delay, duplicate, reorder, reset";

impl FromStr for FaultRates {
    type Err = String;

    /// Parses kinds and probabilities per frame such as `drop=0.01,reset=0.001`.
    fn from_str(text: &str) -> Result<Self, String> {
        let mut rates = Self::default();
        for part in text.split(',') {
            let (kind, rate) = part
                .split_once('=')
                .ok_or_else(|| format!("`{part}` is not KIND=PROBABILITY"))?;
            let slot = match kind {
                "drop" => &mut rates.drop,
                "corrupt" => &mut rates.corrupt,
                "delay" => &mut rates.delay,
                "duplicate" => &mut rates.duplicate,
                "reorder" => &mut rates.reorder,
                "reset" => &mut rates.reset,
                _ => return Err(format!("`{kind}` is not a fault; allowed: {KINDS}")),
            };
            *slot = match rate.parse() {
                Ok(rate) if (0.0..=0.5).contains(&rate) => rate,
                _ => return Err(format!("{kind}: `{rate}` is not within 0 to 0.5")),
            };
        }
        let sum = rates.drop + rates.corrupt + rates.delay + rates.duplicate + rates.reorder;
        if sum + rates.reset > 1.0 {
            return Err("the probabilities add up to more than 1".into());
        }
        Ok(rates)
    }
}

/// A link with injected faults. The same seed and the same frames give the same faults.
pub struct FaultyLink<L> {
    link: L,
    rates: FaultRates,
    random: Rng,
    counts: FaultCounts,
    to_target: Direction,
    to_host: Direction,
    /// Received bytes of an incomplete frame.
    partial: Vec<u8>,
    ready: VecDeque<u8>,
}

/// Frames held back in one direction of the link.
#[derive(Default)]
struct Direction {
    /// Frames to deliver before the next frame.
    late: Vec<Vec<u8>>,
    /// Frames to deliver after the next frame.
    after_next: Vec<Vec<u8>>,
}

impl<L: Link> FaultyLink<L> {
    /// Wraps `link`.
    ///
    /// # Errors
    /// `rates` contains resets, but the link cannot reset its target.
    pub fn new(link: L, rates: FaultRates, seed: u64) -> Result<Self, LinkError> {
        if rates.reset > 0.0 && !link.can_reset() {
            return Err(LinkError::ResetFaults);
        }
        Ok(Self {
            link,
            rates,
            random: Rng::with_seed(seed),
            counts: FaultCounts::default(),
            to_target: Direction::default(),
            to_host: Direction::default(),
            partial: Vec::new(),
            ready: VecDeque::new(),
        })
    }

    /// Returns the wrapped link.
    pub fn inner(&mut self) -> &mut L {
        &mut self.link
    }

    /// Returns the frames that arrive when `frame` is sent.
    fn pass(&mut self, frame: Vec<u8>, towards_target: bool) -> Vec<Vec<u8>> {
        let direction = if towards_target {
            &mut self.to_target
        } else {
            &mut self.to_host
        };
        let mut arriving = std::mem::take(&mut direction.late);
        let after = std::mem::take(&mut direction.after_next);
        let rates = &self.rates;
        let kinds = [
            rates.drop,
            rates.corrupt,
            rates.delay,
            rates.duplicate,
            rates.reorder,
        ];
        let mut left = self.random.f64();
        let kind = kinds.iter().position(|rate| {
            left -= rate;
            left < 0.0
        });
        let counts = &mut self.counts;
        match kind {
            Some(0) => counts.dropped += 1,
            Some(1) => {
                counts.corrupted += 1;
                let mut frame = frame;
                let index = self.random.usize(..frame.len());
                frame[index] ^= 1 << self.random.u32(..8);
                arriving.push(frame);
            }
            Some(2) => {
                counts.delayed += 1;
                direction.late.push(frame);
            }
            Some(3) => {
                counts.duplicated += 1;
                arriving.push(frame.clone());
                arriving.push(frame);
            }
            Some(4) => {
                counts.reordered += 1;
                direction.after_next.push(frame);
            }
            _ => arriving.push(frame),
        }
        arriving.extend(after);
        arriving
    }

    fn read_ready(&mut self, buffer: &mut [u8]) -> usize {
        let count = buffer.len().min(self.ready.len());
        for (slot, byte) in buffer.iter_mut().zip(self.ready.drain(..count)) {
            *slot = byte;
        }
        count
    }
}

impl<L: Link> Link for FaultyLink<L> {
    /// Sends `bytes` as one frame.
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        if bytes.is_empty() {
            return Ok(());
        }
        if self.random.f64() < self.rates.reset {
            self.counts.resets += 1;
            self.reset_target()?;
        }
        for frame in self.pass(bytes.to_vec(), true) {
            self.link.send(&frame)?;
        }
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
        let deadline = self.now() + timeout;
        while self.ready.is_empty() {
            let left = deadline.saturating_duration_since(self.now());
            let mut bytes = [0; 1024];
            let count = self.link.receive(&mut bytes, left)?;
            for byte in &bytes[..count] {
                self.partial.push(*byte);
                if *byte == 0 {
                    let frame = std::mem::take(&mut self.partial);
                    let arriving = self.pass(frame, false);
                    self.ready.extend(arriving.into_iter().flatten());
                }
            }
            if count == 0 {
                let late = std::mem::take(&mut self.to_host.late);
                self.ready.extend(late.into_iter().flatten());
                return Ok(0);
            }
        }
        Ok(self.read_ready(buffer))
    }

    fn now(&self) -> Instant {
        self.link.now()
    }

    fn reset_target(&mut self) -> Result<(), LinkError> {
        self.partial.clear();
        self.link.reset_target()
    }

    fn can_reset(&self) -> bool {
        self.link.can_reset()
    }

    fn instructions_per_s(&self) -> Option<f64> {
        self.link.instructions_per_s()
    }

    fn injected_faults(&self) -> FaultCounts {
        self.counts
    }
}
