//! A stream as the line of `Device::poll`, for firmware without an executor.

use dashpot_core::link::Line;
use embedded_io::{Read, ReadReady, Write, WriteReady};

/// A line over a stream that tells whether it is ready. It never blocks, and bytes that a failed read loses are found
/// missing by the CRC of their frame.
///
/// ```
/// use dashpot_core::link::Line;
/// use dashpot_device::Polled;
/// # use core::convert::Infallible;
/// # use embedded_io::{ErrorType, Read, ReadReady, Write, WriteReady};
/// # struct Loopback(Option<u8>);
/// # impl ErrorType for Loopback { type Error = Infallible; }
/// # impl Read for Loopback {
/// #     fn read(&mut self, into: &mut [u8]) -> Result<usize, Infallible> {
/// #         into[0] = self.0.take().unwrap();
/// #         Ok(1)
/// #     }
/// # }
/// # impl ReadReady for Loopback {
/// #     fn read_ready(&mut self) -> Result<bool, Infallible> { Ok(self.0.is_some()) }
/// # }
/// # impl Write for Loopback {
/// #     fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
/// #         self.0 = Some(bytes[0]);
/// #         Ok(1)
/// #     }
/// #     fn flush(&mut self) -> Result<(), Infallible> { Ok(()) }
/// # }
/// # impl WriteReady for Loopback {
/// #     fn write_ready(&mut self) -> Result<bool, Infallible> { Ok(self.0.is_none()) }
/// # }
/// # let uart = Loopback(None);
/// let mut line = Polled(uart); // then device.poll(due, &mut line, &mut outputs)
/// assert_eq!(line.receive(), None);
/// assert!(line.send(7) && !line.send(8));
/// assert_eq!(line.receive(), Some(7));
/// ```
#[derive(Debug)]
pub struct Polled<S>(pub S);

impl<S: Read + ReadReady + Write + WriteReady> Line for Polled<S> {
    fn receive(&mut self) -> Option<u8> {
        let mut byte = [0];
        let is_ready = matches!(self.0.read_ready(), Ok(true));
        (is_ready && matches!(self.0.read(&mut byte), Ok(1))).then_some(byte[0])
    }

    fn send(&mut self, byte: u8) -> bool {
        matches!(self.0.write_ready(), Ok(true)) && matches!(self.0.write(&[byte]), Ok(1))
    }
}
