//! Sampling of the running DAQ lists.

use super::daq::List;
use super::{Memory, Slave};

impl<const LISTS: usize, const ODTS: usize, const ENTRIES: usize, const MAX_DTO: usize>
    Slave<LISTS, ODTS, ENTRIES, MAX_DTO>
{
    /// Samples the running lists of an event channel. `send` gets the packets, each of at most `MAX_DTO` bytes. Returns
    /// their number.
    ///
    /// A packet has the number of the table, the number of the list, in the first table the time stamp, and the data.
    /// The cost depends only on the lists that run.
    pub fn sample(
        &mut self,
        event: u16,
        memory: &impl Memory,
        mut send: impl FnMut(&[u8]),
    ) -> usize {
        let mut sent = 0;
        for number in 0..self.daq.lists.len() {
            let Some(list) = self.daq.lists.get_mut(number) else {
                continue;
            };
            if !list.is_running || list.mode.event != event {
                continue;
            }
            list.events += 1;
            if list.events < list.mode.prescaler {
                continue;
            }
            list.events = 0;
            let list = *list;
            sent += self.sample_list(number as u8, &list, memory, &mut send);
        }
        sent
    }

    fn sample_list(
        &self,
        number: u8,
        list: &List,
        memory: &impl Memory,
        send: &mut impl FnMut(&[u8]),
    ) -> usize {
        let odts = self.daq.odts_of(list);
        let mut packet = [0; MAX_DTO];
        for (index, odt) in odts.iter().enumerate() {
            let mut length = put(&mut packet, 0, &[index as u8, number]);
            if index == 0 {
                length = put(&mut packet, length, &memory.clock_us().to_le_bytes());
            }
            // WRITE_DAQ has checked that the entries fit and can be read.
            for entry in self.daq.entries_of(odt) {
                let end = length + usize::from(entry.size);
                if let Some(bytes) = packet.get_mut(length..end) {
                    let _is_readable = memory.read(entry.address, bytes);
                    length = end;
                }
            }
            send(packet.get(..length).unwrap_or_default());
        }
        odts.len()
    }
}

/// Writes bytes into a packet from `start` on. Returns where they end.
fn put(packet: &mut [u8], start: usize, bytes: &[u8]) -> usize {
    let end = start + bytes.len();
    if let Some(to) = packet.get_mut(start..end) {
        to.copy_from_slice(bytes);
    }
    end
}
