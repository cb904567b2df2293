//! Tests of frames: decoded content, refusals, and resynchronisation at a zero byte.

use dashpot::signed_image::crc_32;
use dashpot_core::health::{Estimate, HealthReading, HealthStatus};
use dashpot_core::link::{
    Forces, FrameError, FrameReader, Header, MAX_DAMPERS, MAX_SAMPLES, REQUEST_BYTES,
    RESPONSE_BYTES, Request, RequestFrame, Response, ResponseFrame, Sample, Scalar, Welcome,
};
use proptest::prelude::*;

/// Messages of a stream, each `None` if the reader found an error.
fn read(bytes: &[u8]) -> Vec<Option<Vec<u8>>> {
    let mut reader = FrameReader::<REQUEST_BYTES>::new();
    let mut messages = Vec::new();
    for byte in bytes {
        if let Some(result) = reader.push(*byte) {
            messages.push(result.ok().map(|message| message.bytes.to_vec()));
        }
    }
    messages
}

fn step(tick: u32) -> (Header, Request<'static>) {
    let header = Header {
        session: 0xabcd,
        sequence: tick,
    };
    let displacements_m = (0..12).map(|i| 1e-3 * (i as f32 - 4.0)).collect();
    (
        header,
        Request::Step {
            tick,
            displacements_m,
        },
    )
}

/// Decodes COBS by its definition (Cheshire and Baker 1999): each code byte is the distance to the next.
fn cobs_decoded(bytes: &[u8]) -> Vec<u8> {
    let (mut decoded, mut position) = (Vec::new(), 0);
    while position < bytes.len() {
        let code = usize::from(bytes[position]);
        decoded.extend(&bytes[position + 1..position + code]);
        position += code;
        if code < 255 && position < bytes.len() {
            decoded.push(0);
        }
    }
    decoded
}

#[test]
fn a_frame_is_cobs_of_message_and_crc() {
    let mut frame = RequestFrame::new();
    assert!(frame.write(&step(7)));
    let (end, encoded) = frame.bytes().split_last().unwrap();
    assert_eq!(*end, 0);
    assert!(!encoded.contains(&0));
    let decoded = cobs_decoded(encoded);
    let (message, check) = decoded.split_at(decoded.len() - 4);
    assert_eq!(check, crc_32(message).to_le_bytes());
    assert_eq!(read(frame.bytes()), [Some(message.to_vec())]);
    let parsed: (Header, Request<'_>) = postcard::from_bytes(message).unwrap();
    assert_eq!(parsed, step(7));
}

#[test]
fn every_wrong_bit_of_a_frame_is_refused() {
    let mut frame = RequestFrame::new();
    for tick in [1, 0x0100_0000, u32::MAX] {
        assert!(frame.write(&step(tick)));
        for bit in 0..8 * frame.bytes().len() {
            let mut wrong = frame.bytes().to_vec();
            wrong[bit / 8] ^= 1 << (bit % 8);
            wrong.push(0);
            for message in read(&wrong) {
                assert_eq!(message, None, "bit {bit}");
            }
        }
    }
}

#[test]
fn every_cut_frame_is_refused_and_the_next_is_read() {
    let mut frame = RequestFrame::new();
    assert!(frame.write(&step(3)));
    let whole = frame.bytes();
    let message = read(whole).remove(0);
    for length in 1..whole.len() - 1 {
        let stream = [&whole[..length], &[0], whole].concat();
        assert_eq!(read(&stream), [None, message.clone()], "{length} bytes");
    }
}

#[test]
fn the_longest_messages_fit() {
    let header = Header {
        session: u16::MAX,
        sequence: u32::MAX,
    };
    let states = [0xff; MAX_DAMPERS * 24];
    let tick = u32::MAX;
    let mut request = RequestFrame::new();
    let restore = Request::Restore {
        tick,
        states: &states,
    };
    assert!(request.write(&(header, restore)));
    let image = [0xff; dashpot_core::Damper::<f32>::IMAGE_BYTES];
    let load = Request::Load {
        damper: u8::MAX,
        image: &image,
    };
    assert!(request.write(&(header, load)));

    let mut response = ResponseFrame::new();
    let saved = Response::Saved {
        tick,
        states: &states,
    };
    assert!(response.write(&(header, saved)));
    let mut welcome = Welcome::default();
    welcome.protocol = u16::MAX;
    welcome.core_version = "1000.1000.1000";
    welcome.revisions = [u32::MAX; MAX_DAMPERS].into_iter().collect();
    welcome.scalar = Scalar::F64;
    welcome.step_s = f32::MAX;
    welcome.image_bytes = tick;
    welcome.tick = tick;
    welcome.clock_hz = tick;
    welcome.running = true;
    assert!(response.write(&(header, Response::Welcome(welcome))));
    let mut sample = Sample::default();
    sample.tick = tick;
    sample.displacement_m = f32::MAX;
    sample.force_n = f32::MAX;
    sample.status = u16::MAX;
    let telemetry = Response::Telemetry {
        overwritten: tick,
        samples: [sample; MAX_SAMPLES].into_iter().collect(),
    };
    assert!(response.write(&(header, telemetry)));
    let mut forces = Forces::default();
    forces.tick = tick;
    forces.forces_n = [f32::MAX; MAX_DAMPERS].into_iter().collect();
    forces.status = [u16::MAX; MAX_DAMPERS].into_iter().collect();
    forces.clock_ticks = tick;
    assert!(response.write(&(header, Response::Forces(forces))));
    let largest = Estimate {
        value: f32::MAX,
        sd: f32::MAX,
    };
    let mut health = HealthReading::default();
    health.flow_factor = largest;
    health.stiffness_n_per_m = largest;
    health.clearance_m = largest;
    health.lag_s = largest;
    health.compliance_m_per_n = largest;
    health.force_zero_n = largest;
    health.added_friction_n = largest;
    health.samples = tick;
    health.rejected = tick;
    health.status = HealthStatus::from_bits_retain(u16::MAX);
    assert!(response.write(&(header, Response::Health(health))));
}

#[test]
fn too_long_messages_are_neither_written_nor_read() {
    let mut frame = ResponseFrame::new();
    assert!(frame.write(&[7_u8; 32]));
    let long = "x".repeat(RESPONSE_BYTES);
    assert!(!frame.write(&long.as_str()));
    assert!(frame.bytes().is_empty());

    let mut reader = FrameReader::<RESPONSE_BYTES>::new();
    for _ in 0..10 * RESPONSE_BYTES {
        assert_eq!(reader.push(1), None);
    }
    assert_eq!(reader.push(0), Some(Err(FrameError::TooLong)));
    assert!(frame.write(&step(1)));
    let results = frame
        .bytes()
        .iter()
        .filter_map(|byte| reader.push(*byte).map(|r| r.is_ok()));
    assert_eq!(results.collect::<Vec<_>>(), [true]);
}

proptest! {
    #[test]
    fn any_bytes_then_a_zero_then_a_frame(noise in prop::collection::vec(any::<u8>(), 0..2000), tick in any::<u32>()) {
        let mut frame = RequestFrame::new();
        prop_assert!(frame.write(&step(tick)));
        let stream = [&noise[..], &[0], frame.bytes()].concat();
        let messages = read(&stream);
        let expected = read(frame.bytes());
        prop_assert_eq!(messages.last(), expected.last());
    }
}
