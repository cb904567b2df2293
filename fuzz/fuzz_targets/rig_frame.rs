//! Reads any bytes as a datagram of a rig. Either they are refused, or they come back.
//!
//! Mutated datagrams never have a correct CRC-32, so the same bytes are read again with a corrected one.
#![no_main]

use dashpot_core::crc_32;
use dashpot_core::hybrid::wire::{FRAME_BYTES, Frame};
use libfuzzer_sys::fuzz_target;

fn check(bytes: &[u8]) {
    let Ok(frame) = Frame::from_bytes(bytes) else {
        return;
    };
    assert_eq!(Frame::from_bytes(&frame.to_bytes()), Ok(frame));
}

fuzz_target!(|bytes: &[u8]| {
    check(bytes);
    if let Some(fields) = bytes.get(..FRAME_BYTES - 4) {
        check(&[fields, &crc_32(fields).to_le_bytes()].concat());
    }
});
