//! The rig behind a damper: simulated in this process, or behind UDP.

use dashpot_core::hybrid::Measured;
use dashpot_core::hybrid::wire::InboxCounts;
use dashpot_hybrid::rig::VirtualRig;

use super::remote::RemoteRig;

/// A rig.
pub(super) enum RigEnd {
    /// In this process; with the readings of its last tick.
    Virtual(Box<VirtualRig>, Option<Measured>),
    /// Behind UDP.
    Remote(RemoteRig),
}

impl RigEnd {
    /// Returns the readings that arrived since the last tick.
    pub(super) fn receive(&mut self) -> Option<Measured> {
        match self {
            Self::Virtual(_, last) => last.take(),
            Self::Remote(rig) => rig.receive(),
        }
    }

    /// Sends the command (m) of a tick.
    pub(super) fn send(&mut self, time_s: f64, command_m: f32) {
        match self {
            Self::Virtual(rig, last) => *last = rig.tick(f64::from(command_m)),
            Self::Remote(rig) => rig.send(time_s, command_m),
        }
    }

    /// True if the rig holds its displacement and follows no command.
    pub(super) fn is_held(&self) -> bool {
        match self {
            Self::Virtual(..) => false,
            Self::Remote(rig) => rig.is_held(),
        }
    }

    /// Ends the session.
    pub(super) fn stop(&mut self, time_s: f64) {
        if let Self::Remote(rig) = self {
            rig.stop(time_s);
        }
    }

    /// Ticks at a limit of the actuator.
    pub(super) fn saturated_ticks(&self) -> u64 {
        match self {
            Self::Virtual(rig, _) => rig.saturated_ticks(),
            Self::Remote(rig) => rig.saturated(),
        }
    }

    /// Seconds of a rig with its own clock for each second of the vehicle.
    pub(super) fn clock_ratio(&self) -> Option<f64> {
        match self {
            Self::Virtual(..) => None,
            Self::Remote(rig) => rig.clock_ratio(),
        }
    }

    /// Counts of the answers; `None` in this process.
    pub(super) fn counts(&self) -> Option<InboxCounts> {
        match self {
            Self::Virtual(..) => None,
            Self::Remote(rig) => Some(rig.counts()),
        }
    }
}
