//! DAQ lists: their allocation, their entries, and what is refused while one runs.

use crate::master::Test;

const DAQ_ACTIVE: u8 = 0x11;
const OUT_OF_RANGE: u8 = 0x22;
const ACCESS_DENIED: u8 = 0x24;
const MODE: u8 = 0x27;
const SEQUENCE: u8 = 0x29;
const DAQ_CONFIG: u8 = 0x2A;
const OVERFLOW: u8 = 0x30;

#[test]
fn lists_are_allocated_in_their_order() {
    let mut test = Test::connected();
    assert_eq!(
        test.refused(&[0xD5, 0, 1, 0]),
        SEQUENCE,
        "FREE_DAQ is missing"
    );
    test.ask(&[0xD6]);
    assert_eq!(
        test.refused(&[0xD4, 0, 0, 0, 1]),
        SEQUENCE,
        "ALLOC_DAQ is missing"
    );
    assert_eq!(test.refused(&[0xD5, 0, 65, 0]), OVERFLOW);
    test.ask(&[0xD5, 0, 2, 0]);
    assert_eq!(
        test.refused(&[0xD3, 0, 0, 0, 0, 1]),
        SEQUENCE,
        "ALLOC_ODT is missing"
    );
    assert_eq!(test.refused(&[0xD4, 0, 2, 0, 1]), OUT_OF_RANGE, "two lists");
    assert_eq!(test.refused(&[0xD4, 0, 0, 0, 253]), OUT_OF_RANGE);
    test.ask(&[0xD4, 0, 0, 0, 252]);
    test.ask(&[0xD4, 0, 1, 0, 252]);
    assert_eq!(test.refused(&[0xD4, 0, 0, 0, 1]), SEQUENCE, "it has tables");
    assert_eq!(test.refused(&[0xD3, 0, 0, 0, 252, 1]), OUT_OF_RANGE);
    for odt in 0..32 {
        test.ask(&[0xD3, 0, 0, 0, odt, 255]);
    }
    assert_eq!(test.refused(&[0xD3, 0, 1, 0, 0, 255]), OVERFLOW);
    assert_eq!(
        test.refused(&[0xD4, 0, 1, 0, 1]),
        SEQUENCE,
        "too late for tables"
    );
    test.ask(&[0xD6]);
    assert_eq!(
        test.refused(&[0xE2, 0, 0, 0, 0, 0]),
        OUT_OF_RANGE,
        "nothing is left"
    );
}

#[test]
fn entries_are_checked() {
    let mut test = Test::with_list(false);
    assert_eq!(
        test.refused(&[0xE1, 0xFF, 8, 0, 0, 0, 0, 0x10]),
        SEQUENCE,
        "the last was written"
    );
    assert_eq!(test.refused(&[0xE2, 0, 0, 0, 0, 2]), OUT_OF_RANGE);
    test.ask(&[0xE2, 0, 0, 0, 0, 0]);
    assert_eq!(
        test.refused(&[0xE1, 0xFF, 0, 0, 0, 0, 0, 0x10]),
        OUT_OF_RANGE,
        "no bytes"
    );
    assert_eq!(
        test.refused(&[0xE1, 3, 1, 0, 0, 0, 0, 0x10]),
        OUT_OF_RANGE,
        "a single bit"
    );
    assert_eq!(
        test.refused(&[0xE1, 0xFF, 8, 0, 0, 1, 0, 0x10]),
        ACCESS_DENIED
    );
    assert_eq!(
        test.refused(&[0xE1, 0xFF, 249, 0, 0, 0, 0, 0x10]),
        OUT_OF_RANGE
    );
    assert_eq!(test.ask(&[0xDB]), [0xFF, 8, 0, 0, 0, 0, 0x10]);
    assert_eq!(
        test.refused(&[0xE0, 0x02, 0, 0, 0, 0, 1, 0]),
        MODE,
        "stimulation"
    );
    assert_eq!(
        test.refused(&[0xE0, 0x10, 0, 0, 1, 0, 1, 0]),
        OUT_OF_RANGE,
        "one channel"
    );
    assert_eq!(
        test.refused(&[0xE0, 0x10, 0, 0, 0, 0, 0, 0]),
        OUT_OF_RANGE,
        "no prescaler"
    );
    assert_eq!(test.refused(&[0xDE, 3, 0, 0]), MODE);
    assert_eq!(test.refused(&[0xDE, 1, 1, 0]), OUT_OF_RANGE);
    assert_eq!(test.refused(&[0xDD, 3]), MODE);
    test.ask(&[0xE3, 0, 0, 0]);
    assert_eq!(test.refused(&[0xDE, 1, 0, 0]), DAQ_CONFIG, "it was cleared");
    assert_eq!(test.refused(&[0xDE, 2, 0, 0]), DAQ_CONFIG);
}

#[test]
fn a_packet_has_room_for_so_many_bytes() {
    let mut test = Test::connected();
    for packet in [
        &[0xD6][..],
        &[0xD5, 0, 1, 0],
        &[0xD4, 0, 0, 0, 2],
        &[0xD3, 0, 0, 0, 0, 30],
        &[0xD3, 0, 0, 0, 1, 30],
    ] {
        test.ask(packet);
    }
    // 1400 bytes, of which 2 identify the table and, in the first one, 4 are the time stamp: 21 times 64 and the rest.
    for (odt, rest) in [(0, 50), (1, 54)] {
        test.ask(&[0xE2, 0, 0, 0, odt, 0]);
        for _ in 0..21 {
            test.ask(&[0xE1, 0xFF, 64, 0, 0, 0, 0, 0x10]);
        }
        assert_eq!(
            test.refused(&[0xE1, 0xFF, rest + 1, 0, 0, 0, 0, 0x10]),
            DAQ_CONFIG
        );
        test.ask(&[0xE1, 0xFF, rest, 0, 0, 0, 0, 0x10]);
    }
    test.ask(&[0xE0, 0x10, 0, 0, 0, 0, 1, 0]);
    test.ask(&[0xDE, 1, 0, 0]);
    assert_eq!(
        test.sample().iter().map(Vec::len).collect::<Vec<_>>(),
        [1400, 1400]
    );
}

#[test]
fn lists_do_not_change_while_one_runs() {
    let mut test = Test::with_list(true);
    for packet in [
        &[0xD6][..],
        &[0xD5, 0, 1, 0],
        &[0xD4, 0, 0, 0, 1],
        &[0xD3, 0, 0, 0, 0, 1],
        &[0xE3, 0, 0, 0],
        &[0xE2, 0, 0, 0, 0, 0],
        &[0xE1, 0xFF, 8, 0, 0, 0, 0, 0x10],
        &[0xE0, 0x10, 0, 0, 0, 0, 1, 0],
        &[0xC7, 1, 0xFF, 8, 0, 0, 0, 0x10, 0, 0],
    ] {
        assert_eq!(test.refused(packet), DAQ_ACTIVE, "{packet:x?}");
    }
    assert_eq!(test.ask(&[0xFD])[0], 0x40, "it runs");
    test.ask(&[0xDD, 0]);
    assert_eq!(test.ask(&[0xFD])[0], 0);
    test.ask(&[0xD6]);
}
