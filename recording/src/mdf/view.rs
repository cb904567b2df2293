//! Bytes of an MDF4 file, in which some links and counts are replaced and blocks are added behind the end.
//!
//! The library reads records only as a finished file stores them. A view shows it such a file without changing the
//! file of the user and without a copy of its records.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::sync::Mutex;

use super::stored::{Compressed, Stored, inflate};

/// Blocks start at multiples of this number of bytes.
pub(super) const ALIGNMENT: u64 = 8;

/// A file with replaced and added bytes.
pub(super) struct View {
    file: Mutex<File>,
    /// Number of bytes of the file.
    length: u64,
    /// Bytes that replace those of the file, by offset.
    replaced: BTreeMap<u64, [u8; 8]>,
    /// Bytes behind the file, without gaps.
    added: Vec<Piece>,
    /// Number of bytes with those added.
    end: u64,
    /// Compressed block that was read last, by its offset, and its contents.
    inflated: Mutex<Option<(u64, Vec<u8>)>>,
}

/// Bytes behind the file.
struct Piece {
    at: u64,
    length: u64,
    content: Content,
}

enum Content {
    Bytes(Vec<u8>),
    /// Part of a stored block, from this offset in its contents.
    Part(Stored, u64),
}

impl View {
    /// # Errors
    /// The length of the file is unknown.
    pub(super) fn new(mut file: File) -> io::Result<Self> {
        let length = file.seek(SeekFrom::End(0))?;
        Ok(Self {
            file: Mutex::new(file),
            length,
            replaced: BTreeMap::new(),
            added: Vec::new(),
            end: length,
            inflated: Mutex::new(None),
        })
    }

    /// Number of bytes of the file.
    pub(super) fn file_length(&self) -> u64 {
        self.length
    }

    /// Number of bytes with those added.
    pub(super) fn end(&self) -> u64 {
        self.end
    }

    /// Replaces eight bytes of the file.
    pub(super) fn replace(&mut self, at: u64, bytes: [u8; 8]) {
        self.replaced.insert(at, bytes);
    }

    /// Adds bytes at the next multiple of [`ALIGNMENT`] and returns their offset.
    pub(super) fn add(&mut self, bytes: Vec<u8>) -> u64 {
        let gap = self.end.next_multiple_of(ALIGNMENT) - self.end;
        if gap > 0 {
            self.push(gap, Content::Bytes(vec![0; gap as usize]));
        }
        let at = self.end;
        self.push(bytes.len() as u64, Content::Bytes(bytes));
        at
    }

    /// Adds a part of a stored block right behind the bytes added last.
    pub(super) fn add_part(&mut self, block: Stored, from: u64, length: u64) {
        self.push(length, Content::Part(block, from));
    }

    fn push(&mut self, length: u64, content: Content) {
        if length > 0 {
            self.added.push(Piece {
                at: self.end,
                length,
                content,
            });
            self.end += length;
        }
    }

    /// Fills `buffer` with the bytes from `offset`.
    ///
    /// # Errors
    /// The file cannot be read, a compressed block is damaged, or the bytes end before the buffer is full.
    pub(super) fn read(&self, mut offset: u64, mut buffer: &mut [u8]) -> io::Result<()> {
        while !buffer.is_empty() {
            let left = buffer.len() as u64;
            let length = if offset < self.length {
                let length = left.min(self.length - offset);
                self.read_file(offset, &mut buffer[..length as usize])?;
                length
            } else {
                let next = self.added.partition_point(|piece| piece.at <= offset);
                let piece = next.checked_sub(1).and_then(|last| self.added.get(last));
                let piece = piece.ok_or(io::ErrorKind::UnexpectedEof)?;
                let from = offset - piece.at;
                let length = left.min(piece.length.saturating_sub(from));
                if length == 0 {
                    return Err(io::ErrorKind::UnexpectedEof.into());
                }
                let part = &mut buffer[..length as usize];
                match &piece.content {
                    Content::Bytes(bytes) => {
                        part.copy_from_slice(&bytes[from as usize..(from + length) as usize]);
                    }
                    Content::Part(block, start) => self.read_stored(block, start + from, part)?,
                }
                length
            };
            offset += length;
            buffer = &mut buffer[length as usize..];
        }
        Ok(())
    }

    /// Fills `buffer` with the contents of a stored block from `from`.
    ///
    /// # Errors
    /// Same errors as [`Self::read`].
    pub(super) fn read_stored(
        &self,
        block: &Stored,
        from: u64,
        buffer: &mut [u8],
    ) -> io::Result<()> {
        match block {
            Stored::Plain { at, .. } => self.read(at + from, buffer),
            Stored::Compressed(compressed) => {
                let poisoned = |_| io::Error::other("a thread stopped while it read the file");
                let mut inflated = self.inflated.lock().map_err(poisoned)?;
                if inflated.as_ref().is_none_or(|(at, _)| *at != compressed.at) {
                    *inflated = None;
                    *inflated = Some((compressed.at, self.inflated(compressed)?));
                }
                let bytes = inflated.as_ref().map_or(&[][..], |(_, bytes)| bytes);
                let from = usize::try_from(from).map_err(io::Error::other)?;
                let part = bytes.get(from..).and_then(|rest| rest.get(..buffer.len()));
                buffer.copy_from_slice(part.ok_or(io::ErrorKind::UnexpectedEof)?);
                Ok(())
            }
        }
    }

    /// Returns the contents of a compressed block.
    pub(super) fn inflated(&self, block: &Compressed) -> io::Result<Vec<u8>> {
        let length = usize::try_from(block.length).map_err(io::Error::other)?;
        let mut bytes = Vec::new();
        bytes
            .try_reserve_exact(length)
            .map_err(|_| io::ErrorKind::OutOfMemory)?;
        bytes.resize(length, 0);
        self.read(block.at, &mut bytes)?;
        inflate(block, &bytes)
    }

    /// Reads bytes of the file with those that replace them.
    fn read_file(&self, offset: u64, buffer: &mut [u8]) -> io::Result<()> {
        let poisoned = |_| io::Error::other("a thread stopped while it read the file");
        let mut file = self.file.lock().map_err(poisoned)?;
        file.seek(SeekFrom::Start(offset))?;
        file.read_exact(buffer)?;
        let end = offset + buffer.len() as u64;
        for (at, bytes) in self.replaced.range(offset.saturating_sub(7)..end) {
            for (place, byte) in (*at..).zip(bytes) {
                if (offset..end).contains(&place) {
                    buffer[(place - offset) as usize] = *byte;
                }
            }
        }
        Ok(())
    }
}
