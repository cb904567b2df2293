//! Records of several groups in one stream, each after the number of its group.

use std::collections::HashMap;
use std::io;

use super::blocks::DataGroup;
use super::stored::Stored;
use super::view::View;

/// Bytes that are read at a time.
const WINDOW: u64 = 1 << 16;

/// Bytes of records that make a block for the library, which holds one block in memory.
const BLOCK: u64 = 1 << 20;

/// Bytes of the length in front of a value of variable length.
const LENGTH: u64 = 4;

/// Records of a stream, up to the last whole one.
#[derive(Debug, Default)]
pub(super) struct Walk {
    /// Number of records of each group.
    pub(super) counts: Vec<u64>,
    /// Ends of blocks that do not divide a record.
    pub(super) ends: Vec<u64>,
}

/// Contents of stored blocks, one after another.
pub(super) struct Stream<'a> {
    view: &'a View,
    blocks: &'a [Stored],
    /// Position of each block in the stream.
    starts: Vec<u64>,
    length: u64,
    window: Vec<u8>,
    window_at: u64,
}

impl<'a> Stream<'a> {
    pub(super) fn new(view: &'a View, blocks: &'a [Stored]) -> Self {
        let (mut starts, mut length) = (Vec::new(), 0_u64);
        for block in blocks {
            starts.push(length);
            length = length.saturating_add(block.length());
        }
        Self {
            view,
            blocks,
            starts,
            length,
            window: Vec::new(),
            window_at: 0,
        }
    }

    /// Number of bytes.
    pub(super) fn length(&self) -> u64 {
        self.length
    }

    /// Returns the parts of blocks that make the bytes from `start` to `end`: a block, where the part starts in it, and
    /// its length.
    pub(super) fn parts(&self, start: u64, end: u64) -> Vec<(Stored, u64, u64)> {
        let mut parts = Vec::new();
        let first = self.starts.partition_point(|at| *at <= start);
        let blocks = self.starts.iter().zip(self.blocks);
        for (at, block) in blocks.skip(first.saturating_sub(1)) {
            let (from, to) = (start.max(*at), end.min(at.saturating_add(block.length())));
            if *at >= end {
                break;
            }
            if from < to {
                parts.push((*block, from - at, to - from));
            }
        }
        parts
    }

    /// Returns up to eight bytes at `at`; bytes behind the end are zero.
    fn number(&mut self, at: u64, bytes: u64) -> io::Result<u64> {
        let end = at + bytes;
        if at < self.window_at || end > self.window_at + self.window.len() as u64 {
            let window_end = at.saturating_add(WINDOW).min(self.length);
            self.window.clear();
            self.window_at = at;
            for (block, from, length) in self.parts(at, window_end) {
                let start = self.window.len();
                self.window.resize(start + length as usize, 0);
                let part = &mut self.window[start..];
                self.view.read_stored(&block, from, part)?;
            }
        }
        let start = (at - self.window_at) as usize;
        let read = self.window.iter().skip(start).take(bytes as usize);
        Ok(read
            .rev()
            .fold(0, |number, byte| number << 8 | u64::from(*byte)))
    }

    /// Walks over the records of a data group. It ends at a record of an unknown group, whose length is unknown too,
    /// and at one that is not whole.
    ///
    /// # Errors
    /// The file cannot be read, or a compressed block is damaged.
    pub(super) fn walk(&mut self, group: &DataGroup) -> io::Result<Walk> {
        let number_bytes = u64::from(group.number_bytes);
        let numbered = group.channel_groups.iter().enumerate();
        let groups: HashMap<u64, (usize, Option<u64>)> = numbered
            .map(|(index, group)| {
                let length = (!group.is_variable_length).then_some(group.record_bytes);
                (group.number, (index, length))
            })
            .collect();
        let mut walk = Walk {
            counts: vec![0; group.channel_groups.len()],
            ends: Vec::new(),
        };
        let (mut at, mut block_at) = (0, 0);
        while at + number_bytes <= self.length {
            let number = self.number(at, number_bytes)?;
            let Some((index, length)) = groups.get(&number) else {
                break;
            };
            let length = match length {
                Some(length) => *length,
                None if at + number_bytes + LENGTH > self.length => break,
                None => LENGTH + self.number(at + number_bytes, LENGTH)?,
            };
            let end = at + number_bytes + length;
            if end > self.length {
                break;
            }
            walk.counts[*index] += 1;
            at = end;
            if at - block_at >= BLOCK {
                walk.ends.push(at);
                block_at = at;
            }
        }
        if at > block_at {
            walk.ends.push(at);
        }
        Ok(walk)
    }
}
