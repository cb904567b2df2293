//! A serial line behind a TCP port, for example of an emulator or a terminal server.

use std::io::{self, ErrorKind, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::Duration;

use super::{Link, LinkError};

const CONNECT_TIMEOUT: Duration = Duration::from_secs(5);

/// Longest wait until the connection takes bytes. A target that stops reading would otherwise block the host for ever.
const SEND_TIMEOUT: Duration = Duration::from_secs(5);

/// Waits below this are precise; the read timeout of a socket may be several milliseconds too long.
#[cfg(target_os = "linux")]
const PRECISE_BELOW: Duration = Duration::from_millis(20);

/// A TCP connection.
#[derive(Debug)]
pub struct Tcp {
    stream: TcpStream,
    name: String,
    timeout: Option<Duration>,
}

impl Tcp {
    /// Connects to `HOST:PORT`.
    ///
    /// # Errors
    /// The address is invalid, or nothing listens there.
    pub fn connect(address: &str) -> Result<Self, LinkError> {
        let name = format!("tcp:{address}");
        let failed = |error| LinkError::line(&name, "cannot connect: ", error);
        let mut last = None;
        for address in address.to_socket_addrs().map_err(failed)? {
            match TcpStream::connect_timeout(&address, CONNECT_TIMEOUT) {
                Ok(stream) => return Self::over(stream, name),
                Err(error) => last = Some(error),
            }
        }
        Err(match last {
            Some(error) => failed(error),
            None => LinkError::line(&name, "", io::Error::other("the host has no address")),
        })
    }

    /// Creates a link over an open connection; error messages refer to it as `name`.
    ///
    /// # Errors
    /// Immediate sending (`TCP_NODELAY`) or the limit on the duration of sending cannot be set.
    pub fn over(stream: TcpStream, name: String) -> Result<Self, LinkError> {
        stream
            .set_nodelay(true)
            .and_then(|()| stream.set_write_timeout(Some(SEND_TIMEOUT)))
            .map_err(|error| LinkError::line(&name, "", error))?;
        Ok(Self {
            stream,
            name,
            timeout: None,
        })
    }

    /// Acknowledges received bytes at once. A peer that uses Nagle's algorithm, such as QEMU without `nodelay=on`,
    /// waits for the acknowledgement before it sends more, and this system would otherwise delay it by 40 ms. The
    /// system forgets the setting, so it is renewed after each read.
    #[cfg(target_os = "linux")]
    fn acknowledge(&self) -> Result<(), LinkError> {
        rustix::net::sockopt::set_tcp_quickack(&self.stream, true)
            .map_err(|error| self.error("", error.into()))
    }

    /// Does nothing on this system.
    #[cfg(not(target_os = "linux"))]
    fn acknowledge(&self) -> Result<(), LinkError> {
        Ok(())
    }

    /// Waits precisely for bytes, at most `timeout`. Returns false if none arrived.
    #[cfg(target_os = "linux")]
    fn is_ready_within(&self, timeout: Duration) -> Result<bool, LinkError> {
        use rustix::event::{PollFd, PollFlags, Timespec, poll};
        if timeout >= PRECISE_BELOW {
            return Ok(true);
        }
        let timeout = Timespec {
            tv_sec: 0,
            tv_nsec: timeout.subsec_nanos().into(),
        };
        let mut streams = [PollFd::new(&self.stream, PollFlags::IN)];
        match poll(&mut streams, Some(&timeout)) {
            Ok(ready) => Ok(ready > 0),
            Err(rustix::io::Errno::INTR) => Ok(false),
            Err(error) => Err(self.error("cannot receive: ", error.into())),
        }
    }

    /// Leaves all waits to the read timeout of the socket on this system.
    #[cfg(not(target_os = "linux"))]
    fn is_ready_within(&self, _: Duration) -> Result<bool, LinkError> {
        Ok(true)
    }

    fn error(&self, action: &str, source: io::Error) -> LinkError {
        LinkError::line(&self.name, action, source)
    }
}

impl Link for Tcp {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.stream
            .write_all(bytes)
            .map_err(|error| self.error("cannot send: ", error))
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
        if !self.is_ready_within(timeout)? {
            return Ok(0);
        }
        // Zero would mean no timeout. Rounding to whole milliseconds avoids changing the setting often.
        let timeout = Duration::from_millis(timeout.as_millis().max(1) as u64);
        if self.timeout != Some(timeout) {
            self.stream
                .set_read_timeout(Some(timeout))
                .map_err(|error| self.error("", error))?;
            self.timeout = Some(timeout);
        }
        match self.stream.read(buffer) {
            Ok(0) => Err(self.error("", io::Error::other("the target closed the connection"))),
            Ok(count) => {
                self.acknowledge()?;
                Ok(count)
            }
            Err(error) => match error.kind() {
                ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted => Ok(0),
                _ => Err(self.error("cannot receive: ", error)),
            },
        }
    }
}
