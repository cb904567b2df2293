//! Order of arriving datagrams.

use super::frame::{Frame, FrameKind};

/// Counts of arrived and missing datagrams.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InboxCounts {
    /// Datagrams that were newer than all before.
    pub fresh: u32,
    /// Datagrams that have not arrived although a newer one has.
    pub lost: u32,
    /// Datagrams that arrived after a newer one.
    pub late: u32,
    /// Datagrams that arrived again.
    pub repeated: u32,
    /// Datagrams that are damaged, of another protocol, of another session or of the wrong direction.
    pub foreign: u32,
}

/// Numbers before the newest one that are remembered.
const REMEMBERED: u32 = 64;

/// Accepts only datagrams of one session and direction that are newer than all before, and counts the others.
///
/// A lost datagram that arrives at last counts as late and no longer as lost. One that is more than 64 numbers old
/// counts as late.
///
/// ```
/// use dashpot_core::hybrid::wire::{Frame, FrameFlags, FrameKind, Inbox};
///
/// let frame = |sequence| Frame {
///     kind: FrameKind::Measurement,
///     flags: FrameFlags::empty(),
///     session: 7,
///     sequence,
///     answers: 0,
///     time_s: 0.0,
///     displacement_m: 0.0,
///     other: 0.0,
/// };
/// let mut inbox = Inbox::new(FrameKind::Measurement, 7);
/// let accepted = [1, 2, 5, 4, 5].map(|number| inbox.accept(&frame(number).to_bytes()).is_some());
/// assert_eq!(accepted, [true, true, true, false, false]);
/// let counts = inbox.counts();
/// assert_eq!((counts.fresh, counts.lost, counts.late, counts.repeated), (3, 1, 1, 1));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inbox {
    kind: FrameKind,
    session: u32,
    newest: u32,
    /// Bit `n` is set if the datagram `n` numbers before the newest has arrived.
    arrived: u64,
    counts: InboxCounts,
}

impl Inbox {
    /// An inbox of a session, before its first datagram.
    pub fn new(kind: FrameKind, session: u32) -> Self {
        Self {
            kind,
            session,
            newest: 0,
            // Numbers before the first are not missed.
            arrived: u64::MAX,
            counts: InboxCounts::default(),
        }
    }

    /// Takes the bytes of a datagram; returns it if it is newer than all before.
    pub fn accept(&mut self, bytes: &[u8]) -> Option<Frame> {
        let frame = Frame::from_bytes(bytes).ok();
        let of_session = |frame: &Frame| frame.kind == self.kind && frame.session == self.session;
        let Some(frame) = frame.filter(of_session) else {
            self.reject();
            return None;
        };
        let ahead = frame.sequence.wrapping_sub(self.newest);
        if ahead != 0 && ahead <= u32::MAX / 2 {
            let counts = &mut self.counts;
            counts.fresh = counts.fresh.saturating_add(1);
            counts.lost = counts.lost.saturating_add(ahead - 1);
            let moved = self.arrived.checked_shl(ahead).unwrap_or(0);
            (self.newest, self.arrived) = (frame.sequence, moved | 1);
            return Some(frame);
        }
        let behind = self.newest.wrapping_sub(frame.sequence);
        let bit = 1_u64.checked_shl(behind).unwrap_or(0);
        let counts = &mut self.counts;
        if self.arrived & bit != 0 {
            counts.repeated = counts.repeated.saturating_add(1);
        } else {
            counts.late = counts.late.saturating_add(1);
            counts.lost -= u32::from(behind < REMEMBERED && counts.lost > 0);
            self.arrived |= bit;
        }
        None
    }

    /// Counts a datagram that another part has found to be foreign.
    pub fn reject(&mut self) {
        self.counts.foreign = self.counts.foreign.saturating_add(1);
    }

    /// The session.
    pub fn session(&self) -> u32 {
        self.session
    }

    /// Number of the newest datagram; 0 before the first.
    pub fn newest(&self) -> u32 {
        self.newest
    }

    /// The counts so far.
    pub fn counts(&self) -> InboxCounts {
        self.counts
    }
}
