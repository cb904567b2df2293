//! Requests of a host that steps a bank.

use dashpot_core::link::{Frame, Header, PROTOCOL, Reals, Request};

/// Dampers of the bank.
const DAMPERS: u32 = 12;

/// Amplitude of the triangular motion (m).
const AMPLITUDE_M: f32 = 5e-3;

/// Half period of the triangular motion (ticks).
const HALF_PERIOD: u32 = 125;

/// A request of at most 12 displacements.
type ShortFrame = Frame<128>;

fn frame(session: u16, sequence: u32, request: &Request<'_>) -> ShortFrame {
    let mut frame = Frame::new();
    frame.write(&(Header { session, sequence }, request));
    frame
}

/// The hello that opens a session.
pub fn hello_frame(session: u16) -> ShortFrame {
    frame(session, 0, &Request::Hello { protocol: PROTOCOL })
}

/// Displacements of the bank at a tick (m): a triangular motion.
pub fn displacements_m(tick: u32) -> Reals {
    (0..DAMPERS).map(|i| triangle(tick + 9 * i)).collect()
}

/// The step to a tick, with a sequence number.
pub fn step_frame(session: u16, sequence: u32, tick: u32) -> ShortFrame {
    let step = Request::Step {
        tick,
        displacements_m: displacements_m(tick),
    };
    frame(session, sequence, &step)
}

/// Triangular motion (m).
fn triangle(tick: u32) -> f32 {
    let phase = tick % (2 * HALF_PERIOD);
    let distance = phase.min(2 * HALF_PERIOD - phase) as f32;
    AMPLITUDE_M * (2.0 * distance / HALF_PERIOD as f32 - 1.0)
}
