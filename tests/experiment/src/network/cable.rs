//! An Ethernet cable that counts, loses and swaps frames.

use core::cell::{Cell, RefCell};

use heapless::{Deque, Vec};

/// Largest frame without its checksum (bytes). It is small, as the memory of targets is.
pub const FRAME_BYTES: usize = 600;

/// Frames that are on their way in one direction.
const FRAMES: usize = 8;

/// Bytes of a frame on the line beside its contents: checksum 4, preamble 8, gap 12.
const FRAMING_BYTES: u32 = 24;

/// Least contents of a frame; shorter ones are filled (bytes).
const LEAST_BYTES: u32 = 60;

/// Frames that a direction carried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counted {
    /// Number of frames.
    pub frames: u32,
    /// Bytes on the line, with checksum, preamble and gap.
    pub line_bytes: u32,
}

/// What happens to frames, in thousandths of them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Faults {
    /// Frames that are lost.
    pub lost: u32,
    /// Frames that arrive after the next one.
    pub swapped: u32,
}

type Frame = Vec<u8, FRAME_BYTES>;

/// One direction.
pub(super) struct Direction {
    frames: RefCell<Deque<Frame, FRAMES>>,
    /// A frame that the next one overtakes.
    late: RefCell<Option<Frame>>,
    counted: Cell<Counted>,
}

/// Both directions of a cable.
pub struct Cable {
    pub(super) to_target: Direction,
    pub(super) to_host: Direction,
    faults: Cell<Faults>,
    is_pulled: Cell<bool>,
    random: Cell<u32>,
    lost_frames: Cell<u32>,
}

impl Direction {
    const fn new() -> Self {
        Self {
            frames: RefCell::new(Deque::new()),
            late: RefCell::new(None),
            counted: Cell::new(Counted {
                frames: 0,
                line_bytes: 0,
            }),
        }
    }

    /// Frames that wait.
    pub(super) fn len(&self) -> usize {
        self.frames.borrow().len()
    }

    /// Takes the first frame where it is.
    pub(super) fn take<R>(&self, read: impl FnOnce(&mut [u8]) -> R) -> Option<R> {
        let mut frames = self.frames.borrow_mut();
        let result = frames.front_mut().map(|frame| read(frame));
        drop(frames.pop_front());
        result
    }

    fn has_room(&self) -> bool {
        // One more may be late.
        self.len() + 1 < FRAMES
    }
}

impl Cable {
    /// A cable without faults.
    pub const fn new() -> Self {
        Self {
            to_target: Direction::new(),
            to_host: Direction::new(),
            faults: Cell::new(Faults {
                lost: 0,
                swapped: 0,
            }),
            is_pulled: Cell::new(false),
            random: Cell::new(1),
            lost_frames: Cell::new(0),
        }
    }

    /// Sets the faults from now on.
    pub fn set_faults(&self, faults: Faults) {
        self.faults.set(faults);
    }

    /// Pulls the cable or plugs it in. Frames on a pulled cable are lost, and nobody notices.
    pub fn set_pulled(&self, is_pulled: bool) {
        self.is_pulled.set(is_pulled);
    }

    /// What the cable carried to the target and to the host.
    pub fn counted(&self) -> [Counted; 2] {
        [&self.to_target, &self.to_host].map(|direction| direction.counted.get())
    }

    /// Number of frames that the target has not taken.
    pub fn waiting(&self) -> usize {
        self.to_target.len()
    }

    /// Number of frames that it lost.
    pub fn lost_frames(&self) -> u32 {
        self.lost_frames.get()
    }

    /// Puts a frame on the way to the target, from nobody.
    pub fn inject(&self, frame: &[u8]) {
        self.send(&self.to_target, frame.len(), |to| to.copy_from_slice(frame));
    }

    /// Writes a frame where it waits. A full direction loses it.
    pub(super) fn send<R>(
        &self,
        direction: &Direction,
        bytes: usize,
        write: impl FnOnce(&mut [u8]) -> R,
    ) -> R {
        let mut frame = Frame::new();
        // The stacks know the largest frame.
        let _ = frame.resize(bytes.min(FRAME_BYTES), 0);
        let result = write(&mut frame);
        let mut counted = direction.counted.get();
        counted.frames += 1;
        counted.line_bytes += LEAST_BYTES.max(bytes as u32) + FRAMING_BYTES;
        direction.counted.set(counted);
        let faults = self.faults.get();
        let late = direction.late.take();
        if self.is_pulled.get() || !direction.has_room() || self.happens(faults.lost) {
            self.lost_frames.set(self.lost_frames.get() + 1);
            return result;
        }
        let mut frames = direction.frames.borrow_mut();
        if late.is_none() && self.happens(faults.swapped) {
            direction.late.replace(Some(frame));
        } else {
            let _ = frames.push_back(frame);
        }
        if let Some(late) = late {
            let _ = frames.push_back(late);
        }
        result
    }

    /// Whether something with a probability in thousandths happens.
    fn happens(&self, per_mille: u32) -> bool {
        if per_mille == 0 {
            return false;
        }
        // Xorshift (Marsaglia 2003).
        let mut x = self.random.get();
        x ^= x << 13;
        x ^= x >> 17;
        x ^= x << 5;
        self.random.set(x);
        x % 1000 < per_mille
    }
}

impl Default for Cable {
    fn default() -> Self {
        Self::new()
    }
}
