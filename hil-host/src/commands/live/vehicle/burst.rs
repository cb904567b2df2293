//! Frames on their way to the viewers.

/// Frames that go out together.
#[derive(Default)]
pub(super) struct Burst {
    /// Those behind `count` are kept for their memory.
    frames: Vec<Vec<u8>>,
    count: usize,
}

impl Burst {
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Room for another frame.
    pub fn next(&mut self) -> &mut Vec<u8> {
        if self.frames.len() <= self.count {
            self.frames.push(Vec::new());
        }
        self.count += 1;
        &mut self.frames[self.count - 1]
    }

    /// Returns all frames and empties the burst.
    pub fn take(&mut self) -> impl ExactSizeIterator<Item = &[u8]> {
        let count = std::mem::take(&mut self.count);
        self.frames[..count].iter().map(Vec::as_slice)
    }
}
