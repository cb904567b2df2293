//! Interfaces of a board: a serial line for the link, and outputs for the forces.

/// A serial line for single bytes. No method may block.
pub trait Line {
    /// Returns the next received byte, if any.
    fn receive(&mut self) -> Option<u8>;

    /// Sends a byte. Returns false if the line cannot take it now.
    fn send(&mut self, byte: u8) -> bool;
}

/// Outputs for the forces: the actuators of the rig.
pub trait Outputs<const N: usize> {
    /// Sets all outputs (N), positive when they resist extension. Called after each free-running tick and after each
    /// request that may change them. Must not block.
    fn drive(&mut self, forces_n: &[f32; N]);
}
