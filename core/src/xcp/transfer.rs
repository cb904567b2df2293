//! Commands that move bytes: identification, upload, download and checksums.

use super::mta::{Mta, address};
use super::packet::{Parameters, Response};
use super::protocol::{Command, MAX_CTO};
use super::{ErrorCode, Memory, Slave, Text};
use crate::checksum::continued;

/// Checksum type: CRC-32 as in Ethernet.
const CRC_32: u8 = 0x09;
/// Largest block of BUILD_CHECKSUM, bytes.
const MAX_CHECKSUM_BYTES: u32 = 0x10_0000;

impl<const LISTS: usize, const ODTS: usize, const ENTRIES: usize, const MAX_DTO: usize>
    Slave<LISTS, ODTS, ENTRIES, MAX_DTO>
{
    pub(super) fn transfer(
        &mut self,
        command: Command,
        mut parameters: Parameters,
        memory: &mut impl Memory,
    ) -> Result<Response, ErrorCode> {
        match command {
            Command::GetId => {
                let text = parameters.byte()?;
                Ok(self.identify(text, memory))
            }
            Command::SetMta => {
                parameters.skip(2)?;
                self.mta = Some(Mta::Memory(address(&mut parameters)?));
                Ok(Response::positive())
            }
            Command::Upload => {
                let length = parameters.byte()?;
                self.upload(self.mta, length, memory)
            }
            Command::ShortUpload => {
                let length = parameters.byte()?;
                parameters.skip(1)?;
                let from = Mta::Memory(address(&mut parameters)?);
                self.upload(Some(from), length, memory)
            }
            Command::BuildChecksum => {
                parameters.skip(3)?;
                let length = parameters.double_word()?;
                self.checksum(length, memory)
            }
            Command::Download => {
                let length = parameters.byte()?;
                let bytes = parameters.bytes(length.into())?;
                self.download(self.mta, bytes, memory)
            }
            Command::DownloadMax => {
                let bytes = parameters.bytes(MAX_CTO - 1)?;
                self.download(self.mta, bytes, memory)
            }
            Command::ShortDownload => {
                let length = parameters.byte()?;
                parameters.skip(1)?;
                let to = address(&mut parameters)?;
                let bytes = parameters.bytes(length.into())?;
                self.download(Some(Mta::Memory(to)), bytes, memory)
            }
            _ => Err(ErrorCode::UnknownCommand),
        }
    }

    /// Lets the master upload an identification; its length is 0 if there is none.
    fn identify(&mut self, kind: u8, memory: &impl Memory) -> Response {
        let text = match kind {
            0 => Some(Text::Name),
            1 => Some(Text::A2lName),
            4 => Some(Text::A2l),
            5 => Some(Text::Epk),
            _ => None,
        };
        let length = text.map_or(0, |text| memory.text(text).len() as u32);
        self.mta = text.map(|text| Mta::Text(text, 0));
        Response::with(&[&[0, 0, 0], &length.to_le_bytes()])
    }

    fn upload(
        &mut self,
        from: Option<Mta>,
        length: u8,
        memory: &impl Memory,
    ) -> Result<Response, ErrorCode> {
        let length = usize::from(length);
        if length == 0 || length > MAX_CTO - 1 {
            return Err(ErrorCode::OutOfRange);
        }
        let mta = from.ok_or(ErrorCode::Sequence)?;
        let response = Response::filled(length, |bytes| mta.read(memory, bytes))?;
        self.mta = Some(mta.plus(length));
        Ok(response)
    }

    fn download(
        &mut self,
        to: Option<Mta>,
        bytes: &[u8],
        memory: &mut impl Memory,
    ) -> Result<Response, ErrorCode> {
        if bytes.is_empty() {
            return Err(ErrorCode::OutOfRange);
        }
        match to {
            Some(Mta::Memory(address)) => {
                memory.write(address, bytes)?;
                self.mta = Some(Mta::Memory(address.plus(bytes.len())));
                Ok(Response::positive())
            }
            Some(Mta::Text(..)) => Err(ErrorCode::WriteProtected),
            None => Err(ErrorCode::Sequence),
        }
    }

    fn checksum(&mut self, length: u32, memory: &impl Memory) -> Result<Response, ErrorCode> {
        if length == 0 || length > MAX_CHECKSUM_BYTES {
            return Err(ErrorCode::OutOfRange);
        }
        let mut mta = self.mta.ok_or(ErrorCode::Sequence)?;
        let (mut crc, mut left) = (0, length as usize);
        let mut block = [0; 64];
        while left > 0 {
            let length = left.min(block.len());
            let bytes = block.get_mut(..length).unwrap_or_default();
            mta.read(memory, bytes)?;
            crc = continued(crc, bytes);
            mta = mta.plus(length);
            left -= length;
        }
        self.mta = Some(mta);
        Ok(Response::with(&[&[CRC_32, 0, 0], &crc.to_le_bytes()]))
    }
}
