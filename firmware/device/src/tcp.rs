//! Serves a device over TCP, with embassy-net as the network stack.

use dashpot_core::link::Outputs;
use embassy_futures::yield_now;
use embassy_net::tcp::{TcpSocket, TcpWriter};
use embassy_time::{Duration, with_timeout};
use embedded_io::{Error, ErrorKind, ErrorType};
use embedded_io_async::Write;

use crate::server::Server;

/// A host that is silent for this time is asked whether it is still there.
const KEEP_ALIVE: Duration = Duration::from_millis(500);

/// A host that does not answer for this time is gone. The stack sends a lost segment again after 1 s.
const HOST_TIMEOUT: Duration = Duration::from_millis(2000);

/// Longest wait for room for an answer, half the time of the watchdog of our board. A host that does not read its
/// answers loses the connection; it must not reset the board.
const ROOM_TIMEOUT: Duration = Duration::from_millis(50);

/// Longest wait until the host knows that the connection ended.
const END_TIMEOUT: Duration = Duration::from_millis(100);

/// The answers' end of a connection.
struct Answers<'a>(TcpWriter<'a>);

impl ErrorType for Answers<'_> {
    type Error = ErrorKind;
}

impl Write for Answers<'_> {
    async fn write(&mut self, bytes: &[u8]) -> Result<usize, ErrorKind> {
        match with_timeout(ROOM_TIMEOUT, self.0.write(bytes)).await {
            Ok(written) => written.map_err(|error| error.kind()),
            Err(_) => Err(ErrorKind::TimedOut),
        }
    }

    /// Returns at once, because the stack sends what it has. The socket's own flush waits until the host acknowledges,
    /// and a host may delay that longer than a watchdog waits.
    async fn flush(&mut self) -> Result<(), ErrorKind> {
        Ok(())
    }
}

impl<const N: usize, const WATCHED: usize, O: Outputs<N>> Server<'_, N, WATCHED, O> {
    /// Waits for a host at a port, serves it until the connection ends, and returns why. Ticks run all the time. Call
    /// it again for the next host; the session goes on.
    ///
    /// While a host is connected, another one is refused. A host that vanishes without a word, with its cable or its
    /// power, is given up after 2 s ([`ErrorKind::ConnectionReset`]); one that does not read its answers, 50 ms after
    /// they fill the socket's buffer ([`ErrorKind::TimedOut`]). Port 0 is [`ErrorKind::InvalidInput`].
    pub async fn serve_tcp(&mut self, socket: &mut TcpSocket<'_>, port: u16) -> ErrorKind {
        // Lets other tasks run even if every call fails at once.
        yield_now().await;
        socket.abort();
        socket.set_keep_alive(Some(KEEP_ALIVE));
        socket.set_timeout(Some(HOST_TIMEOUT));
        // An answer must not wait for the acknowledgement of the one before.
        socket.set_nagle_enabled(false);
        if self.run_ticks_until(socket.accept(port)).await.is_err() {
            return ErrorKind::InvalidInput;
        }
        let (mut requests, answers) = socket.split();
        let end = self.serve(&mut requests, &mut Answers(answers)).await;
        socket.close();
        // A host that is gone does not confirm the end.
        let _ = self
            .run_ticks_until(with_timeout(END_TIMEOUT, socket.flush()))
            .await;
        socket.abort();
        end
    }
}
