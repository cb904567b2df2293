//! MDF4 files that a logger did not finish, because it crashed or lost power.
//!
//! Such a file begins with `UnFinMF ` and states by flags what its logger would have corrected at the end. The records
//! themselves are there, up to the last block that reached the disk.

use std::collections::BTreeSet;
use std::io;

use super::blocks::number;
use super::view::View;
use crate::error::RecordingError;
use crate::stream::{MDF, UNFINISHED_MDF};

/// Offset of the last eight bytes of the first block; the last four of them are the flags.
const FLAGS: u64 = 56;

/// First version whose files have these flags, as `id_ver`.
const FIRST_VERSION: u64 = 410;

/// Flags that the standard defines (`id_unfin_flags`).
const COUNTS: u16 = 1;
const LAST_LENGTH: u16 = 1 << 2;
const LAST_LIST: u16 = 1 << 4;
const KNOWN: u16 = 0x7f;

/// What a logger did not finish.
pub(super) struct Unfinished {
    flags: u16,
    /// Offsets of all blocks to which links lead.
    linked: BTreeSet<u64>,
    file_length: u64,
}

impl Unfinished {
    /// Returns what the logger of a file did not finish; `None` if the file is finished.
    ///
    /// # Errors
    /// The file cannot be read, or it cannot be known what is missing.
    pub(super) fn of(view: &View) -> io::Result<Option<Result<Self, RecordingError>>> {
        if view.file_length() < FLAGS + 8 {
            return Ok(None);
        }
        let mut first = [0; FLAGS as usize + 8];
        view.read(0, &mut first)?;
        let version = number(&first[..30], 28);
        let [.., low, high, own_low, own_high] = first;
        let (flags, own_flags) = (
            u16::from_le_bytes([low, high]),
            u16::from_le_bytes([own_low, own_high]),
        );
        let has_flags = version >= FIRST_VERSION && flags != 0;
        if !first.starts_with(&UNFINISHED_MDF) && !has_flags {
            return Ok(None);
        }
        let refused = |reason: String| Ok(Some(Err(RecordingError::Unfinished { reason })));
        if own_flags != 0 {
            return refused(format!(
                "its logger has left steps open that only its own software knows (flags {own_flags:#06x})"
            ));
        }
        if flags & !KNOWN != 0 {
            return refused(format!(
                "it has flags that the standard does not define ({:#06x})",
                flags & !KNOWN
            ));
        }
        Ok(Some(Ok(Self {
            // Without a flag nothing is known to be finished.
            flags: if flags == 0 { KNOWN } else { flags },
            linked: view.linked()?,
            file_length: view.file_length(),
        })))
    }

    /// Makes the file look finished.
    pub(super) fn hide(view: &mut View) -> io::Result<()> {
        let mut end = [0; 8];
        view.read(FLAGS, &mut end)?;
        end[4..].fill(0);
        view.replace(0, MDF);
        view.replace(FLAGS, end);
        Ok(())
    }

    /// True if the numbers of rows may be wrong.
    pub(super) fn has_open_counts(&self) -> bool {
        self.flags & COUNTS != 0
    }

    /// True if the length of the last data block may be wrong.
    pub(super) fn has_open_length(&self) -> bool {
        self.flags & LAST_LENGTH != 0
    }

    /// True if the last list may lack links to data blocks.
    pub(super) fn has_open_list(&self) -> bool {
        self.flags & LAST_LIST != 0
    }

    /// True if a link leads to the block at `at`.
    pub(super) fn is_linked(&self, at: u64) -> bool {
        self.linked.contains(&at)
    }

    /// Returns the offset of the next block to which a link leads, or the end of the file.
    pub(super) fn next_after(&self, at: u64) -> u64 {
        let next = self.linked.range(at.saturating_add(1)..).next();
        next.copied().unwrap_or(self.file_length)
    }
}
