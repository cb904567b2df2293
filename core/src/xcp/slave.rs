//! The slave: one session, and which command is executed where.

use super::daq::Daq;
use super::mta::Mta;
use super::packet::{Parameters, Response};
use super::protocol::{COMM_MODE_BASIC, Command, MAX_CTO, VERSION, resource};
use super::{ErrorCode, Memory};

/// Session status: a DAQ list is running.
const DAQ_RUNNING: u8 = 0x40;

/// Slave with room for so many DAQ lists, tables in all lists, entries in all tables, and bytes in a packet of samples.
#[derive(Clone, Debug)]
pub struct Slave<const LISTS: usize, const ODTS: usize, const ENTRIES: usize, const MAX_DTO: usize>
{
    is_connected: bool,
    pub(super) mta: Option<Mta>,
    pub(super) daq: Daq<LISTS, ODTS, ENTRIES>,
}

impl<const LISTS: usize, const ODTS: usize, const ENTRIES: usize, const MAX_DTO: usize> Default
    for Slave<LISTS, ODTS, ENTRIES, MAX_DTO>
{
    fn default() -> Self {
        Self::new()
    }
}

impl<const LISTS: usize, const ODTS: usize, const ENTRIES: usize, const MAX_DTO: usize>
    Slave<LISTS, ODTS, ENTRIES, MAX_DTO>
{
    /// A slave without a master.
    pub const fn new() -> Self {
        Self {
            is_connected: false,
            mta: None,
            daq: Daq::new(),
        }
    }

    /// True if a master is connected.
    pub fn is_connected(&self) -> bool {
        self.is_connected
    }

    /// True if a DAQ list is running.
    pub fn is_measuring(&self) -> bool {
        self.daq.is_running()
    }

    /// Ends the session, because its master is gone.
    pub fn disconnect(&mut self) {
        *self = Self::new();
    }

    /// Executes a command packet and returns the response. Without a session, everything but CONNECT is ignored, as the
    /// standard wants it. A refused command changes nothing, but a refused WRITE_DAQ_MULTIPLE has written the entries
    /// before the wrong one.
    pub fn receive(&mut self, packet: &[u8], memory: &mut impl Memory) -> Option<Response> {
        let (code, parameters) = packet.split_first()?;
        let command = Command::from_code(*code);
        if !self.is_connected && command != Some(Command::Connect) {
            return None;
        }
        let executed = match command {
            Some(command) => self.execute(command, Parameters(parameters), memory),
            None => Err(ErrorCode::UnknownCommand),
        };
        Some(executed.unwrap_or_else(Response::error))
    }

    fn execute(
        &mut self,
        command: Command,
        parameters: Parameters,
        memory: &mut impl Memory,
    ) -> Result<Response, ErrorCode> {
        match command {
            Command::Connect => Ok(self.connect(memory)),
            Command::Disconnect => {
                self.disconnect();
                Ok(Response::positive())
            }
            Command::GetStatus => {
                let status = if self.is_measuring() { DAQ_RUNNING } else { 0 };
                // No protected resource, no state number, no configuration.
                Ok(Response::with(&[&[status, 0, 0, 0, 0]]))
            }
            Command::Synch => Err(ErrorCode::Synch),
            Command::GetCommModeInfo => {
                // No block mode and no queue; version 1.0 of this driver.
                Ok(Response::with(&[&[0, 0, 0, 0, 0, 0, 0x10]]))
            }
            Command::GetId
            | Command::SetMta
            | Command::Upload
            | Command::ShortUpload
            | Command::BuildChecksum
            | Command::Download
            | Command::DownloadMax
            | Command::ShortDownload => self.transfer(command, parameters, memory),
            Command::SetCalPage
            | Command::GetCalPage
            | Command::GetPagProcessorInfo
            | Command::GetSegmentInfo
            | Command::GetPageInfo
            | Command::CopyCalPage => super::calibration::execute(command, parameters, memory),
            _ => self.daq(command, parameters, memory),
        }
    }

    fn connect(&mut self, memory: &impl Memory) -> Response {
        self.disconnect();
        self.is_connected = true;
        let resources = match memory.segment() {
            Some(_) => resource::DAQ | resource::CALIBRATION,
            None => resource::DAQ,
        };
        let basic = [resources, COMM_MODE_BASIC, MAX_CTO as u8];
        let max_dto = (MAX_DTO as u16).to_le_bytes();
        Response::with(&[&basic, &max_dto, &[VERSION, VERSION]])
    }
}
