//! Error codes of the standard.

/// Why a command is refused, with the code of the standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[repr(u8)]
pub enum ErrorCode {
    /// Answer to SYNCH.
    #[error("command processor synchronised")]
    Synch = 0x00,
    /// The command was not executed; send it again.
    #[error("the command processor is busy")]
    Busy = 0x10,
    /// A DAQ list is running.
    #[error("a DAQ list is running")]
    DaqActive = 0x11,
    /// Unknown command, or an optional one that this slave does not have.
    #[error("unknown command")]
    UnknownCommand = 0x20,
    /// The packet is too short for its command.
    #[error("the packet is too short for its command")]
    Syntax = 0x21,
    /// A parameter of the command is out of range.
    #[error("a parameter is out of range")]
    OutOfRange = 0x22,
    /// The memory is read-only.
    #[error("the memory is write-protected")]
    WriteProtected = 0x23,
    /// There is nothing at this address.
    #[error("the address is not accessible")]
    AccessDenied = 0x24,
    /// There is no such page.
    #[error("no such page")]
    PageNotValid = 0x26,
    /// There is no such mode.
    #[error("no such mode")]
    ModeNotValid = 0x27,
    /// There is no such segment.
    #[error("no such segment")]
    SegmentNotValid = 0x28,
    /// The command does not follow the one that it needs.
    #[error("the command is out of sequence")]
    Sequence = 0x29,
    /// A DAQ list is empty or too large.
    #[error("the DAQ list is empty or too large")]
    DaqConfig = 0x2A,
    /// There is no memory for so many DAQ lists, tables or entries.
    #[error("out of memory for DAQ lists")]
    MemoryOverflow = 0x30,
    /// Any other error.
    #[error("generic error")]
    Generic = 0x31,
}
