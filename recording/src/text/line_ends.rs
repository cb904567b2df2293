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

#[cfg(test)]
mod tests {
    use super::*;

    /// Source that returns one byte at a time, like a slow pipe.
    struct Bytes(&'static [u8]);

    impl Read for Bytes {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let length = self.0.len().min(1);
            self.0.read(&mut buffer[..length])
        }
    }

    /// At byte 3 of these texts, a reader has passed a line end. Only line ends of two bytes have a line feed left.
    #[test]
    fn line_ends_are_found_across_blocks() {
        for (text, two_bytes) in [
            (&b"ab\ncd\n"[..], false),
            (b"ab\r\ncd\r\n", true),
            (b"\nab\ncd\n", false),
        ] {
            let blocks: [Box<dyn Read>; 2] = [Box::new(text), Box::new(Bytes(text))];
            for block in blocks {
                let mut ends = LineEnds::new(block);
                io::copy(&mut ends, &mut io::sink()).expect("memory");
                assert_eq!(ends.has_passed_line_feed(3), !two_bytes, "{text:?}");
                assert!(!ends.ends_unended(text.len() as u64), "{text:?}");
            }
        }
    }
}
