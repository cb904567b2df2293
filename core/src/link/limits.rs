//! Version of the protocol, and the largest numbers in its messages.

/// Version of the messages. It changes whenever the bytes of a message change. New messages are added at the end
/// without a new version, because a device answers a message that it does not know with
/// [`Refusal::Unreadable`](super::Refusal::Unreadable).
pub const PROTOCOL: u16 = 3;
/// Largest number of dampers of a device.
pub const MAX_DAMPERS: usize = 16;
/// Largest number of telemetry samples in one response.
pub const MAX_SAMPLES: usize = 8;
/// Largest number of measured samples in one request.
pub const MAX_MEASURED: usize = 8;
/// Bytes of a measured sample.
pub const MEASURED_BYTES: usize = 8;
