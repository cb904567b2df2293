//! Samples, and what a tool asks before it measures.

use crate::master::Test;

#[test]
fn a_list_is_sampled_with_time_stamp_and_prescaler() {
    let mut test = Test::with_list(false);
    assert!(test.sample().is_empty(), "not started");
    test.ask(&[0xE0, 0x10, 0, 0, 0, 0, 2, 0]);
    // Selected, then started with all that are selected.
    test.ask(&[0xDE, 2, 0, 0]);
    assert_eq!(test.ask(&[0xDF, 0, 0, 0]), [0x11, 0, 0, 0, 0, 2, 0]);
    test.ask(&[0xDD, 1]);
    assert_eq!(test.ask(&[0xDF, 0, 0, 0])[0], 0x50);
    for tick in 1..=6 {
        let values: Vec<f64> = (0..8).map(|number| f64::from(10 * tick + number)).collect();
        test.image.update(1e-3 * f64::from(tick), &values);
        let packets = test.sample();
        assert_eq!(packets.len(), usize::from(tick % 2 == 0));
        for packet in packets {
            assert_eq!(packet[..2], [0, 0]);
            assert_eq!(packet[2..6], (1000 * tick as u32).to_le_bytes());
            let expected = [values[0], values[1]].map(f64::to_le_bytes).concat();
            assert_eq!(packet[6..], expected);
        }
    }
    test.ask(&[0xDE, 2, 0, 0]);
    test.ask(&[0xDD, 2]);
    assert!(test.sample().is_empty(), "stopped");
}

#[test]
fn time_stamps_wrap_around() {
    let mut test = Test::with_list(true);
    test.image.update(4294.967296 + 0.25, &[]);
    assert_eq!(test.sample()[0][2..6], 250_000_u32.to_le_bytes());
    assert_eq!(test.ask(&[0xDC])[3..], 250_000_u32.to_le_bytes());
}

#[test]
fn a_tool_learns_what_there_is() {
    let mut test = Test::with_list(false);
    // Dynamic, prescaler, time stamps, overload by event; one list, one channel; tables numbered in their list.
    assert_eq!(test.ask(&[0xDA]), [0x93, 1, 0, 1, 0, 0, 0x40]);
    assert_eq!(test.ask(&[0xD9]), [1, 248, 1, 0, 0x3C, 1, 0]);
    assert_eq!(test.ask(&[0xD8, 0, 0, 0]), [0x04, 1, 2, 0, 0]);
    assert_eq!(test.ask(&[0xD7, 0, 0, 0]), [0x84, 0xFF, 4, 1, 6, 0]);
    assert_eq!(test.ask(&[0xF5, 4]), b"tick");
    assert_eq!(test.refused(&[0xD7, 0, 1, 0]), 0x22);
    for (kind, text) in [(0, "test vehicle"), (1, "test vehicle"), (3, "")] {
        let response = test.ask(&[0xFA, kind]);
        assert_eq!(response[3..], (text.len() as u32).to_le_bytes());
        if !text.is_empty() {
            assert_eq!(test.ask(&[0xF5, text.len() as u8]), text.as_bytes());
        }
    }
}

#[test]
fn the_description_is_uploaded_in_parts() {
    let mut test = Test::connected();
    let response = test.ask(&[0xFA, 4]);
    let length = u32::from_le_bytes(response[3..].try_into().unwrap()) as usize;
    let mut text = Vec::new();
    while text.len() < length {
        let part = (length - text.len()).min(247);
        text.extend(test.ask(&[0xF5, part as u8]));
    }
    let expected = dashpot_host_link::a2l::write(&crate::master::description(8));
    assert_eq!(String::from_utf8(text).unwrap(), expected);
    assert_eq!(test.refused(&[0xF5, 1]), 0x24, "there is no more");
}

#[test]
fn a_new_session_forgets_the_old_one() {
    let mut test = Test::with_list(true);
    assert!(test.slave.is_measuring());
    test.ask(&[0xFF, 0]);
    assert!(!test.slave.is_measuring());
    assert_eq!(test.refused(&[0xDE, 1, 0, 0]), 0x22, "no list");
    test.ask(&[0xFE]);
    assert_eq!(test.slave.receive(&[0xFD], &mut test.image), None);
}
