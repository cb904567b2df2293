//! The datagram of docs/rig-protocol.md, and damaged ones.

use dashpot::document;
use dashpot_core::hybrid::wire::{Frame, FrameError, FrameFlags, FrameKind};
use proptest::prelude::*;

const PAGE: &str = "docs/rig-protocol.md";

#[test]
fn the_datagram_of_the_page_is_what_a_vehicle_sends() {
    let frame = Frame {
        kind: FrameKind::Command,
        flags: FrameFlags::START,
        session: 7,
        sequence: 1,
        answers: 0,
        time_s: 0.001,
        displacement_m: 0.01,
        other: 0.5,
    };
    let bytes = frame.to_bytes();
    let rows = bytes.chunks(8).map(|row| {
        let row: Vec<String> = row.iter().map(|byte| format!("{byte:02x}")).collect();
        format!("    {}\n", row.join(" "))
    });
    document::compare_part(
        PAGE,
        "datagram",
        &format!("\n{}\n", rows.collect::<String>()),
    );
}

fn frames() -> impl Strategy<Value = Frame> {
    let finite = -1e30_f32..1e30;
    let numbers = (
        any::<u32>(),
        any::<u32>(),
        any::<u32>(),
        -1e300..1e300,
        finite.clone(),
        finite,
    );
    (any::<bool>(), 0..16_u8, numbers).prop_map(|(is_command, flags, numbers)| Frame {
        kind: if is_command {
            FrameKind::Command
        } else {
            FrameKind::Measurement
        },
        flags: FrameFlags::from_bits_truncate(flags),
        session: numbers.0,
        sequence: numbers.1,
        answers: numbers.2,
        time_s: numbers.3,
        displacement_m: numbers.4,
        other: numbers.5,
    })
}

proptest! {
    #[test]
    fn a_datagram_comes_back_as_it_was(frame in frames()) {
        prop_assert_eq!(Frame::from_bytes(&frame.to_bytes()), Ok(frame));
    }

    /// CRC-32 finds every burst of up to 32 bits.
    #[test]
    fn a_damaged_byte_is_found(frame in frames(), place in 0_usize..40, change in 1..=255_u8) {
        let mut bytes = frame.to_bytes();
        bytes[place] ^= change;
        let error = if place < 4 { FrameError::Magic } else { FrameError::Checksum };
        prop_assert_eq!(Frame::from_bytes(&bytes), Err(error));
    }

    #[test]
    fn other_bytes_are_no_datagram(bytes in prop::collection::vec(any::<u8>(), 0..80)) {
        prop_assert!(Frame::from_bytes(&bytes).is_err());
    }
}
