//! Every error code of the standard, on the wrong use that it is for.

use crate::master::{PARAMETERS, Test};

const UNKNOWN: u8 = 0x20;
const SYNTAX: u8 = 0x21;
const OUT_OF_RANGE: u8 = 0x22;
const WRITE_PROTECTED: u8 = 0x23;
const ACCESS_DENIED: u8 = 0x24;
const PAGE: u8 = 0x26;
const MODE: u8 = 0x27;
const SEGMENT: u8 = 0x28;
const SEQUENCE: u8 = 0x29;

/// A packet that downloads bytes to an address.
fn short_download(address: u32, bytes: &[u8]) -> Vec<u8> {
    let mut packet = vec![0xED, bytes.len() as u8, 0, 0];
    packet.extend(address.to_le_bytes());
    packet.extend(bytes);
    packet
}

#[test]
fn without_a_session_everything_but_connect_is_ignored() {
    let mut test = Test::new();
    for code in 0..=0xFE {
        assert_eq!(test.slave.receive(&[code; 16], &mut test.image), None);
    }
    assert_eq!(test.slave.receive(&[], &mut test.image), None);
    // DAQ and calibration; little-endian bytes, more in GET_COMM_MODE_INFO; sizes 248 and 1400; version 1.
    assert_eq!(test.ask(&[0xFF, 0]), [0x05, 0x80, 248, 0x78, 0x05, 1, 1]);
}

#[test]
fn unknown_commands_are_refused_as_such() {
    let mut test = Test::connected();
    // SET_REQUEST, GET_SEED, UNLOCK, TRANSPORT_LAYER_CMD, USER_CMD, DOWNLOAD_NEXT, MODIFY_BITS, all of programming.
    for code in [
        0xF9, 0xF8, 0xF7, 0xF2, 0xF1, 0xEF, 0xEC, 0xD2, 0xD1, 0xD0, 0xC8, 0xC0, 0x00,
    ] {
        assert_eq!(
            test.refused(&[code, 0, 0, 0, 0, 0, 0, 0]),
            UNKNOWN,
            "{code:#x}"
        );
    }
    assert_eq!(
        test.refused(&[0xFC]),
        0x00,
        "SYNCH has an answer of its own"
    );
}

#[test]
fn short_packets_have_the_wrong_syntax() {
    let mut test = Test::with_list(false);
    // Commands with parameters, and the bytes that they need.
    for (code, bytes) in [
        (0xFA, 2),
        (0xF6, 8),
        (0xF5, 2),
        (0xF4, 8),
        (0xF3, 8),
        (0xF0, 3),
        (0xEE, 248),
        (0xED, 9),
        (0xEB, 4),
        (0xEA, 3),
        (0xE8, 4),
        (0xE7, 4),
        (0xE4, 5),
        (0xE3, 4),
        (0xE2, 6),
        (0xE1, 8),
        (0xE0, 8),
        (0xDF, 4),
        (0xDE, 4),
        (0xDD, 2),
        (0xD8, 4),
        (0xD7, 4),
        (0xD5, 4),
        (0xD4, 5),
        (0xD3, 6),
        (0xC7, 9),
    ] {
        for length in 1..bytes {
            let mut packet = vec![0; length];
            packet[0] = code;
            // DOWNLOAD, SHORT_DOWNLOAD and WRITE_DAQ_MULTIPLE say how much follows.
            if let (0xF0 | 0xED | 0xC7, Some(count)) = (code, packet.get_mut(1)) {
                *count = 1;
            }
            assert_eq!(test.refused(&packet), SYNTAX, "{packet:x?}");
        }
    }
}

#[test]
fn memory_is_checked() {
    let mut test = Test::connected();
    assert_eq!(test.refused(&[0xF5, 1]), SEQUENCE, "no address was set");
    assert_eq!(test.refused(&[0xF0, 1, 0]), SEQUENCE, "no address was set");
    assert_eq!(test.refused(&[0xF3, 0, 0, 0, 1, 0, 0, 0]), SEQUENCE);
    // The last of eight values ends at 64.
    assert_eq!(
        test.ask(&[0xF4, 8, 0, 0, 56, 0, 0, 0x10]),
        0.5_f64.to_le_bytes()
    );
    for packet in [
        [0xF4, 8, 0, 0, 57, 0, 0, 0x10],
        [0xF4, 1, 0, 1, 0, 0, 0, 0x10],
        [0xF4, 1, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF],
        [0xF4, 1, 0, 0, 0xFF, 0xFF, 0xFF, 0x0F],
    ] {
        assert_eq!(test.refused(&packet), ACCESS_DENIED, "{packet:x?}");
    }
    assert_eq!(test.refused(&[0xF4, 0, 0, 0, 0, 0, 0, 0x10]), OUT_OF_RANGE);
    assert_eq!(test.refused(&[0xF5, 248]), OUT_OF_RANGE);
    let measured = short_download(0x1000_0000, &[0; 8]);
    assert_eq!(test.refused(&measured), WRITE_PROTECTED);
    let epk = short_download(0x3000_0000, &[0; 8]);
    assert_eq!(test.refused(&epk), WRITE_PROTECTED);
    assert_eq!(
        test.refused(&short_download(0x4000_0000, &[0; 8])),
        ACCESS_DENIED
    );
    // GET_ID of the A2L file sets an address that cannot be written.
    test.ask(&[0xFA, 4]);
    assert_eq!(test.refused(&[0xF0, 1, 0]), WRITE_PROTECTED);
    assert_eq!(test.refused(&[0xF3, 0, 0, 0, 1, 0, 0x10, 0]), OUT_OF_RANGE);
}

#[test]
fn parameters_are_written_whole_and_if_they_are_allowed() {
    let mut test = Test::connected();
    let whole = short_download(PARAMETERS + 8, &7.5_f64.to_le_bytes());
    test.ask(&whole);
    let read = test.ask(&[0xF4, 24, 0, 0, 0, 0, 0, 0x20]);
    let expected = [1.0_f64, 7.5, 3.0].map(f64::to_le_bytes).concat();
    assert_eq!(read, expected);
    for (address, bytes) in [
        (PARAMETERS + 4, &7.5_f64.to_le_bytes()[..]),
        (PARAMETERS, &[0; 4]),
        (PARAMETERS, &(-1.0_f64).to_le_bytes()),
        (PARAMETERS, &f64::NAN.to_le_bytes()),
    ] {
        let packet = short_download(address, bytes);
        assert_eq!(test.refused(&packet), OUT_OF_RANGE, "{packet:x?}");
    }
    let beyond = short_download(PARAMETERS + 24, &[0; 8]);
    assert_eq!(test.refused(&beyond), ACCESS_DENIED);
    assert_eq!(test.ask(&[0xF4, 24, 0, 0, 0, 0, 0, 0x20]), expected);
    // SET_MTA and DOWNLOAD, which moves on.
    test.ask(&[0xF6, 0, 0, 0, 0, 0, 0, 0x20]);
    let two = [
        &[0xF0, 16][..],
        &8.0_f64.to_le_bytes(),
        &9.0_f64.to_le_bytes(),
    ]
    .concat();
    test.ask(&two);
    test.ask(&[&[0xF0, 8][..], &10.0_f64.to_le_bytes()].concat());
    let expected = [8.0_f64, 9.0, 10.0].map(f64::to_le_bytes).concat();
    assert_eq!(test.ask(&[0xF4, 24, 0, 0, 0, 0, 0, 0x20]), expected);
    // BUILD_CHECKSUM is the CRC-32 of these bytes.
    test.ask(&[0xF6, 0, 0, 0, 0, 0, 0, 0x20]);
    let checksum = test.ask(&[0xF3, 0, 0, 0, 24, 0, 0, 0]);
    assert_eq!(checksum[0], 9);
    assert_eq!(checksum[3..], dashpot_core::crc_32(&expected).to_le_bytes());
}

#[test]
fn pages_are_switched_and_copied() {
    let mut test = Test::connected();
    assert_eq!(test.ask(&[0xE9]), [1, 0], "one segment");
    assert_eq!(test.ask(&[0xE8, 1, 0, 0, 0])[0], 2, "two pages");
    assert_eq!(test.ask(&[0xE8, 0, 0, 0, 0])[3..], PARAMETERS.to_le_bytes());
    assert_eq!(test.ask(&[0xE8, 0, 0, 1, 0])[3..], 24_u32.to_le_bytes());
    // The master reads the second page, the model still uses the first.
    test.ask(&[0xEB, 0x02, 0, 1]);
    assert_eq!(
        test.ask(&[0xF4, 8, 0, 0, 0, 0, 0, 0x20]),
        4.0_f64.to_le_bytes()
    );
    assert_eq!(test.ask(&[0xEA, 1, 0])[2], 0);
    assert_eq!(test.ask(&[0xEA, 2, 0])[2], 1);
    // Both, in all segments.
    test.ask(&[0xEB, 0x83, 77, 1]);
    assert_eq!(test.ask(&[0xEA, 1, 0])[2], 1);
    // The second page becomes a copy of the first.
    test.ask(&[0xE4, 0, 0, 0, 1]);
    assert_eq!(
        test.ask(&[0xF4, 8, 0, 0, 0, 0, 0, 0x20]),
        1.0_f64.to_le_bytes()
    );
    assert_eq!(test.refused(&[0xEB, 0x03, 0, 2]), PAGE);
    assert_eq!(test.refused(&[0xEB, 0x03, 1, 0]), SEGMENT);
    assert_eq!(test.refused(&[0xEB, 0x00, 0, 0]), MODE);
    assert_eq!(test.refused(&[0xEB, 0x05, 0, 0]), MODE);
    assert_eq!(test.refused(&[0xEA, 3, 0]), MODE);
    assert_eq!(test.refused(&[0xEA, 1, 1]), SEGMENT);
    assert_eq!(test.refused(&[0xE4, 0, 0, 0, 2]), PAGE);
    assert_eq!(test.refused(&[0xE4, 0, 0, 1, 0]), SEGMENT);
    assert_eq!(test.refused(&[0xE7, 0, 0, 2]), PAGE);
    assert_eq!(test.refused(&[0xE8, 2, 0, 0, 0]), OUT_OF_RANGE);
}
