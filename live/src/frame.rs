//! Frames: the last value of each signal, and its least and greatest since the frame before.

/// Bytes before the numbers of a frame.
const HEADER_BYTES: usize = 48;

/// Flags of a frame.
pub mod flags {
    /// The run has ended.
    pub const ENDED: u32 = 1;
    /// The model does not cover what happened.
    pub const OUTSIDE_VALIDITY: u32 = 2;
    /// The operator has stopped the run.
    pub const STOPPED: u32 = 4;
    /// The run is slower than wanted.
    pub const SLOW: u32 = 8;
}

/// What a frame says besides the numbers of its signals.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FrameHead {
    /// Number of the run on the page.
    pub run: u32,
    /// Time, s.
    pub time_s: f64,
    /// Distance, m.
    pub distance_m: f64,
    /// Ticks since the start.
    pub ticks: u64,
    /// Work of a tick, mean and greatest, us.
    pub work_us: [f32; 2],
    /// See [`flags`].
    pub flags: u32,
}

/// Numbers of the frame that is being made.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Frame {
    last: Vec<f32>,
    least: Vec<f32>,
    greatest: Vec<f32>,
    ticks: u32,
}

impl Frame {
    /// An empty frame of this number of signals.
    pub fn new(signals: usize) -> Self {
        Self {
            last: vec![0.0; signals],
            least: vec![f32::INFINITY; signals],
            greatest: vec![f32::NEG_INFINITY; signals],
            ticks: 0,
        }
    }

    /// Takes the values of a tick.
    pub fn add(&mut self, values: impl Iterator<Item = f32>) {
        self.read(values);
        self.ticks += 1;
    }

    /// Takes values that belong to no tick of their own.
    pub(crate) fn read(&mut self, values: impl Iterator<Item = f32>) {
        for (number, value) in values.enumerate() {
            self.last[number] = value;
            self.least[number] = self.least[number].min(value);
            self.greatest[number] = self.greatest[number].max(value);
        }
    }

    /// Last value of each signal.
    pub fn last(&self) -> &[f32] {
        &self.last
    }

    /// Ticks in it so far.
    pub fn ticks(&self) -> u32 {
        self.ticks
    }

    /// Writes the frame (docs/live.md has its bytes), and begins the next with the last values.
    ///
    /// ```
    /// use dashpot_live::{Frame, FrameHead};
    ///
    /// let mut frame = Frame::new(1);
    /// frame.add([2.0].into_iter());
    /// frame.add([-1.0].into_iter());
    /// let mut bytes = Vec::new();
    /// frame.write(&FrameHead { ticks: 2, ..FrameHead::default() }, &mut bytes);
    /// assert_eq!(bytes.len(), 48 + 3 * 4);
    /// assert_eq!(&bytes[48..52], (-1.0_f32).to_le_bytes());
    /// assert_eq!(&bytes[56..60], 2.0_f32.to_le_bytes());
    /// ```
    pub fn write(&mut self, head: &FrameHead, to: &mut Vec<u8>) {
        let numbers = self.last.len();
        to.clear();
        to.reserve(HEADER_BYTES + 12 * numbers);
        to.extend(head.run.to_le_bytes());
        to.extend((numbers as u32).to_le_bytes());
        for value in [head.time_s, head.distance_m, head.ticks as f64] {
            to.extend(value.to_le_bytes());
        }
        for value in head.work_us {
            to.extend(value.to_le_bytes());
        }
        to.extend(self.ticks.to_le_bytes());
        to.extend(head.flags.to_le_bytes());
        for values in [&self.last, &self.least, &self.greatest] {
            for value in values {
                to.extend(value.to_le_bytes());
            }
        }
        self.ticks = 0;
        self.least.clone_from(&self.last);
        self.greatest.clone_from(&self.last);
    }
}
