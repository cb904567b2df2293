//! Start of a text, read ahead to detect its separator.

use std::io::{self, Read};

/// Lines to read ahead, not counting blank lines and comments: a header and a row.
const LINES: usize = 2;

/// Maximum number of bytes to read ahead.
const MAX_BYTES: usize = 1 << 16;

/// Start of a text.
pub(super) struct Head {
    /// Bytes read so far.
    pub(super) bytes: Vec<u8>,
    /// Number of bytes in whole lines.
    whole: usize,
}

impl Head {
    /// Returns the whole lines.
    pub(super) fn whole_lines(&self) -> &[u8] {
        &self.bytes[..self.whole]
    }
}

/// Reads the first [`LINES`] lines of `source`. It does not wait for more: a logger at the other end of a pipe may
/// still be writing.
pub(super) fn read(source: &mut dyn Read) -> io::Result<Head> {
    let mut bytes = Vec::new();
    let mut buffer = [0; 1 << 13];
    loop {
        let length = source.read(&mut buffer)?;
        bytes.extend_from_slice(&buffer[..length]);
        let has_ended = length == 0;
        let whole = match bytes.iter().rposition(|byte| *byte == b'\n') {
            _ if has_ended => bytes.len(),
            Some(end) => end + 1,
            None => 0,
        };
        if has_ended || bytes.len() >= MAX_BYTES || count_lines(&bytes[..whole]) >= LINES {
            return Ok(Head { bytes, whole });
        }
    }
}

fn count_lines(text: &[u8]) -> usize {
    let lines = text.split(|byte| *byte == b'\n');
    lines
        .filter(|line| !line.trim_ascii().is_empty() && !line.starts_with(b"#"))
        .count()
}

/// Skips up to `count` lines and returns the number of skipped lines.
pub(super) fn skip_lines(source: &mut dyn Read, count: u64) -> io::Result<u64> {
    let mut skipped = 0;
    let mut byte = [0];
    while skipped < count && source.read(&mut byte)? > 0 {
        skipped += u64::from(byte[0] == b'\n');
    }
    Ok(skipped)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Line numbers in errors count the skipped lines, so that only lines of the text may count.
    #[test]
    fn lines_are_skipped_up_to_the_end_of_the_text() {
        for (count, skipped, rest) in [(0, 0, "a\nb\n"), (1, 1, "b\n"), (2, 2, ""), (9, 2, "")] {
            let mut source = &b"a\nb\n"[..];
            assert_eq!(skip_lines(&mut source, count).expect("memory"), skipped);
            assert_eq!(source, rest.as_bytes());
        }
    }
}
