//! Any bytes on the link: refused or answered, and the next frame after a zero is read.
#![no_main]

use dashpot_core::Damper;
use dashpot_core::link::{Clock, Device, FrameReader, REQUEST_BYTES, ResponseFrame};
use libfuzzer_sys::fuzz_target;

static DAMPER: Damper<f32> = Damper::<f32>::from_words(&[0; Damper::<f32>::WORDS]);

fuzz_target!(|bytes: &[u8]| {
    let mut reader = FrameReader::<REQUEST_BYTES>::new();
    let clock = Clock { now: || 0, hz: 1 };
    let mut device = Box::new(Device::new());
    device.start(&[&DAMPER; 2], clock).expect("one step");
    for byte in bytes.iter().chain(&[0]) {
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
