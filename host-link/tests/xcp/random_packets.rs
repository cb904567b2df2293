//! A million random packets: the slave answers or ignores each, and serves the next master as the first.

use std::collections::BTreeMap;

use crate::master::{LIST, Test};

/// A packet: random, or one that begins as a command with small numbers, or the `next` one that sets up a list. The
/// last two get far into the slave.
fn packet(random: &mut fastrand::Rng, next: &mut usize) -> Vec<u8> {
    if random.u8(..) < 96 {
        *next = (*next + 1) % LIST.len();
        return LIST[*next].to_vec();
    }
    let longest = if random.u8(..) == 0 { 300 } else { 12 };
    let length = random.usize(0..=longest);
    let most = if random.bool() { u8::MAX } else { 2 };
    let mut packet: Vec<u8> = (0..length).map(|_| random.u8(0..=most)).collect();
    // CONNECT and DISCONNECT are as rare as any random code, or no list would run.
    if random.u8(..) > 16
        && let Some(code) = packet.first_mut()
    {
        *code = random.u8(0xC0..=0xFD);
    }
    // Addresses of measured values and parameters.
    if random.bool()
        && let Some(byte) = packet.get_mut(7)
    {
        *byte = [0x10, 0x20, 0x30][random.usize(0..3)];
    }
    packet
}

#[test]
fn a_million_random_packets_are_answered() {
    let mut random = fastrand::Rng::with_seed(35);
    let mut test = Test::new();
    let mut answers: BTreeMap<(u8, u8), u64> = BTreeMap::new();
    let (mut samples, mut next) = (0, 0);
    for _ in 0..1_000_000 {
        let packet = packet(&mut random, &mut next);
        let was_connected = test.slave.is_connected();
        let response = test.slave.receive(&packet, &mut test.image);
        let is_connect = packet.first() == Some(&0xFF);
        assert_eq!(
            response.is_some(),
            !packet.is_empty() && (was_connected || is_connect)
        );
        if let Some(response) = response {
            assert!((1..=248).contains(&response.len()), "{packet:x?}");
            let answer = match response[0] {
                0xFF => (0xFF, 0),
                0xFE if response.len() == 2 => (0xFE, response[1]),
                _ => panic!("{packet:x?}: {response:x?}"),
            };
            *answers.entry(answer).or_default() += 1;
        }
        if random.u8(..) < 8 {
            let packets = test.sample();
            assert!(
                packets
                    .iter()
                    .all(|packet| (3..=1400).contains(&packet.len()))
            );
            samples += packets.len();
        }
    }
    // Random packets reach every kind of answer, and lists that run.
    for code in [
        0x00, 0x11, 0x20, 0x21, 0x22, 0x23, 0x24, 0x26, 0x27, 0x28, 0x29, 0x2A, 0x30,
    ] {
        assert!(
            answers.contains_key(&(0xFE, code)),
            "{code:#x} of {answers:x?}"
        );
    }
    assert!(answers[&(0xFF, 0)] > 50_000, "{answers:x?}");
    assert!(samples > 0);
    let mut after = Test::with_list(true);
    test.ask(&[0xFF, 0]);
    for packet in LIST {
        test.ask(packet);
    }
    assert_eq!(test.sample(), after.sample());
}
