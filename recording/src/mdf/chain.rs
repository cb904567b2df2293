//! The blocks in which a data group stores its records.

use std::collections::BTreeSet;
use std::io;

use super::blocks::{Block, HEADER, number};
use super::stored::{Compressed, MAX_INFLATED, Stored};
use super::unfinished::Unfinished;
use super::view::{ALIGNMENT, View};

/// Bytes of a compressed block before the compressed bytes: its header, types, and both numbers of bytes.
const COMPRESSED_HEADER: u64 = HEADER + 24;

/// The stored records of a data group.
#[derive(Debug, Default)]
pub(super) struct Chain {
    pub(super) blocks: Vec<Stored>,
    /// Bytes of blocks that an unfinished file does not have as a whole.
    pub(super) left_bytes: u64,
}

/// Data blocks of a list, and what is needed to find those that an unfinished file does not list yet.
#[derive(Default)]
struct Listed {
    addresses: Vec<u64>,
    /// Number of empty links at the end of the last list.
    empty: u64,
    /// End of the last list.
    end: u64,
}

impl View {
    /// Returns the blocks of records from `at` on; `None` if the file is damaged or stores records in another way, so
    /// that the library decides about it. An `unfinished` file has blocks up to the last whole one.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(super) fn chain(
        &self,
        at: u64,
        unfinished: Option<&Unfinished>,
    ) -> io::Result<Option<Chain>> {
        let Some(first) = self.block(at)? else {
            return Ok(unfinished.map(|_| Chain::default()));
        };
        let mut listed = match &first.mark {
            b"##HL" => {
                let list = self.link(&first, 0)?;
                self.listed(list)?
            }
            b"##DL" => self.listed(at)?,
            b"##DT" | b"##DV" | b"##DZ" => Some(Listed {
                addresses: vec![at],
                ..Listed::default()
            }),
            _ => None,
        };
        if let (Some(listed), Some(unfinished)) = (&mut listed, unfinished) {
            self.add_unlisted(listed, unfinished)?;
        }
        let Some(Listed { addresses, .. }) = listed else {
            return Ok(None);
        };
        let mut chain = Chain::default();
        for (index, address) in addresses.iter().enumerate() {
            let is_last = index + 1 == addresses.len();
            let stored = match unfinished {
                Some(unfinished) => self.stored_unfinished(*address, is_last, unfinished)?,
                None => self.stored(*address)?,
            };
            match (stored, unfinished) {
                (Some(stored), _) => chain.blocks.push(stored),
                (None, None) => return Ok(None),
                // What follows a block that is not whole cannot be trusted.
                (None, Some(unfinished)) => {
                    let rest = addresses[index..].iter();
                    let bytes = rest.map(|at| unfinished.next_after(*at).saturating_sub(*at));
                    chain.left_bytes = bytes.sum();
                    break;
                }
            }
        }
        Ok(Some(chain))
    }

    /// Returns the data blocks of a chain of lists; `None` if a list is damaged or is of another kind.
    fn listed(&self, mut next: u64) -> io::Result<Option<Listed>> {
        let (mut listed, mut visited) = (Listed::default(), BTreeSet::new());
        while next != 0 {
            let Some(list) = self.block(next)?.filter(|list| list.mark == *b"##DL") else {
                return Ok(None);
            };
            if !visited.insert(next) {
                return Ok(None);
            }
            listed.empty = 0;
            for index in 1..list.links {
                match self.link(&list, index)? {
                    0 => listed.empty += 1,
                    link => {
                        listed.empty = 0;
                        listed.addresses.push(link);
                    }
                }
            }
            listed.end = list.at.saturating_add(list.length);
            next = self.link(&list, 0)?;
        }
        Ok(Some(listed))
    }

    /// Adds the data blocks right behind the last list or its last block that the list should have links to.
    fn add_unlisted(&self, listed: &mut Listed, unfinished: &Unfinished) -> io::Result<()> {
        if !unfinished.has_open_list() || listed.empty == 0 {
            return Ok(());
        }
        let mut end = listed.end;
        if let Some(last) = listed.addresses.last()
            && let Some(block) = self.block(*last)?
        {
            end = end.max(last.saturating_add(block.length));
        }
        while listed.empty > 0 {
            let Some(at) = end.checked_next_multiple_of(ALIGNMENT) else {
                break;
            };
            let is_data = |block: &Block| [*b"##DT", *b"##DV", *b"##DZ"].contains(&block.mark);
            let Some(block) = self.block(at)?.filter(is_data) else {
                break;
            };
            if unfinished.is_linked(at) {
                break;
            }
            listed.addresses.push(at);
            listed.empty -= 1;
            if block.length <= HEADER {
                // The length of the block that the logger was writing is not known yet.
                break;
            }
            end = at.saturating_add(block.length);
        }
        Ok(())
    }

    /// Returns a block of a finished file; `None` if it is not in the file as a whole.
    fn stored(&self, at: u64) -> io::Result<Option<Stored>> {
        let Some(block) = self.block(at)? else {
            return Ok(None);
        };
        let end = at.saturating_add(block.length);
        let is_whole = block.length >= HEADER && end <= self.file_length();
        match &block.mark {
            b"##DT" | b"##DV" if is_whole => Ok(Some(Stored::Plain {
                at: at + HEADER,
                length: block.length - HEADER,
            })),
            b"##DZ" => self.compressed(&block),
            _ => Ok(None),
        }
    }

    /// Returns a block of an unfinished file; `None` if it is not in the file as a whole. The last block may have any
    /// length.
    fn stored_unfinished(
        &self,
        at: u64,
        is_last: bool,
        unfinished: &Unfinished,
    ) -> io::Result<Option<Stored>> {
        let Some(block) = self.block(at)? else {
            return Ok(None);
        };
        let next = unfinished.next_after(at);
        match &block.mark {
            b"##DT" | b"##DV" => {
                let mut end = at.saturating_add(block.length);
                let fills_its_room = block.length >= HEADER
                    && end <= next
                    && end.checked_next_multiple_of(ALIGNMENT) >= Some(next);
                let is_open = unfinished.has_open_length() && !fills_its_room;
                if is_last && (is_open || end > next) {
                    end = next;
                }
                let is_whole = (at + HEADER..=next).contains(&end);
                Ok(is_whole.then(|| Stored::Plain {
                    at: at + HEADER,
                    length: end - at - HEADER,
                }))
            }
            b"##DZ" => {
                let stored = self.compressed(&block)?;
                // The end of the last block may not have reached the disk.
                Ok(stored.filter(|stored| match stored {
                    Stored::Compressed(block) if is_last => self.inflated(block).is_ok(),
                    _ => true,
                }))
            }
            _ => Ok(None),
        }
    }

    fn compressed(&self, block: &Block) -> io::Result<Option<Stored>> {
        let Some(contents) = self.contents::<24>(block)? else {
            return Ok(None);
        };
        let (columns, inflated) = (number(&contents[..8], 4) as u32, number(&contents, 8));
        let length = number(&contents, 16);
        let at = block.at + COMPRESSED_HEADER;
        let is_whole = at
            .checked_add(length)
            .is_some_and(|end| end <= self.file_length());
        let columns = match contents[2] {
            0 => None,
            1 if columns > 0 => Some(columns),
            _ => return Ok(None),
        };
        let is_readable = is_whole && block.links == 0 && inflated <= MAX_INFLATED;
        Ok(is_readable.then_some(Stored::Compressed(Compressed {
            at,
            length,
            inflated,
            columns,
        })))
    }
}
