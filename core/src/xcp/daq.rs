//! DAQ lists: each a number of tables (ODTs) of entries, all in three pools. A list is sampled at an event; each of its
//! tables becomes one packet.

use core::ops::Range;

use super::{Address, ErrorCode};

/// Bytes of a packet before its data: number of the table and of the list.
pub(super) const IDENTIFIER_BYTES: usize = 2;
/// Bytes of the time stamp in the first packet of a list.
pub(super) const TIMESTAMP_BYTES: usize = 4;
/// Largest number of tables in a list: a packet that begins with a higher number is no sample.
const MAX_ODTS: u8 = 0xFC;

/// Bytes that are measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Entry {
    pub address: Address,
    /// 0 if nothing is measured.
    pub size: u8,
}

/// Entries of one packet.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Odt {
    first_entry: u16,
    entries: u8,
}

/// What a master sets for a list.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Mode {
    pub event: u16,
    pub prescaler: u8,
    pub priority: u8,
}

/// One list.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct List {
    first_odt: u16,
    odts: u8,
    pub mode: Mode,
    pub is_selected: bool,
    pub is_running: bool,
    /// Events since the last sample.
    pub events: u8,
}

/// Last command of an allocation, which has a fixed order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Allocated {
    Nothing,
    Freed,
    Lists,
    Odts,
    Entries,
}

/// The entry that the next WRITE_DAQ writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pointer {
    list: u16,
    odt: u8,
    entry: u8,
}

/// All DAQ lists of a slave.
#[derive(Clone, Debug)]
pub(super) struct Daq<const LISTS: usize, const ODTS: usize, const ENTRIES: usize> {
    pub lists: heapless::Vec<List, LISTS>,
    odts: heapless::Vec<Odt, ODTS>,
    entries: heapless::Vec<Entry, ENTRIES>,
    allocated: Allocated,
    pub pointer: Option<Pointer>,
}

impl<const LISTS: usize, const ODTS: usize, const ENTRIES: usize> Daq<LISTS, ODTS, ENTRIES> {
    pub const fn new() -> Self {
        Self {
            lists: heapless::Vec::new(),
            odts: heapless::Vec::new(),
            entries: heapless::Vec::new(),
            allocated: Allocated::Nothing,
            pointer: None,
        }
    }

    pub fn is_running(&self) -> bool {
        self.lists.iter().any(|list| list.is_running)
    }

    /// Removes all lists.
    pub fn free(&mut self) {
        *self = Self::new();
        self.allocated = Allocated::Freed;
    }

    /// Checks the order of an allocation; `last` is its own command.
    fn check(&self, earliest: Allocated, last: Allocated) -> Result<(), ErrorCode> {
        match (earliest..=last).contains(&self.allocated) {
            true => Ok(()),
            false => Err(ErrorCode::Sequence),
        }
    }

    fn allocated(&mut self, last: Allocated) {
        self.allocated = last;
        self.pointer = None;
    }

    /// Adds lists.
    pub fn allocate_lists(&mut self, count: u16) -> Result<(), ErrorCode> {
        self.check(Allocated::Freed, Allocated::Lists)?;
        let length = self.lists.len() + usize::from(count);
        let resized = self.lists.resize(length, List::default());
        resized.map_err(|_| ErrorCode::MemoryOverflow)?;
        self.allocated(Allocated::Lists);
        Ok(())
    }

    /// Gives a list its tables, once.
    pub fn allocate_odts(&mut self, list: u16, count: u8) -> Result<(), ErrorCode> {
        self.check(Allocated::Lists, Allocated::Odts)?;
        if self.list(list)?.odts > 0 {
            return Err(ErrorCode::Sequence);
        }
        if count == 0 || count > MAX_ODTS {
            return Err(ErrorCode::OutOfRange);
        }
        let first = self.odts.len();
        let resized = self.odts.resize(first + usize::from(count), Odt::default());
        resized.map_err(|_| ErrorCode::MemoryOverflow)?;
        let list = self.list_mut(list)?;
        (list.first_odt, list.odts) = (first as u16, count);
        self.allocated(Allocated::Odts);
        Ok(())
    }

    /// Gives a table its entries, once.
    pub fn allocate_entries(&mut self, list: u16, odt: u8, count: u8) -> Result<(), ErrorCode> {
        self.check(Allocated::Odts, Allocated::Entries)?;
        let odt = self.odt_index(list, odt)?;
        let first_entry = self.entries.len();
        let end = first_entry + usize::from(count);
        let odt = self.odts.get_mut(odt).ok_or(ErrorCode::OutOfRange)?;
        if odt.entries > 0 {
            return Err(ErrorCode::Sequence);
        }
        if count == 0 {
            return Err(ErrorCode::OutOfRange);
        }
        let resized = self.entries.resize(end, Entry::default());
        resized.map_err(|_| ErrorCode::MemoryOverflow)?;
        (odt.first_entry, odt.entries) = (first_entry as u16, count);
        self.allocated(Allocated::Entries);
        Ok(())
    }

    pub fn list(&self, list: u16) -> Result<&List, ErrorCode> {
        self.lists
            .get(usize::from(list))
            .ok_or(ErrorCode::OutOfRange)
    }

    pub fn list_mut(&mut self, list: u16) -> Result<&mut List, ErrorCode> {
        self.lists
            .get_mut(usize::from(list))
            .ok_or(ErrorCode::OutOfRange)
    }

    /// Numbers of tables of a list, and of entries of its largest table.
    pub fn size(&self, list: u16) -> Result<(u8, u8), ErrorCode> {
        let odts = self.odts_of(self.list(list)?);
        let entries = odts.iter().map(|odt| odt.entries).max();
        Ok((odts.len() as u8, entries.unwrap_or(0)))
    }

    /// The tables of a list.
    pub fn odts_of(&self, list: &List) -> &[Odt] {
        let first = usize::from(list.first_odt);
        let range = first..first + usize::from(list.odts);
        self.odts.get(range).unwrap_or_default()
    }

    /// The entries of a table.
    pub fn entries_of(&self, odt: &Odt) -> &[Entry] {
        self.entries.get(range(odt)).unwrap_or_default()
    }

    /// Removes the entries of a list, whose tables remain.
    pub fn clear(&mut self, list: u16) -> Result<(), ErrorCode> {
        let list = *self.list(list)?;
        let first = usize::from(list.first_odt);
        for odt in first..first + usize::from(list.odts) {
            let Some(odt) = self.odts.get(odt) else {
                continue;
            };
            if let Some(entries) = self.entries.get_mut(range(odt)) {
                entries.fill(Entry::default());
            }
        }
        Ok(())
    }

    fn odt_index(&self, list: u16, odt: u8) -> Result<usize, ErrorCode> {
        let list = self.list(list)?;
        if odt >= list.odts {
            return Err(ErrorCode::OutOfRange);
        }
        Ok(usize::from(list.first_odt) + usize::from(odt))
    }

    /// Lets WRITE_DAQ write from this entry on.
    pub fn point(&mut self, list: u16, odt: u8, entry: u8) -> Result<(), ErrorCode> {
        let pointer = Pointer { list, odt, entry };
        self.pointed(pointer)?;
        self.pointer = Some(pointer);
        Ok(())
    }

    fn pointed(&self, pointer: Pointer) -> Result<(usize, &Odt), ErrorCode> {
        let odt = self.odt_index(pointer.list, pointer.odt)?;
        let odt = self.odts.get(odt).ok_or(ErrorCode::OutOfRange)?;
        if pointer.entry >= odt.entries {
            return Err(ErrorCode::OutOfRange);
        }
        let entry = usize::from(odt.first_entry) + usize::from(pointer.entry);
        Ok((entry, odt))
    }

    /// Returns the entry under the pointer and moves on.
    pub fn read(&mut self) -> Result<Entry, ErrorCode> {
        let pointer = self.pointer.ok_or(ErrorCode::Sequence)?;
        let (entry, _) = self.pointed(pointer)?;
        self.advance(pointer);
        self.entries
            .get(entry)
            .copied()
            .ok_or(ErrorCode::OutOfRange)
    }

    /// Writes the entry under the pointer and moves on. A packet has at most `max_bytes`.
    pub fn write(&mut self, new: Entry, max_bytes: usize) -> Result<(), ErrorCode> {
        let pointer = self.pointer.ok_or(ErrorCode::Sequence)?;
        let (entry, odt) = self.pointed(pointer)?;
        let before = self.entries.get(entry).copied().unwrap_or_default();
        let bytes = self.bytes_of(odt) - usize::from(before.size) + usize::from(new.size);
        let overhead = match pointer.odt {
            0 => IDENTIFIER_BYTES + TIMESTAMP_BYTES,
            _ => IDENTIFIER_BYTES,
        };
        if overhead + bytes > max_bytes {
            return Err(ErrorCode::DaqConfig);
        }
        if let Some(entry) = self.entries.get_mut(entry) {
            *entry = new;
        }
        self.advance(pointer);
        Ok(())
    }

    /// Moves to the next entry; there is none after the last of a table.
    fn advance(&mut self, pointer: Pointer) {
        let next = pointer
            .entry
            .checked_add(1)
            .map(|entry| Pointer { entry, ..pointer });
        self.pointer = next.filter(|next| self.pointed(*next).is_ok());
    }

    /// Bytes of the entries of a table.
    fn bytes_of(&self, odt: &Odt) -> usize {
        let entries = self.entries_of(odt).iter();
        entries.map(|entry| usize::from(entry.size)).sum()
    }

    /// True if each table of a list has data.
    pub fn is_complete(&self, list: &List) -> bool {
        let odts = self.odts_of(list);
        !odts.is_empty() && odts.iter().all(|odt| self.bytes_of(odt) > 0)
    }
}

fn range(odt: &Odt) -> Range<usize> {
    let first = usize::from(odt.first_entry);
    first..first + usize::from(odt.entries)
}
