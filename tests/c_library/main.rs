//! The C library: its header, and the example on the host and on targets.

mod header;
mod host;
mod targets;
