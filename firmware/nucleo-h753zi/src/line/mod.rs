//! The line of the link: the serial port, or with the feature `ethernet` the network. An image has one of them, so the
//! device has one host.

#[cfg(feature = "ethernet")]
mod ethernet;
#[cfg(feature = "ethernet")]
pub use ethernet::start;

#[cfg(not(feature = "ethernet"))]
mod serial;
#[cfg(not(feature = "ethernet"))]
pub use serial::start;
