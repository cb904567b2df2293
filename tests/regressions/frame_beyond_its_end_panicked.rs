//! Fixed bug: a frame with COBS codes that point beyond its end was read out of bounds, which panicked.

use dashpot_core::link::{Frame, FrameReader};

/// Checks all frames of one and two bytes, and longer ones with one code at each position.
#[test]
fn after_every_short_frame_the_next_is_read() {
    let mut good = Frame::<16>::new();
    assert!(good.write(&7_u8));
    let mut reader = FrameReader::<16>::new();
    let mut read_after = |frame: &[u8]| {
        let ends = |byte: &u8| reader.push(*byte).map(|message| message.is_ok());
        let read: Vec<bool> = frame
            .iter()
            .chain(&[0])
            .chain(good.bytes())
            .filter_map(ends)
            .collect();
        // This frame decodes to zeros: an empty message with its CRC-32.
        let empty = frame == [1; 5];
        assert_eq!(read, [empty, true], "{frame:x?}");
    };
    for first in 1..=255 {
        read_after(&[first]);
        for second in 1..=255 {
            read_after(&[first, second]);
        }
        for length in 3..300 {
            read_after(&vec![first; length]);
        }
    }
}
