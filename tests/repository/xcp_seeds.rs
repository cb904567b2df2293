//! Seeds of the fuzz target of XCP: sessions that get far into the slave.

use crate::fuzz_seeds::compare;

/// The messages of a session, after CONNECT.
fn session(name: &str, packets: &[&[u8]]) -> (String, Vec<u8>) {
    let packets = [&[0xFF, 0][..]].into_iter().chain(packets.iter().copied());
    let message = |(counter, packet): (usize, &[u8])| {
        let [length, counter] = [packet.len() as u16, counter as u16].map(u16::to_le_bytes);
        [&length[..], &counter[..], packet].concat()
    };
    (name.into(), packets.enumerate().flat_map(message).collect())
}

#[test]
fn sessions_of_xcp_measure_calibrate_and_identify() {
    let measure: [&[u8]; 10] = [
        &[0xD6],
        &[0xD5, 0, 1, 0],
        &[0xD4, 0, 0, 0, 1],
        &[0xD3, 0, 0, 0, 0, 2],
        &[0xE2, 0, 0, 0, 0, 0],
        &[
            0xC7, 2, 0xFF, 8, 0, 0, 0, 0, 0, 0, 0xFF, 4, 8, 0, 0, 0, 0, 0,
        ],
        &[0xE0, 0x10, 0, 0, 0, 0, 1, 0],
        &[0xDE, 2, 0, 0],
        &[0xDD, 1],
        &[0xDD, 0],
    ];
    let calibrate: [&[u8]; 7] = [
        &[0xEB, 0x83, 0, 1],
        &[0xF6, 0, 0, 0, 8, 0, 0, 0],
        &[0xF0, 2, 7, 7],
        &[0xED, 1, 0, 0, 0, 0, 0, 0, 9],
        &[0xE4, 0, 1, 0, 0],
        &[0xF4, 8, 0, 0, 0, 0, 0, 0],
        &[0xF3, 0, 0, 0, 16, 0, 0, 0],
    ];
    let identify: [&[u8]; 8] = [
        &[0xFB],
        &[0xFA, 4],
        &[0xF5, 4],
        &[0xDA],
        &[0xD9],
        &[0xD7, 0, 0, 0],
        &[0xE8, 0, 0, 1, 0],
        &[0xFE],
    ];
    let seeds = vec![
        session("measure", &measure),
        session("calibrate", &calibrate),
        session("identify", &identify),
    ];
    compare("xcp_packets", seeds);
}
