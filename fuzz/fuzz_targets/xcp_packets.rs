//! Receives messages of XCP on Ethernet. The slave answers or ignores each, and samples its lists in between.
#![no_main]

use dashpot_core::xcp::ethernet::split;
use dashpot_core::xcp::{Address, ErrorCode, Event, MAX_CTO, Memory, Page, Segment, Slave, Text};
use libfuzzer_sys::fuzz_target;

/// Largest packet of samples.
const MAX_DTO: usize = 64;

/// 64 bytes on each of two pages, beginning at address 0.
struct Pages {
    bytes: [[u8; 64]; 2],
    pages: [u8; 2],
}

impl Memory for Pages {
    fn read(&self, address: Address, into: &mut [u8]) -> Result<(), ErrorCode> {
        let start = address.offset as usize;
        let bytes = self.bytes[usize::from(self.pages[1])].get(start..start + into.len());
        into.copy_from_slice(bytes.ok_or(ErrorCode::AccessDenied)?);
        Ok(())
    }
    fn write(&mut self, address: Address, bytes: &[u8]) -> Result<(), ErrorCode> {
        let start = address.offset as usize;
        let page = &mut self.bytes[usize::from(self.pages[1])];
        let to = page.get_mut(start..start + bytes.len());
        to.ok_or(ErrorCode::AccessDenied)?.copy_from_slice(bytes);
        Ok(())
    }
    fn text(&self, _: Text) -> &[u8] {
        b"text"
    }
    fn event(&self, channel: u16) -> Option<Event> {
        (channel < 2).then_some(Event { cycle: 1, unit: 6 })
    }
    fn segment(&self) -> Option<Segment> {
        Some(Segment {
            address: 0,
            length: 64,
            pages: 2,
        })
    }
    fn page(&self, of: Page) -> u8 {
        self.pages[of as usize]
    }
    fn set_page(&mut self, of: Page, page: u8) -> Result<(), ErrorCode> {
        self.pages[of as usize] = page;
        Ok(())
    }
    fn copy_page(&mut self, from: u8, to: u8) -> Result<(), ErrorCode> {
        self.bytes[usize::from(to)] = self.bytes[usize::from(from)];
        Ok(())
    }
}

fuzz_target!(|bytes: &[u8]| {
    let mut memory = Pages {
        bytes: [[0; 64]; 2],
        pages: [0; 2],
    };
    let mut slave = Slave::<4, 8, 16, MAX_DTO>::new();
    let mut rest = bytes;
    while let Some((packet, next)) = split(rest) {
        if let Some(response) = slave.receive(packet, &mut memory) {
            assert!(response.len() <= MAX_CTO && response[0] >= 0xFE);
        }
        for event in 0..2 {
            slave.sample(event, &memory, |packet| {
                assert!(packet.len() <= MAX_DTO && packet[0] < 0xFC);
            });
        }
        rest = next;
    }
});
