//! The rig's end of the wire.

use dashpot_core::hybrid::wire::{Frame, FrameFlags, FrameKind, Inbox, InboxCounts};

use super::VirtualRig;
use super::keeper::{CommandKeeper, KeeperSettings};

/// A virtual rig that follows datagrams and answers them.
///
/// A session begins with a command that has the flag `START` and a session number other than the present one. Until the
/// actuator has come to rest after the present session, a start of another one is foreign.
#[derive(Clone, Debug)]
pub struct RigServer {
    rig: VirtualRig,
    keeper: CommandKeeper,
    session: Option<Session>,
    /// Foreign datagrams without a session.
    foreign: u32,
    sessions: u32,
    step_s: f64,
    ticks: u64,
    silent_ticks: u32,
    saturated_before: u64,
}

#[derive(Clone, Debug)]
struct Session {
    inbox: Inbox,
    sequence: u32,
    newest: Option<Frame>,
}

/// Ticks without a command after which another session may begin, whatever the state of the present one.
const TAKEOVER_TICKS: u32 = 1000;

impl RigServer {
    /// A server for a rig at rest with ticks of `step_s`.
    pub fn new(rig: VirtualRig, settings: KeeperSettings, step_s: f64) -> Self {
        Self {
            rig,
            keeper: CommandKeeper::new(settings, 0.0, step_s),
            session: None,
            foreign: 0,
            sessions: 0,
            step_s,
            ticks: 0,
            silent_ticks: 0,
            saturated_before: 0,
        }
    }

    /// Takes the bytes of a datagram; returns true if it is a new command of the session, so that answers go to its
    /// sender.
    pub fn take(&mut self, bytes: &[u8]) -> bool {
        let frame = Frame::from_bytes(bytes).ok();
        let starts = frame.filter(|frame| {
            frame.kind == FrameKind::Command && frame.flags.contains(FrameFlags::START)
        });
        if let Some(frame) = starts
            && self.may_start(frame.session)
        {
            self.foreign = self.counts().foreign;
            self.session = Some(Session {
                inbox: Inbox::new(FrameKind::Command, frame.session),
                sequence: 0,
                newest: None,
            });
            self.sessions += 1;
            self.keeper.restart();
        }
        let Some(session) = &mut self.session else {
            self.foreign = self.foreign.saturating_add(1);
            return false;
        };
        let accepted = session.inbox.accept(bytes);
        session.newest = accepted.or(session.newest);
        accepted.is_some()
    }

    /// A session that is over, or silent, gives way to another.
    fn may_start(&self, number: u32) -> bool {
        let is_free = self.keeper.is_at_rest() || self.silent_ticks > TAKEOVER_TICKS;
        match &self.session {
            None => true,
            Some(session) => is_free && session.inbox.session() != number,
        }
    }

    /// Lets another session begin: the present one has been silent for long, and no ticks tell.
    pub fn release(&mut self) {
        self.silent_ticks = TAKEOVER_TICKS + 1;
    }

    /// Makes a tick with the newest command; returns the answer, or `None` without a session or without readings.
    pub fn tick(&mut self) -> Option<Frame> {
        self.ticks += 1;
        let newest = self
            .session
            .as_mut()
            .and_then(|session| session.newest.take());
        self.silent_ticks = match newest {
            Some(_) => 0,
            None => self.silent_ticks.saturating_add(1),
        };
        let command_m = match &self.session {
            Some(_) => self.keeper.tick(newest.as_ref()),
            None => 0.0,
        };
        let measured = self.rig.tick(command_m);
        let is_saturated = self.rig.saturated_ticks() > self.saturated_before;
        self.saturated_before = self.rig.saturated_ticks();
        let session = self.session.as_mut()?;
        let measured = measured?;
        session.sequence = session.sequence.wrapping_add(1);
        let mut flags = FrameFlags::empty();
        flags.set(FrameFlags::HELD, self.keeper.is_held());
        flags.set(FrameFlags::SATURATED, is_saturated);
        Some(Frame {
            kind: FrameKind::Measurement,
            flags,
            session: session.inbox.session(),
            sequence: session.sequence,
            answers: session.inbox.newest(),
            time_s: self.ticks as f64 * self.step_s,
            displacement_m: measured.displacement_m,
            other: measured.force_n,
        })
    }

    /// Counts of the present session; foreign datagrams are those of all.
    pub fn counts(&self) -> InboxCounts {
        let mut counts = self
            .session
            .as_ref()
            .map_or(InboxCounts::default(), |session| session.inbox.counts());
        counts.foreign = counts.foreign.saturating_add(self.foreign);
        counts
    }

    /// Number of sessions so far.
    pub fn sessions(&self) -> u32 {
        self.sessions
    }

    /// Ticks so far.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// The command of the actuator in the last tick (m).
    pub fn command_m(&self) -> f64 {
        self.keeper.command_m()
    }

    /// True while the rig holds its displacement until the next session.
    pub fn is_held(&self) -> bool {
        self.keeper.is_held()
    }

    /// Largest number of ticks in a row without a command.
    pub fn longest_gap(&self) -> u32 {
        self.keeper.longest_gap()
    }

    /// The rig.
    pub fn rig(&mut self) -> &mut VirtualRig {
        &mut self.rig
    }
}
