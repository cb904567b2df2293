//! Numbers of the standard: commands, packet identifiers and sizes.

/// Largest command and response packet, bytes.
pub const MAX_CTO: usize = 248;

/// First byte of an event packet.
pub const EVENT_PACKET: u8 = 0xFD;
/// Event: samples of a DAQ list were lost because the slave was too slow; the number of the event channel follows.
pub const EV_DAQ_OVERLOAD: u8 = 0x06;
/// Event: the slave has ended the session.
pub const EV_SESSION_TERMINATED: u8 = 0x07;

/// First byte of a positive response.
pub(super) const POSITIVE: u8 = 0xFF;
/// First byte of an error packet.
pub(super) const ERROR: u8 = 0xFE;

/// Major version of protocol layer and transport layer.
pub(super) const VERSION: u8 = 1;

/// Resources in the response to CONNECT.
pub(super) mod resource {
    pub const CALIBRATION: u8 = 0x01;
    pub const DAQ: u8 = 0x04;
}

/// Intel byte order, byte addresses, and GET_COMM_MODE_INFO has more.
pub(super) const COMM_MODE_BASIC: u8 = 0x80;

macro_rules! commands {
    ($($name:ident = $code:literal),* $(,)?) => {
        /// Commands of the standard that the slave executes, by their codes.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u8)]
        #[expect(missing_docs, reason = "the names are those of the standard")]
        pub enum Command {
            $($name = $code),*
        }

        impl Command {
            /// All commands.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            /// Returns the command with this code, the first byte of a packet.
            pub fn from_code(code: u8) -> Option<Self> {
                match code {
                    $($code => Some(Self::$name),)*
                    _ => None,
                }
            }
        }
    };
}

commands! {
    Connect = 0xFF,
    Disconnect = 0xFE,
    GetStatus = 0xFD,
    Synch = 0xFC,
    GetCommModeInfo = 0xFB,
    GetId = 0xFA,
    SetMta = 0xF6,
    Upload = 0xF5,
    ShortUpload = 0xF4,
    BuildChecksum = 0xF3,
    Download = 0xF0,
    DownloadMax = 0xEE,
    ShortDownload = 0xED,
    SetCalPage = 0xEB,
    GetCalPage = 0xEA,
    GetPagProcessorInfo = 0xE9,
    GetSegmentInfo = 0xE8,
    GetPageInfo = 0xE7,
    CopyCalPage = 0xE4,
    ClearDaqList = 0xE3,
    SetDaqPtr = 0xE2,
    WriteDaq = 0xE1,
    SetDaqListMode = 0xE0,
    GetDaqListMode = 0xDF,
    StartStopDaqList = 0xDE,
    StartStopSynch = 0xDD,
    GetDaqClock = 0xDC,
    ReadDaq = 0xDB,
    GetDaqProcessorInfo = 0xDA,
    GetDaqResolutionInfo = 0xD9,
    GetDaqListInfo = 0xD8,
    GetDaqEventInfo = 0xD7,
    FreeDaq = 0xD6,
    AllocDaq = 0xD5,
    AllocOdt = 0xD4,
    AllocOdtEntry = 0xD3,
    WriteDaqMultiple = 0xC7,
}
