//! Line ends of a text, needed to determine line numbers.

use std::io::{self, Read};

/// Reader that records how lines end.
pub(super) struct LineEnds<R> {
    source: R,
    length: u64,
    last: u8,
    /// True if lines end with CR and LF; `None` before the first line end.
    two_bytes: Option<bool>,
}

impl<R: Read> LineEnds<R> {
    pub(super) fn new(source: R) -> Self {
        Self {
            source,
            length: 0,
            last: 0,
            two_bytes: None,
        }
    }

    /// True if the source ends at byte `position` without a line end.
    pub(super) fn ends_unended(&self, position: u64) -> bool {
        position == self.length && ![b'\n', b'\r'].contains(&self.last)
    }

    /// True if a reader at byte `position` has passed the LF of its last row. The reader ends rows at the first CR or
    /// LF.
    pub(super) fn has_passed_line_feed(&self, position: u64) -> bool {
        if position == self.length {
            // The last row may end without a line feed.
            self.last == b'\n'
        } else {
            self.two_bytes == Some(false)
        }
    }
}

impl<R: Read> Read for LineEnds<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.source.read(buffer)?;
        let bytes = &buffer[..length];
        if self.two_bytes.is_none()
            && let Some(end) = bytes.iter().position(|&byte| byte == b'\n')
        {
            let before = if end > 0 { bytes[end - 1] } else { self.last };
            self.two_bytes = Some(before == b'\r');
        }
        self.length += length as u64;
        self.last = bytes.last().copied().unwrap_or(self.last);
        Ok(length)
    }
}
