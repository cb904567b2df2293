//! Serves a device over an async byte stream.

use core::future::Future;
use core::pin::pin;

use dashpot_core::link::{Device, Line, Outputs, RESPONSE_FRAME_BYTES};
use embassy_futures::select::{Either, select};
use embassy_futures::yield_now;
use embedded_io::{Error, ErrorKind};
use embedded_io_async::{Read, Write};
use heapless::Vec;

use crate::progress::Progress;
use crate::ticks::Ticks;

/// Number of bytes taken from the stream at once.
const CHUNK_BYTES: usize = 64;

/// A device with its outputs and ticks.
///
/// Ticks run while the stream waits, reads or writes. A tick is late by at most the longest request or slice of a load.
#[derive(Debug)]
pub struct Server<'a, const N: usize, const WATCHED: usize, O> {
    /// A started device.
    pub device: &'a mut Device<N, WATCHED>,
    /// Actuators.
    pub outputs: O,
    /// Ticks that the timer counted.
    pub ticks: &'a Ticks,
    /// What the watchdog looks at.
    pub progress: &'a Progress,
}

/// Received bytes, and room for one answer.
struct Chunk<'a> {
    received: core::slice::Iter<'a, u8>,
    answer: Vec<u8, RESPONSE_FRAME_BYTES>,
}

impl Line for Chunk<'_> {
    fn receive(&mut self) -> Option<u8> {
        self.received.next().copied()
    }

    fn send(&mut self, byte: u8) -> bool {
        self.answer.push(byte).is_ok()
    }
}

impl<const N: usize, const WATCHED: usize, O: Outputs<N>> Server<'_, N, WATCHED, O> {
    /// Serves until the stream fails or ends ([`ErrorKind::BrokenPipe`]), and returns why.
    ///
    /// The session continues in the next call. After a disturbed line call it again at once; the host repeats what was
    /// lost. After the end of a connection wait for the next one in [`Server::run_ticks_until`].
    pub async fn serve(&mut self, reader: &mut impl Read, writer: &mut impl Write) -> ErrorKind {
        let mut received = [0; CHUNK_BYTES];
        loop {
            // Lets other tasks run even if the stream never waits.
            yield_now().await;
            let read = reader.read(&mut received);
            let count = match self.run_ticks_until(read).await {
                Ok(0) => return ErrorKind::BrokenPipe,
                Ok(count) => count,
                Err(error) => return error.kind(),
            };
            let received = received.get(..count).unwrap_or_default();
            if let Err(kind) = self.answer(received, writer).await {
                return kind;
            }
        }
    }

    /// Hands bytes to the device and sends its answers.
    async fn answer(&mut self, received: &[u8], writer: &mut impl Write) -> Result<(), ErrorKind> {
        let mut chunk = Chunk {
            received: received.iter(),
            answer: Vec::new(),
        };
        while !chunk.received.as_slice().is_empty()
            || self.device.is_busy()
            || self.device.is_sending()
        {
            let due = self.ticks.take();
            if due > 0 {
                self.progress.ran_ticks();
            }
            self.device.poll(due, &mut chunk, &mut self.outputs);
            if chunk.answer.is_empty() || self.device.is_sending() {
                continue;
            }
            let sent = async {
                writer.write_all(&chunk.answer).await?;
                writer.flush().await
            };
            self.run_ticks(sent, false)
                .await
                .map_err(|error| error.kind())?;
            chunk.answer.clear();
        }
        self.progress.link_alive();
        Ok(())
    }

    /// Runs ticks until `wait` is done. The link has nothing to do until then, which counts as progress.
    pub async fn run_ticks_until<F: Future>(&mut self, wait: F) -> F::Output {
        self.run_ticks(wait, true).await
    }

    async fn run_ticks<F: Future>(&mut self, wait: F, link_is_idle: bool) -> F::Output {
        let mut wait = pin!(wait);
        loop {
            let (due, output) = match select(wait.as_mut(), self.ticks.wait()).await {
                // A stream that never waits, because it fails at once, must not hold up the ticks.
                Either::First(output) => (self.ticks.take(), Some(output)),
                Either::Second(due) => (due, None),
            };
            if due > 0 {
                self.device.tick(due);
                self.outputs.drive(self.device.outputs_n());
                self.progress.ran_ticks();
            }
            if link_is_idle {
                self.progress.link_alive();
            }
            if let Some(output) = output {
                return output;
            }
        }
    }
}
