//! Streams in memory.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::future::poll_fn;
use std::task::Poll;

use embedded_io::{ErrorKind, ErrorType};
use embedded_io_async::{Read, Write};

/// The host's bytes in chunks; an empty chunk is a failure of the line.
pub struct Reader(pub VecDeque<Vec<u8>>);

impl ErrorType for Reader {
    type Error = ErrorKind;
}

impl Read for Reader {
    async fn read(&mut self, into: &mut [u8]) -> Result<usize, ErrorKind> {
        let Some(mut chunk) = self.0.pop_front() else {
            return Ok(0);
        };
        if chunk.is_empty() {
            return Err(ErrorKind::Other);
        }
        let count = chunk.len().min(into.len());
        into[..count].copy_from_slice(&chunk[..count]);
        let rest = chunk.split_off(count);
        if !rest.is_empty() {
            self.0.push_front(rest);
        }
        Ok(count)
    }
}

/// Keeps what is written. Each write first calls `while_waiting` as often as it waits.
pub struct Writer<F> {
    pub sent: Vec<u8>,
    pub waits: usize,
    pub while_waiting: F,
}

impl<F> ErrorType for Writer<F> {
    type Error = Infallible;
}

impl<F: FnMut()> Write for Writer<F> {
    async fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        let mut left = self.waits;
        poll_fn(|context| {
            if left == 0 {
                return Poll::Ready(());
            }
            left -= 1;
            (self.while_waiting)();
            context.waker().wake_by_ref();
            Poll::Pending
        })
        .await;
        self.sent.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    async fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// A writer that never waits.
pub fn quiet() -> Writer<fn()> {
    Writer {
        sent: Vec::new(),
        waits: 0,
        while_waiting: || {},
    }
}
