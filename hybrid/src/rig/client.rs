//! The vehicle's end of the wire.

use dashpot_core::hybrid::Measured;
use dashpot_core::hybrid::wire::{Frame, FrameFlags, FrameKind, Inbox, InboxCounts};

/// Ticks at the beginning in which commands carry the flag `START`, because the first ones can be lost.
const STARTING_TICKS: u32 = 20;

/// Makes the commands of a session and reads its answers.
#[derive(Clone, Debug)]
pub struct RigClient {
    inbox: Inbox,
    session: u32,
    sequence: u32,
    last_m: f32,
    step_s: f32,
    is_answered: bool,
    is_held: bool,
    saturated: u64,
    time_s: f64,
    /// Time of the vehicle and of the rig at the first answer to a moving clock, and at the last one (s).
    clocks: Option<[[f64; 2]; 2]>,
}

impl RigClient {
    /// A session of this number, which must be another for each run, with ticks of `step_s`.
    pub fn new(session: u32, step_s: f64) -> Self {
        Self {
            inbox: Inbox::new(FrameKind::Measurement, session),
            session,
            sequence: 0,
            last_m: 0.0,
            step_s: step_s as f32,
            is_answered: false,
            is_held: false,
            saturated: 0,
            time_s: 0.0,
            clocks: None,
        }
    }

    /// Returns the datagram of the command (m) of this tick.
    pub fn command(&mut self, time_s: f64, command_m: f32) -> Frame {
        let rate = (command_m - self.last_m) / self.step_s;
        self.last_m = command_m;
        self.frame(time_s, command_m, rate, FrameFlags::empty())
    }

    /// Returns the datagram that ends the session; send it several times, because each can be lost.
    pub fn stop(&mut self, time_s: f64) -> Frame {
        self.frame(time_s, self.last_m, 0.0, FrameFlags::STOP)
    }

    fn frame(&mut self, time_s: f64, command_m: f32, rate: f32, mut flags: FrameFlags) -> Frame {
        self.sequence = self.sequence.wrapping_add(1);
        self.time_s = time_s;
        let is_starting = !self.is_answered || self.sequence <= STARTING_TICKS;
        flags.set(FrameFlags::START, is_starting);
        Frame {
            kind: FrameKind::Command,
            flags,
            session: self.session,
            sequence: self.sequence,
            answers: self.inbox.newest(),
            time_s,
            displacement_m: command_m,
            other: rate,
        }
    }

    /// Takes the bytes of a datagram; returns the readings and the number of the command that they answer, if they are
    /// newer than all before.
    pub fn take(&mut self, bytes: &[u8]) -> Option<(Measured, u32)> {
        let frame = self.inbox.accept(bytes)?;
        if !self.is_answered {
            // The rate of the first command is that from where the rig is.
            self.last_m = frame.displacement_m;
        }
        self.is_answered = true;
        self.saturated += u64::from(frame.flags.contains(FrameFlags::SATURATED));
        if self.time_s > 0.0 {
            let now = [self.time_s, frame.time_s];
            self.clocks = Some([self.clocks.map_or(now, |[first, _]| first), now]);
        }
        self.is_held = frame.flags.contains(FrameFlags::HELD);
        let measured = Measured {
            displacement_m: frame.displacement_m,
            force_n: frame.other,
        };
        Some((measured, frame.answers))
    }

    /// Seconds of the rig for each second of the vehicle; `None` in the first 0.1 s.
    pub fn clock_ratio(&self) -> Option<f64> {
        let [[own_0, rig_0], [own_1, rig_1]] = self.clocks?;
        (own_1 - own_0 >= 0.1).then(|| (rig_1 - rig_0) / (own_1 - own_0))
    }

    /// Answers with the flag `SATURATED`.
    pub fn saturated(&self) -> u64 {
        self.saturated
    }

    /// Number of the newest command.
    pub fn sequence(&self) -> u32 {
        self.sequence
    }

    /// True if the rig said in its last answer that it holds its displacement.
    pub fn is_held(&self) -> bool {
        self.is_held
    }

    /// True once the rig has answered.
    pub fn is_answered(&self) -> bool {
        self.is_answered
    }

    /// Counts of the answers.
    pub fn counts(&self) -> InboxCounts {
        self.inbox.counts()
    }
}
