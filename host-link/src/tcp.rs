//! A serial line behind a TCP port, as of an emulator or a terminal server.

use std::io::{self, ErrorKind, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::Duration;

use super::{Link, LinkError};

const CONNECT_TIMEOUT: Duration = Duration::from_secs(5);

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
    /// The address is not valid, or nothing listens there.
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

    /// A link over an open connection, called `name` in errors.
    ///
    /// # Errors
    /// The connection cannot be set to send at once.
    pub fn over(stream: TcpStream, name: String) -> Result<Self, LinkError> {
        stream
            .set_nodelay(true)
            .map_err(|error| LinkError::line(&name, "", error))?;
        Ok(Self {
            stream,
            name,
            timeout: None,
        })
    }

    /// Acknowledges what was received at once. A peer with Nagle's delay, such as QEMU without `nodelay=on`,
    /// sends its next bytes only then, and this system would otherwise wait 40 ms for an answer to carry
    /// the acknowledgement. The system forgets the setting, so it is made anew after every reading.
    #[cfg(target_os = "linux")]
    fn acknowledge(&self) -> Result<(), LinkError> {
        rustix::net::sockopt::set_tcp_quickack(&self.stream, true)
            .map_err(|error| self.error("", error.into()))
    }

    /// Not on this system.
    #[cfg(not(target_os = "linux"))]
    fn acknowledge(&self) -> Result<(), LinkError> {
        Ok(())
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
        // A timeout of zero would mean that there is no timeout; a whole millisecond keeps the setting from changing often.
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
