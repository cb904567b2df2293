//! Receives any bytes on the link. The device refuses or answers them, and the next frame after a zero byte is read.
//!
//! Mutated frames never have a correct CRC-32, so the same bytes are sent again with a corrected CRC-32.
#![no_main]

use dashpot::signed_image::crc_32;
use dashpot_core::Damper;
use dashpot_core::link::{Clock, Device, FrameReader, REQUEST_BYTES, ResponseFrame};
use libfuzzer_sys::fuzz_target;

/// A damper whose numbers are all zero except its step, which is equal to that of the health model in the seeds.
static DAMPER: Damper<f32> = {
    let mut words = [0; Damper::<f32>::WORDS];
    words[3] = 1e-3_f32.to_bits();
    Damper::<f32>::from_words(&words)
};

fuzz_target!(|bytes: &[u8]| {
    let mut reader = FrameReader::<REQUEST_BYTES>::new();
    let clock = Clock::new(|| 0, 1);
    let mut device = Box::new(Device::<2, 2>::new());
    device.start(&[&DAMPER; 2], clock).expect("one step");
    for byte in bytes.iter().chain(&[0]).chain(&signed(bytes)) {
        let _ = reader.push(*byte);
        let mut answered = device.receive(*byte);
        while device.is_busy() {
            answered = device.advance();
        }
        if answered {
            assert_eq!(device.response().last(), Some(&0));
        }
    }
    let mut frame = ResponseFrame::new();
    assert!(frame.write(&bytes.len()));
    let read = frame
        .bytes()
        .iter()
        .filter_map(|byte| reader.push(*byte).map(|r| r.is_ok()));
    assert!(read.eq([true]));
});

/// Returns the frames between zeros, each with the CRC-32 of its message.
fn signed(bytes: &[u8]) -> Vec<u8> {
    let mut stream = Vec::new();
    for frame in bytes.split(|byte| *byte == 0) {
        let Ok(mut message) = cobs::decode_vec(frame) else {
            continue;
        };
        let Some((message, check)) = message.split_last_chunk_mut::<4>() else {
            continue;
        };
        *check = crc_32(message).to_le_bytes();
        stream.extend(cobs::encode_vec(&[&*message, &*check].concat()));
        stream.push(0);
    }
    stream
}
