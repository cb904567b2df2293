//! Datagrams between a simulated vehicle and a rig.

mod frame;
mod inbox;

pub use frame::{FRAME_BYTES, Frame, FrameError, FrameFlags, FrameKind};
pub use inbox::{Inbox, InboxCounts};
