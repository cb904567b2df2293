//! Reads command packets and writes responses.

use core::ops::Deref;

use super::ErrorCode;
use super::protocol::{ERROR, MAX_CTO, POSITIVE};

/// Parameters of a command, read from the front.
pub(super) struct Parameters<'a>(pub &'a [u8]);

impl<'a> Parameters<'a> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], ErrorCode> {
        let (bytes, rest) = self.0.split_first_chunk().ok_or(ErrorCode::Syntax)?;
        self.0 = rest;
        Ok(*bytes)
    }

    pub fn byte(&mut self) -> Result<u8, ErrorCode> {
        self.take::<1>().map(|[byte]| byte)
    }

    pub fn word(&mut self) -> Result<u16, ErrorCode> {
        self.take().map(u16::from_le_bytes)
    }

    pub fn double_word(&mut self) -> Result<u32, ErrorCode> {
        self.take().map(u32::from_le_bytes)
    }

    pub fn skip(&mut self, bytes: usize) -> Result<(), ErrorCode> {
        self.0 = self.0.get(bytes..).ok_or(ErrorCode::Syntax)?;
        Ok(())
    }

    /// Takes a number of bytes.
    pub fn bytes(&mut self, length: usize) -> Result<&'a [u8], ErrorCode> {
        let (bytes, rest) = self.0.split_at_checked(length).ok_or(ErrorCode::Syntax)?;
        self.0 = rest;
        Ok(bytes)
    }
}

/// Response to a command: the bytes of a packet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Response(heapless::Vec<u8, MAX_CTO>);

impl Response {
    /// A positive response without data.
    pub(super) fn positive() -> Self {
        let mut response = Self(heapless::Vec::new());
        response.push(&[POSITIVE]);
        response
    }

    pub(super) fn error(code: ErrorCode) -> Self {
        let mut response = Self(heapless::Vec::new());
        response.push(&[ERROR, code as u8]);
        response
    }

    /// A positive response with data.
    pub(super) fn with(parts: &[&[u8]]) -> Self {
        let mut response = Self::positive();
        parts.iter().for_each(|part| response.push(part));
        response
    }

    /// A positive response with `length` bytes, which `fill` writes.
    pub(super) fn filled(
        length: usize,
        fill: impl FnOnce(&mut [u8]) -> Result<(), ErrorCode>,
    ) -> Result<Self, ErrorCode> {
        let mut response = Self::positive();
        response
            .0
            .resize(1 + length, 0)
            .map_err(|_| ErrorCode::OutOfRange)?;
        fill(response.0.get_mut(1..).unwrap_or_default())?;
        Ok(response)
    }

    /// Adds bytes. Every response is shorter than the largest packet.
    fn push(&mut self, bytes: &[u8]) {
        let _fits = self.0.extend_from_slice(bytes);
    }
}

impl Deref for Response {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.0
    }
}
