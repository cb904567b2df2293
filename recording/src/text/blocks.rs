//! Blocks of a text, and the line ends that were read, needed to determine line numbers.

use std::io::{self, Read};

use memchr::{memchr2, memrchr};

/// Number of bytes of a block.
const BLOCK: usize = 1 << 16;

/// Number of bytes after a block that may be looked at together with its last bytes.
pub(super) const PADDING: usize = 16;

/// Text that is read in blocks and given out line by line: a call of `read` returns at most one line. A reader of rows
/// therefore never has more than its current row, and the following rows can be taken from the block.
pub(super) struct Blocks<R> {
    source: R,
    /// The block, followed by [`PADDING`].
    buffer: Box<[u8]>,
    /// Start of the bytes that have not been given out.
    start: usize,
    /// End of the block.
    end: usize,
    /// End of the last whole line in the block.
    whole: usize,
    /// Number of bytes before the block.
    before: u64,
    /// Last byte before the block.
    last_before: u8,
    /// Number of line feeds given out.
    line_feeds: u64,
}

impl<R: Read> Blocks<R> {
    pub(super) fn new(source: R) -> Self {
        Self {
            source,
            buffer: vec![0; BLOCK + PADDING].into_boxed_slice(),
            start: 0,
            end: 0,
            whole: 0,
            before: 0,
            last_before: 0,
            line_feeds: 0,
        }
    }

    /// Returns the rest of the block with its padding if it starts with a whole line. This line ends with a line feed.
    /// It is given out by [`Blocks::advance`].
    #[inline]
    pub(super) fn whole_lines(&mut self) -> Option<&[u8]> {
        // Of a line end of two bytes, a reader of rows leaves the line feed.
        if self.start < self.whole && self.buffer[self.start] == b'\n' {
            self.advance(1);
        }
        (self.start < self.whole).then(|| &self.buffer[self.start..self.end + PADDING])
    }

    /// Gives out one line of `length` bytes.
    #[inline]
    pub(super) fn advance(&mut self, length: usize) {
        self.start += length;
        self.line_feeds += 1;
    }

    /// Number of bytes given out.
    pub(super) fn position(&self) -> u64 {
        self.before + self.start as u64
    }

    /// Last byte given out.
    fn last(&self) -> u8 {
        match self.start.checked_sub(1) {
            Some(last) => self.buffer[last],
            None => self.last_before,
        }
    }

    /// True if the bytes given out end within a line.
    pub(super) fn is_within_line(&self) -> bool {
        ![b'\n', b'\r'].contains(&self.last())
    }

    /// Number of the line, from 1, to which the last byte belongs.
    pub(super) fn line(&self) -> u64 {
        self.line_feeds + u64::from(self.last() != b'\n')
    }

    fn next_block(&mut self) -> io::Result<()> {
        let last = self.last();
        let length = self.source.read(&mut self.buffer[..BLOCK])?;
        self.last_before = last;
        self.before += self.end as u64;
        (self.start, self.end) = (0, length);
        self.whole = memrchr(b'\n', &self.buffer[..length]).map_or(0, |last| last + 1);
        Ok(())
    }
}

impl<R: Read> Read for Blocks<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.start == self.end {
            self.next_block()?;
        }
        let rest = &self.buffer[self.start..self.end];
        let line = memchr2(b'\n', b'\r', rest).map_or(rest.len(), |end| end + 1);
        let length = line.min(buffer.len());
        buffer[..length].copy_from_slice(&rest[..length]);
        self.line_feeds += u64::from(buffer[..length].last() == Some(&b'\n'));
        self.start += length;
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

    /// Reads up to a line end, as a reader of rows does.
    fn read_line(blocks: &mut Blocks<Box<dyn Read>>) -> Vec<u8> {
        let mut line = Vec::new();
        let mut byte = [0; 4];
        loop {
            let length = blocks.read(&mut byte).expect("memory");
            line.extend_from_slice(&byte[..length]);
            if length == 0 || [b'\n', b'\r'].contains(&line[line.len() - 1]) {
                return line;
            }
        }
    }

    #[test]
    fn lines_are_given_out_one_by_one_and_counted() {
        for (text, lines) in [
            (&b"abcdef\nc\n"[..], &[("abcdef\n", 1), ("c\n", 2)][..]),
            (b"ab\r\ncd", &[("ab\r", 1), ("\n", 1), ("cd", 2)]),
            (b"\nab\ncd\n", &[("\n", 1), ("ab\n", 2), ("cd\n", 3)]),
            (b"ab\rcd\r", &[("ab\r", 1), ("cd\r", 1)]),
        ] {
            let sources: [Box<dyn Read>; 2] = [Box::new(text), Box::new(Bytes(text))];
            for source in sources {
                let mut blocks = Blocks::new(source);
                for (line, number) in lines {
                    assert_eq!(read_line(&mut blocks), line.as_bytes(), "{text:?}");
                    assert_eq!(blocks.line(), *number, "{text:?}");
                    assert_eq!(blocks.is_within_line(), *line == "cd", "{text:?}");
                }
                assert_eq!(read_line(&mut blocks), b"");
                assert_eq!(blocks.position(), text.len() as u64);
            }
        }
    }

    #[test]
    fn whole_lines_can_be_taken_from_a_block() {
        let mut blocks: Blocks<Box<dyn Read>> = Blocks::new(Box::new(&b"a\r\nbc\nd"[..]));
        assert!(blocks.whole_lines().is_none());
        assert_eq!(read_line(&mut blocks), b"a\r");
        let lines = blocks.whole_lines().expect("a whole line");
        assert!(lines.starts_with(b"bc\nd"));
        blocks.advance(3);
        assert_eq!((blocks.line(), blocks.position()), (2, 6));
        assert!(blocks.whole_lines().is_none());
        assert_eq!(read_line(&mut blocks), b"d");
        assert_eq!((blocks.line(), blocks.is_within_line()), (3, true));
    }
}
