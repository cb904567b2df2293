//! Commands of DAQ lists.

use super::daq::{Entry, Mode};
use super::mta::{Mta, address};
use super::packet::{Parameters, Response};
use super::protocol::Command;
use super::{Address, ErrorCode, Memory, Slave, Text};

/// Properties of the DAQ processor: dynamic lists, prescaler, time stamps, overload shown by an event.
const DAQ_PROPERTIES: u8 = 0x01 | 0x02 | 0x10 | 0x80;
/// Tables are numbered within their list, whose number is a byte.
const KEY_BYTE: u8 = 0x40;
/// Time stamps: 4 bytes, always there, 1 us.
const TIMESTAMP_MODE: u8 = 0x04 | 0x08 | 0x30;
/// Properties of an event channel: for measurement, consistent over all its lists.
const EVENT_PROPERTIES: u8 = 0x04 | 0x80;
/// A list for measurement.
const LIST_PROPERTIES: u8 = 0x04;
/// Modes of a list.
const MODE_TIMESTAMP: u8 = 0x10;
const MODE_SELECTED: u8 = 0x01;
const MODE_RUNNING: u8 = 0x40;
/// Any number of lists of one channel.
const ANY_LISTS: u8 = 0xFF;
/// Largest entry, bytes.
const MAX_ENTRY_BYTES: u8 = 248;
/// WRITE_DAQ: no single bits.
const NO_BIT: u8 = 0xFF;

impl<const LISTS: usize, const ODTS: usize, const ENTRIES: usize, const MAX_DTO: usize>
    Slave<LISTS, ODTS, ENTRIES, MAX_DTO>
{
    pub(super) fn daq(
        &mut self,
        command: Command,
        mut parameters: Parameters,
        memory: &mut impl Memory,
    ) -> Result<Response, ErrorCode> {
        match command {
            Command::GetDaqClock => {
                let clock = memory.clock_us().to_le_bytes();
                Ok(Response::with(&[&[0; 3], &clock]))
            }
            Command::GetDaqProcessorInfo => {
                let lists = (self.daq.lists.len() as u16).to_le_bytes();
                let channels =
                    (0..=u16::MAX).take_while(|channel| memory.event(*channel).is_some());
                let channels = (channels.count() as u16).to_le_bytes();
                Ok(Response::with(&[
                    &[DAQ_PROPERTIES],
                    &lists,
                    &channels,
                    &[0, KEY_BYTE],
                ]))
            }
            Command::GetDaqResolutionInfo => {
                // A time stamp counts single microseconds.
                let sizes = [1, MAX_ENTRY_BYTES, 1, 0, TIMESTAMP_MODE, 1, 0];
                Ok(Response::with(&[&sizes]))
            }
            Command::GetDaqEventInfo => {
                parameters.skip(1)?;
                let channel = parameters.word()?;
                let event = memory.event(channel).ok_or(ErrorCode::OutOfRange)?;
                let name = Text::Event(channel);
                self.mta = Some(Mta::Text(name, 0));
                let length = memory.text(name).len() as u8;
                let properties = [EVENT_PROPERTIES, ANY_LISTS, length];
                Ok(Response::with(&[
                    &properties,
                    &[event.cycle, event.unit, 0],
                ]))
            }
            Command::GetDaqListInfo => {
                parameters.skip(1)?;
                let (odts, entries) = self.daq.size(parameters.word()?)?;
                Ok(Response::with(&[&[LIST_PROPERTIES, odts, entries, 0, 0]]))
            }
            Command::GetDaqListMode => {
                parameters.skip(1)?;
                let list = self.daq.list(parameters.word()?)?;
                let mut mode = MODE_TIMESTAMP;
                mode |= if list.is_selected { MODE_SELECTED } else { 0 };
                mode |= if list.is_running { MODE_RUNNING } else { 0 };
                let event = list.mode.event.to_le_bytes();
                let prescaler = [list.mode.prescaler, list.mode.priority];
                Ok(Response::with(&[&[mode, 0, 0], &event, &prescaler]))
            }
            Command::StartStopDaqList => {
                let mode = parameters.byte()?;
                self.start_stop(mode, parameters.word()?)?;
                // Tables are numbered within their list.
                Ok(Response::with(&[&[0]]))
            }
            Command::StartStopSynch => {
                self.start_stop_all(parameters.byte()?)?;
                Ok(Response::positive())
            }
            _ => self.configure(command, parameters, memory),
        }
    }

    /// Commands that change lists, which must not run.
    fn configure(
        &mut self,
        command: Command,
        mut parameters: Parameters,
        memory: &impl Memory,
    ) -> Result<Response, ErrorCode> {
        if self.is_measuring() {
            return Err(ErrorCode::DaqActive);
        }
        match command {
            Command::FreeDaq => self.daq.free(),
            Command::AllocDaq => {
                parameters.skip(1)?;
                self.daq.allocate_lists(parameters.word()?)?;
            }
            Command::AllocOdt => {
                parameters.skip(1)?;
                let list = parameters.word()?;
                self.daq.allocate_odts(list, parameters.byte()?)?;
            }
            Command::AllocOdtEntry => {
                parameters.skip(1)?;
                let (list, odt) = (parameters.word()?, parameters.byte()?);
                self.daq.allocate_entries(list, odt, parameters.byte()?)?;
            }
            Command::ClearDaqList => {
                parameters.skip(1)?;
                self.daq.clear(parameters.word()?)?;
            }
            Command::SetDaqPtr => {
                parameters.skip(1)?;
                let (list, odt) = (parameters.word()?, parameters.byte()?);
                self.daq.point(list, odt, parameters.byte()?)?;
            }
            Command::WriteDaq => {
                let [bit, size] = [parameters.byte()?, parameters.byte()?];
                let entry = checked_entry(bit, size, address(&mut parameters)?, memory)?;
                self.daq.write(entry, MAX_DTO)?;
            }
            Command::WriteDaqMultiple => self.write_several(parameters, memory)?,
            Command::ReadDaq => {
                let Entry { address, size } = self.daq.read()?;
                let entry = [NO_BIT, size, address.extension];
                return Ok(Response::with(&[&entry, &address.offset.to_le_bytes()]));
            }
            Command::SetDaqListMode => self.set_mode(parameters, memory)?,
            _ => return Err(ErrorCode::UnknownCommand),
        }
        Ok(Response::positive())
    }

    fn write_several(
        &mut self,
        mut parameters: Parameters,
        memory: &impl Memory,
    ) -> Result<(), ErrorCode> {
        for _ in 0..parameters.byte()? {
            let [bit, size] = [parameters.byte()?, parameters.byte()?];
            let offset = parameters.double_word()?;
            let extension = parameters.byte()?;
            let address = Address { extension, offset };
            let entry = checked_entry(bit, size, address, memory)?;
            self.daq.write(entry, MAX_DTO)?;
            // The padding of the last element may be left out.
            let _padding = parameters.skip(1);
        }
        Ok(())
    }

    fn set_mode(
        &mut self,
        mut parameters: Parameters,
        memory: &impl Memory,
    ) -> Result<(), ErrorCode> {
        let mode = parameters.byte()?;
        let (list, event) = (parameters.word()?, parameters.word()?);
        let [prescaler, priority] = [parameters.byte()?, parameters.byte()?];
        let list = self.daq.list_mut(list)?;
        // Stimulation, alternating lists and packets without identifiers are not supported.
        if mode & !MODE_TIMESTAMP != 0 {
            return Err(ErrorCode::ModeNotValid);
        }
        if memory.event(event).is_none() || prescaler == 0 {
            return Err(ErrorCode::OutOfRange);
        }
        list.mode = Mode {
            event,
            prescaler,
            priority,
        };
        Ok(())
    }

    /// Stops (0), starts (1) or selects (2) a list.
    fn start_stop(&mut self, mode: u8, number: u16) -> Result<(), ErrorCode> {
        let list = *self.daq.list(number)?;
        let is_complete = self.daq.is_complete(&list);
        let list = self.daq.list_mut(number)?;
        match mode {
            0 => (list.is_running, list.is_selected) = (false, false),
            1 | 2 if !is_complete || list.mode.prescaler == 0 => return Err(ErrorCode::DaqConfig),
            1 => (list.is_running, list.events) = (true, 0),
            2 => list.is_selected = true,
            _ => return Err(ErrorCode::ModeNotValid),
        }
        Ok(())
    }

    /// Stops all lists (0), or starts (1) or stops (2) the selected ones.
    fn start_stop_all(&mut self, mode: u8) -> Result<(), ErrorCode> {
        if mode > 2 {
            return Err(ErrorCode::ModeNotValid);
        }
        for list in &mut self.daq.lists {
            match mode {
                0 => list.is_running = false,
                _ if !list.is_selected => continue,
                1 => (list.is_running, list.events) = (true, 0),
                _ => list.is_running = false,
            }
            list.is_selected = false;
        }
        Ok(())
    }
}

/// Checks an entry of a list.
fn checked_entry(
    bit: u8,
    size: u8,
    address: Address,
    memory: &impl Memory,
) -> Result<Entry, ErrorCode> {
    let mut bytes = [0; MAX_ENTRY_BYTES as usize];
    let bytes = bytes.get_mut(..size.into());
    let bytes = bytes.filter(|bytes| !bytes.is_empty() && bit == NO_BIT);
    memory.read(address, bytes.ok_or(ErrorCode::OutOfRange)?)?;
    Ok(Entry { address, size })
}
