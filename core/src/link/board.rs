//! What a board gives a device: a line for the link, and outputs for the forces.

/// A serial line, a byte at a time. Nothing waits.
pub trait Line {
    /// A received byte, if one waits.
    fn receive(&mut self) -> Option<u8>;

    /// Sends a byte; false when the line cannot take it now.
    fn send(&mut self, byte: u8) -> bool;
}

/// Where the forces go: the rig's actuators.
pub trait Outputs<const N: usize> {
    /// Sets every output (N). Called after every free-running tick and after every request that may have changed
    /// them; it must not wait.
    fn drive(&mut self, forces_n: &[f32; N]);
}
