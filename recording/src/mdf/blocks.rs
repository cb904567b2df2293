//! Headers, links and groups of MDF4 blocks, as far as records depend on them.

use std::collections::BTreeSet;
use std::io;

use super::view::View;

/// Bytes of the header of a block.
pub(super) const HEADER: u64 = 24;

/// Offset of the first block, which is the header of the file.
const FIRST: u64 = 64;

/// Offset of the link to the data in a data group.
const DATA_LINK: u64 = HEADER + 2 * 8;

/// Offset of the number of rows (`cg_cycle_count`) in a channel group, where it follows the header, six links and the
/// record number.
pub(super) const CYCLE_COUNT: u64 = HEADER + 6 * 8 + 8;

/// Flag of a channel group whose records are the values of variable length of a channel.
const IS_VARIABLE_LENGTH: u16 = 1;

/// Header of a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub(super) at: u64,
    pub(super) mark: [u8; 4],
    /// Number of bytes as stated; an unfinished file may state too few.
    pub(super) length: u64,
    /// Number of links; they fit into the file.
    pub(super) links: u64,
}

/// A data group.
pub(super) struct DataGroup {
    pub(super) at: u64,
    /// Offset of its data; 0 if it has none.
    pub(super) data: u64,
    /// Bytes of the record number before each record.
    pub(super) number_bytes: u8,
    pub(super) channel_groups: Vec<ChannelGroup>,
}

/// A channel group.
pub(super) struct ChannelGroup {
    pub(super) at: u64,
    /// Number in front of its records.
    pub(super) number: u64,
    /// Bytes of a record without its number.
    pub(super) record_bytes: u64,
    pub(super) is_variable_length: bool,
}

impl DataGroup {
    /// True if a number in front of each record states its group.
    pub(super) fn has_numbers(&self) -> bool {
        self.number_bytes > 0
    }

    /// Offset of the link to its data.
    pub(super) fn data_link(&self) -> u64 {
        self.at + DATA_LINK
    }
}

impl View {
    /// Returns the header of the block at `at`; `None` if there is none.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(super) fn block(&self, at: u64) -> io::Result<Option<Block>> {
        let room = self.file_length().saturating_sub(at);
        if at < FIRST || room < HEADER {
            return Ok(None);
        }
        let mut bytes = [0; HEADER as usize];
        self.read(at, &mut bytes)?;
        let links = number(&bytes, 16);
        let is_block = bytes.starts_with(b"##") && links <= (room - HEADER) / 8;
        Ok(is_block.then(|| Block {
            at,
            mark: [bytes[0], bytes[1], bytes[2], bytes[3]],
            length: number(&bytes, 8),
            links,
        }))
    }

    /// Returns a link of a block; 0 if it does not have this link.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(super) fn link(&self, block: &Block, index: u64) -> io::Result<u64> {
        if index >= block.links {
            return Ok(0);
        }
        let mut bytes = [0; 8];
        self.read(block.at + HEADER + 8 * index, &mut bytes)?;
        Ok(u64::from_le_bytes(bytes))
    }

    /// Returns `N` bytes behind the links of a block; `None` if the file ends before.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(super) fn contents<const N: usize>(&self, block: &Block) -> io::Result<Option<[u8; N]>> {
        let at = block.at + HEADER + 8 * block.links;
        if self.file_length().saturating_sub(at) < N as u64 {
            return Ok(None);
        }
        let mut bytes = [0; N];
        self.read(at, &mut bytes)?;
        Ok(Some(bytes))
    }

    /// Returns the data groups up to the first that is damaged.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(super) fn data_groups(&self) -> io::Result<Vec<DataGroup>> {
        let (mut groups, mut visited) = (Vec::new(), BTreeSet::new());
        let mut next = match self.block(FIRST)? {
            Some(header) if header.mark == *b"##HD" => self.link(&header, 0)?,
            _ => 0,
        };
        while next != 0 && visited.insert(next) {
            let Some(block) = self.block(next)?.filter(|block| block.mark == *b"##DG") else {
                break;
            };
            let Some([number_bytes]) = self.contents(&block)? else {
                break;
            };
            groups.push(DataGroup {
                at: block.at,
                data: self.link(&block, 2)?,
                number_bytes,
                channel_groups: self.channel_groups(self.link(&block, 1)?)?,
            });
            next = self.link(&block, 0)?;
        }
        Ok(groups)
    }

    fn channel_groups(&self, mut next: u64) -> io::Result<Vec<ChannelGroup>> {
        let (mut groups, mut visited) = (Vec::new(), BTreeSet::new());
        while next != 0 && visited.insert(next) {
            let Some(block) = self.block(next)?.filter(|block| block.mark == *b"##CG") else {
                break;
            };
            let Some(contents) = self.contents::<32>(&block)? else {
                break;
            };
            let half = |at: usize| u64::from(number(&contents, at) as u32);
            groups.push(ChannelGroup {
                at: block.at,
                number: number(&contents, 0),
                record_bytes: half(24) + half(28),
                is_variable_length: number(&contents, 16) as u16 & IS_VARIABLE_LENGTH != 0,
            });
            next = self.link(&block, 0)?;
        }
        Ok(groups)
    }

    /// Returns the offsets of all blocks to which links lead.
    ///
    /// # Errors
    /// The file cannot be read.
    pub(super) fn linked(&self) -> io::Result<BTreeSet<u64>> {
        let mut linked = BTreeSet::from([FIRST]);
        let mut open = vec![FIRST];
        while let Some(at) = open.pop() {
            let Some(block) = self.block(at)? else {
                continue;
            };
            for index in 0..block.links {
                let link = self.link(&block, index)?;
                if link >= FIRST && link < self.file_length() && linked.insert(link) {
                    open.push(link);
                }
            }
        }
        Ok(linked)
    }
}

/// Little-endian number of eight bytes at `at`; bytes that are not there are zero.
pub(super) fn number(bytes: &[u8], at: usize) -> u64 {
    let mut eight = [0; 8];
    for (to, from) in eight.iter_mut().zip(bytes.iter().skip(at)) {
        *to = *from;
    }
    u64::from_le_bytes(eight)
}
