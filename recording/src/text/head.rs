//! The first lines of a text, looked at before they are read.

use std::io::{self, Read};

/// Lines that are looked at beside blank ones and comments, and all that come with them: a header and a row.
const LINES: usize = 2;

/// Bytes that are looked at.
const MOST: usize = 1 << 16;

/// Reads as much of `source` as [`LINES`] lines need, and no more than it has at hand: a logger at the other end of a pipe may be
/// writing still. All that was read, and where its whole lines end.
pub(super) fn read(source: &mut dyn Read) -> io::Result<(Vec<u8>, usize)> {
    let mut head = Vec::new();
    let mut buffer = [0; 1 << 13];
    loop {
        let length = source.read(&mut buffer)?;
        head.extend_from_slice(&buffer[..length]);
        let has_ended = length == 0;
        let whole = match head.iter().rposition(|byte| *byte == b'\n') {
            _ if has_ended => head.len(),
            Some(end) => end + 1,
            None => 0,
        };
        if has_ended || head.len() >= MOST || lines(&head[..whole]) >= LINES {
            return Ok((head, whole));
        }
    }
}

fn lines(text: &[u8]) -> usize {
    let lines = text.split(|byte| *byte == b'\n');
    lines
        .filter(|line| !line.trim_ascii().is_empty() && !line.starts_with(b"#"))
        .count()
}

/// Passes over lines; how many there were, at most `count`.
pub(super) fn skip_lines(source: &mut dyn Read, count: u64) -> io::Result<u64> {
    let mut skipped = 0;
    let mut byte = [0];
    while skipped < count && source.read(&mut byte)? > 0 {
        skipped += u64::from(byte[0] == b'\n');
    }
    Ok(skipped)
}
