//! Memory of the slave: the values of the last tick, pages of parameters, and texts.

use dashpot_core::xcp::{Address, ErrorCode, Event, Memory, Page, Segment, Text};

use super::Parameters;
use crate::a2l::layout::{EPK, MEASUREMENTS, PARAMETERS, VALUE_BYTES};
use crate::a2l::{Description, write};

/// Memory of a slave.
pub struct Image<P> {
    measured: Vec<u8>,
    clock_us: u32,
    parameters: P,
    /// The page that the master reads and writes.
    page: u8,
    segment: Option<Segment>,
    event: Event,
    event_name: &'static str,
    name: String,
    a2l: String,
    epk: String,
}

impl<P: Parameters> Image<P> {
    /// The memory of a slave before the first tick, with all measured values zero.
    pub fn new(slave: &Description, parameters: P) -> Self {
        let (cycle, unit) = slave.cycle();
        let pages = parameters.pages();
        let length = VALUE_BYTES * parameters.values(0).len() as u32;
        Self {
            measured: vec![0; VALUE_BYTES as usize * slave.measurements.len()],
            clock_us: 0,
            page: parameters.page(),
            segment: (pages > 0 && length > 0).then_some(Segment {
                address: PARAMETERS,
                length,
                pages,
            }),
            parameters,
            event: Event { cycle, unit },
            event_name: slave.event,
            name: slave.name.clone(),
            a2l: write(slave),
            epk: slave.epk(),
        }
    }

    /// Takes the values of a tick that ended at `time_s`.
    pub fn update(&mut self, time_s: f64, values: &[f64]) {
        let bytes = self.measured.chunks_exact_mut(VALUE_BYTES as usize);
        for (bytes, value) in bytes.zip(values) {
            bytes.copy_from_slice(&value.to_le_bytes());
        }
        // A time stamp wraps around after 71 minutes.
        self.clock_us = (time_s * 1e6).round() as i64 as u32;
        self.parameters.tick(time_s);
    }
}

/// Copies the bytes of `memory`, which begins at address `first`; `None` if it does not contain all of them.
fn copy(memory: &[u8], first: u32, address: u32, into: &mut [u8]) -> Option<()> {
    let start = usize::try_from(address.checked_sub(first)?).ok()?;
    into.copy_from_slice(memory.get(start..start.checked_add(into.len())?)?);
    Some(())
}

/// Copies the bytes of values, beginning with byte `start`.
fn copy_values(values: &[f64], start: usize, into: &mut [u8]) -> Option<()> {
    let bytes = VALUE_BYTES as usize;
    for (index, byte) in into.iter_mut().enumerate() {
        let at = start + index;
        *byte = *values.get(at / bytes)?.to_le_bytes().get(at % bytes)?;
    }
    Some(())
}

impl<P: Parameters> Memory for Image<P> {
    fn read(&self, address: Address, into: &mut [u8]) -> Result<(), ErrorCode> {
        let Address { extension, offset } = address;
        let read = match offset {
            _ if extension != 0 => None,
            EPK.. => copy(self.epk.as_bytes(), EPK, offset, into),
            PARAMETERS.. => {
                let start = (offset - PARAMETERS) as usize;
                copy_values(self.parameters.values(self.page), start, into)
            }
            _ => copy(&self.measured, MEASUREMENTS, offset, into),
        };
        read.ok_or(ErrorCode::AccessDenied)
    }

    fn write(&mut self, address: Address, bytes: &[u8]) -> Result<(), ErrorCode> {
        // Only what can be read can be protected.
        self.read(address, &mut vec![0; bytes.len()])?;
        if self.segment.is_none() || !(PARAMETERS..EPK).contains(&address.offset) {
            return Err(ErrorCode::WriteProtected);
        }
        let start = address.offset - PARAMETERS;
        let (values, rest) = bytes.as_chunks();
        // A part of a number is no number.
        if !start.is_multiple_of(VALUE_BYTES) || !rest.is_empty() {
            return Err(ErrorCode::OutOfRange);
        }
        let values: Vec<f64> = values
            .iter()
            .map(|bytes| f64::from_le_bytes(*bytes))
            .collect();
        let first = (start / VALUE_BYTES) as usize;
        self.parameters.write(self.page, first, &values)
    }

    fn text(&self, text: Text) -> &[u8] {
        match text {
            Text::Name | Text::A2lName => self.name.as_bytes(),
            Text::A2l => self.a2l.as_bytes(),
            Text::Epk => self.epk.as_bytes(),
            Text::Event(0) => self.event_name.as_bytes(),
            Text::Event(_) => &[],
        }
    }

    fn clock_us(&self) -> u32 {
        self.clock_us
    }

    fn event(&self, channel: u16) -> Option<Event> {
        (channel == 0).then_some(self.event)
    }

    fn segment(&self) -> Option<Segment> {
        self.segment
    }

    fn page(&self, of: Page) -> u8 {
        match of {
            Page::Model => self.parameters.page(),
            Page::Master => self.page,
        }
    }

    fn set_page(&mut self, of: Page, page: u8) -> Result<(), ErrorCode> {
        match of {
            Page::Model => self.parameters.use_page(page),
            Page::Master => {
                self.page = page;
                Ok(())
            }
        }
    }

    fn copy_page(&mut self, from: u8, to: u8) -> Result<(), ErrorCode> {
        let values = self.parameters.values(from).to_vec();
        self.parameters.write(to, 0, &values)
    }
}
