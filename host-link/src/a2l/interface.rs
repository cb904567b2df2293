//! How a tool reaches the slave: segments and pages of its memory, protocol, event and transports.

use std::fmt::{self, Write};
use std::net::IpAddr;

use dashpot_core::xcp::{Command, MAX_CTO};

use super::layout::{EPK, PARAMETERS, VALUE_BYTES};
use super::{Description, quoted};

/// Version of the protocol layer and of the transport layers: 1.1.
const VERSION: &str = "0x0101";

/// Commands that the standard does not call optional.
const NOT_OPTIONAL: [Command; 4] = [
    Command::Connect,
    Command::Disconnect,
    Command::GetStatus,
    Command::Synch,
];

/// Writes the parameters of the module: version of the layout, and the calibration segment with its pages.
pub(super) fn write_memory(out: &mut String, slave: &Description) -> fmt::Result {
    let epk = slave.epk();
    writeln!(
        out,
        "/begin MOD_COMMON \"\"\n  BYTE_ORDER MSB_LAST\n  ALIGNMENT_FLOAT64_IEEE 8\n/end MOD_COMMON"
    )?;
    writeln!(
        out,
        "/begin MOD_PAR \"\"\n  ADDR_EPK {EPK:#010x}\n  EPK \"{epk}\""
    )?;
    if !slave.parameters.is_empty() {
        let bytes = VALUE_BYTES * slave.parameters.len() as u32;
        let pages = slave.pages.len();
        writeln!(
            out,
            "  /begin MEMORY_SEGMENT parameters {} DATA RAM INTERN {PARAMETERS:#010x} {bytes:#x} -1 -1 -1 -1 -1\n    \
             /begin IF_DATA XCP /begin SEGMENT 0 {pages} 0 0 0\n      \
             /begin CHECKSUM XCP_CRC_32 MAX_BLOCK_SIZE 0x100000 /end CHECKSUM",
            quoted(&format!("pages: {}", slave.pages.join(", ")))
        )?;
        for page in 0..pages {
            writeln!(
                out,
                "      /begin PAGE {page} ECU_ACCESS_DONT_CARE XCP_READ_ACCESS_DONT_CARE \
                 XCP_WRITE_ACCESS_DONT_CARE /end PAGE"
            )?;
        }
        writeln!(out, "    /end SEGMENT /end IF_DATA\n  /end MEMORY_SEGMENT")?;
    }
    writeln!(out, "/end MOD_PAR")
}

/// Writes the protocol: its limits, commands, event and transports.
pub(super) fn write_protocol(out: &mut String, slave: &Description) -> fmt::Result {
    let max_dto = slave.max_dto;
    writeln!(
        out,
        "/begin IF_DATA XCP\n  /begin PROTOCOL_LAYER {VERSION} 2000 2000 2000 2000 2000 2000 2000 {MAX_CTO} \
         {max_dto} BYTE_ORDER_MSB_LAST ADDRESS_GRANULARITY_BYTE"
    )?;
    for command in Command::ALL {
        if !NOT_OPTIONAL.contains(command) {
            writeln!(out, "    OPTIONAL_CMD {}", standard_name(*command))?;
        }
    }
    let (cycle, unit) = slave.cycle();
    let (event, short) = (quoted(slave.event), slave.event);
    let short: String = short.chars().take(8).collect();
    writeln!(
        out,
        "  /end PROTOCOL_LAYER\n  \
         /begin DAQ DYNAMIC 0 1 0 OPTIMISATION_TYPE_DEFAULT ADDRESS_EXTENSION_FREE \
         IDENTIFICATION_FIELD_TYPE_RELATIVE_BYTE\n    \
         GRANULARITY_ODT_ENTRY_SIZE_DAQ_BYTE 248 OVERLOAD_INDICATION_EVENT PRESCALER_SUPPORTED\n    \
         /begin TIMESTAMP_SUPPORTED 1 SIZE_DWORD UNIT_1US TIMESTAMP_FIXED /end TIMESTAMP_SUPPORTED\n    \
         /begin EVENT {event} {} 0 DAQ 0xFF {cycle} {unit} 0 CONSISTENCY EVENT /end EVENT\n  \
         /end DAQ",
        quoted(&short)
    )?;
    if !slave.parameters.is_empty() {
        writeln!(out, "  /begin PAG 1 /end PAG")?;
    }
    let (address, port) = (slave.address.ip(), slave.address.port());
    let tag = match address {
        IpAddr::V4(_) => "ADDRESS",
        IpAddr::V6(_) => "IPV6",
    };
    for transport in ["XCP_ON_TCP_IP", "XCP_ON_UDP_IP"] {
        writeln!(
            out,
            "  /begin {transport} {VERSION} {port} {tag} \"{address}\" /end {transport}"
        )?;
    }
    writeln!(out, "/end IF_DATA")
}

/// Name of a command in the standard: that of its code in capital letters.
fn standard_name(command: Command) -> String {
    let mut name = String::new();
    for letter in format!("{command:?}").chars() {
        if letter.is_ascii_uppercase() && !name.is_empty() {
            name.push('_');
        }
        name.push(letter.to_ascii_uppercase());
    }
    name
}
