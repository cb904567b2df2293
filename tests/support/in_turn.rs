//! The firmware under QEMU, one request and one answer at a time.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::Duration;

use dashpot_host_link::{Link, LinkError, Qemu, RetryLimits};
use xtask::processor::CORTEX_M7;
use xtask::tools::{ARM_GCC, QEMU, have, have_target};

/// Retry limits for the client; the link below it never makes it wait.
pub const RETRY_LIMITS: RetryLimits = RetryLimits {
    timeout: Duration::ZERO,
    tries: 50,
};
/// Timeout for a target that will never answer; any answer ends the wait.
pub const STUCK: Duration = Duration::from_secs(300);
/// Maximum number of answers for a target that counts its own ticks; each tick has time for a hundred.
pub const MAX_ANSWERS: u32 = 1_000_000;

/// The folder of the images; `None`, after a message, if they cannot be built.
pub fn images() -> Option<PathBuf> {
    static IMAGES: OnceLock<Option<PathBuf>> = OnceLock::new();
    let build = || {
        let what = "the firmware under QEMU";
        if !have(&[QEMU, ARM_GCC], what) {
            return None;
        }
        let toolchain = have_target(CORTEX_M7.target, what)?;
        let built = xtask::firmware::build(&toolchain, &CORTEX_M7);
        Some(built.unwrap_or_else(|error| panic!("{error}")))
    };
    IMAGES.get_or_init(build).clone()
}

/// An emulator that handles one request and one answer at a time, so that a run is the same on fast and slow machines.
/// Every complete frame has one answer, and sending waits for all answers.
pub struct InTurn {
    emulator: Qemu,
    /// True within a frame to the target.
    partial: bool,
    answers: VecDeque<u8>,
    sent: u32,
    /// Resets the target before the frames with these numbers.
    resets: &'static [u32],
}

impl InTurn {
    /// Starts the emulator; its outputs go to the file.
    pub fn start(image: &Path, resets: &'static [u32], outputs: Option<&Path>) -> Self {
        Self {
            emulator: Qemu::start_with_outputs(image, outputs).expect("the emulator starts"),
            partial: false,
            answers: VecDeque::new(),
            sent: 0,
            resets,
        }
    }

    /// Number of frames that end within `bytes`; there is no frame between two zeros in a row.
    fn frames(&mut self, bytes: &[u8]) -> usize {
        let ends = bytes.iter().filter(|byte| {
            let ends = **byte == 0 && self.partial;
            self.partial = **byte != 0;
            ends
        });
        ends.count()
    }
}

impl Link for InTurn {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.sent += 1;
        if self.resets.contains(&self.sent) {
            self.emulator.reset_target()?;
            self.partial = false;
        }
        self.emulator.send(bytes)?;
        let mut expected = self.frames(bytes);
        while expected > 0 {
            let mut buffer = [0; 1024];
            let count = self.emulator.receive(&mut buffer, STUCK)?;
            assert!(count > 0, "no answer in {STUCK:?}: the target is stuck");
            let received = &buffer[..count];
            expected -= received.iter().filter(|byte| **byte == 0).count();
            self.answers.extend(received);
        }
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], _: Duration) -> Result<usize, LinkError> {
        let count = buffer.len().min(self.answers.len());
        for (slot, byte) in buffer.iter_mut().zip(self.answers.drain(..count)) {
            *slot = byte;
        }
        Ok(count)
    }

    fn instructions_per_s(&self) -> Option<f64> {
        self.emulator.instructions_per_s()
    }
}
