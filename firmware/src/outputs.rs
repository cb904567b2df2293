//! The forces as the rig's actuator driver reads them, at any time and from any interrupt: each force
//! whole by itself, those of an interrupted [`drive`] of two ticks.

use core::sync::atomic::{AtomicU32, Ordering};

use crate::bank::DAMPERS;

/// Bits of each damper's output force (N).
static OUTPUTS_N: [AtomicU32; DAMPERS] = [const { AtomicU32::new(0) }; DAMPERS];

/// Sets every output (N).
pub fn drive(forces_n: &[f32; DAMPERS]) {
    for (output, force_n) in OUTPUTS_N.iter().zip(forces_n) {
        output.store(force_n.to_bits(), Ordering::Relaxed);
    }
}

/// Every output (N).
pub fn read() -> [f32; DAMPERS] {
    OUTPUTS_N
        .each_ref()
        .map(|output| f32::from_bits(output.load(Ordering::Relaxed)))
}
