//! The outputs that the firmware's second UART sends to the actuators: forces while the tick runs freely, the safe
//! output after a loss of the link, and zeros after a fault.

use std::path::Path;
use std::time::Duration;

use dashpot::in_turn::{InTurn, MAX_ANSWERS, RETRY_LIMITS, STUCK, images};
use dashpot_core::link::{LossOfLink, Reals, Request, Response, SafeOutput};
use dashpot_host_link::{Client, Qemu};

const DAMPERS: usize = 12;

type Forces = [f32; DAMPERS];

/// Reads the packets in a file and drops repetitions. A packet is `ff ff ff ff`, then the forces, as documented in
/// docs/link.md. The last packet may be incomplete. The emulator creates the file only after it has opened the link, so
/// a file that is not there yet has no packets.
fn packets(file: &Path) -> Vec<Forces> {
    let bytes = std::fs::read(file).unwrap_or_default();
    let mut packets: Vec<Forces> = Vec::new();
    let mut rest = &bytes[..];
    while let Some((packet, left)) = rest.split_first_chunk::<{ 4 + 4 * DAMPERS }>() {
        if packet[..4] != [0xff; 4] {
            rest = &rest[1..];
            continue;
        }
        rest = left;
        let (words, _) = packet.as_chunks::<4>();
        let forces = std::array::from_fn(|damper| f32::from_le_bytes(words[damper + 1]));
        if packets.last() != Some(&forces) {
            packets.push(forces);
        }
    }
    packets
}

/// Lets the target run freely under force, then sends only queries until the link is lost and the safe output has long
/// ended. Returns the packets, and the outputs that the target reports.
fn lose_the_link(output: SafeOutput) -> Option<(Vec<Forces>, Reals)> {
    let images = images()?;
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("outputs.bin");
    let link = InTurn::start(&images.join("dashpot-firmware"), &[], Some(&file));
    let mut client = Client::new(link, RETRY_LIMITS, 3);
    client.hello().expect("a target");
    let mut ask = |request: Request<'static>| {
        let answer = client.request(&request);
        match answer.unwrap_or_else(|error| panic!("{request:?}: {error}")) {
            Response::Forces(forces) => (forces.tick, forces.forces_n.to_vec()),
            Response::Counters(counters) => (counters.link_losses, Vec::new()),
            Response::Outputs { outputs_n } => (0, outputs_n.to_vec()),
            Response::Telemetry { samples, .. } => {
                (samples.last().map_or(0, |sample| sample.tick), Vec::new())
            }
            _ => (0, Vec::new()),
        }
    };
    // With this limit the link is not lost, however slow this host is.
    let lose_after = |after_ticks, output| {
        Request::LossOfLink(LossOfLink {
            after_ticks,
            output,
        })
    };
    ask(lose_after(u32::MAX, output));
    let all = |x: f32| -> Reals { (0..DAMPERS).map(|_| x).collect() };
    let displacements_m = all(0.0);
    ask(Request::Run { displacements_m });
    let mut x = 0.0;
    let moved = (0..MAX_ANSWERS).any(|_| {
        x = if x > 0.02 { 0.0 } else { x + 1e-4 };
        let displacements_m = all(x);
        let (_, forces) = ask(Request::Displace { displacements_m });
        forces.iter().all(|force| force.abs() > 100.0)
    });
    assert!(moved, "no force in {MAX_ANSWERS} answers");
    ask(lose_after(50, output));
    let lost = (0..MAX_ANSWERS).any(|_| ask(Request::Counters).0 > 0);
    assert!(lost, "the link was not lost");
    let tick_now = |ask: &mut dyn FnMut(Request<'static>) -> (u32, Vec<f32>)| {
        // The newest sample is returned after all older ones were read.
        (0..10)
            .map(|_| ask(Request::Telemetry { damper: 0 }).0)
            .max()
    };
    let at_loss = tick_now(&mut ask).unwrap_or(0);
    let over = (0..MAX_ANSWERS).any(|_| tick_now(&mut ask) >= Some(at_loss + 30));
    assert!(over, "time stood still");
    let (_, outputs_n) = ask(Request::Outputs);
    drop(client);
    Some((packets(&file), outputs_n.into_iter().collect()))
}

fn end<const N: usize>(packets: &[Forces]) -> [Forces; N] {
    *packets.last_chunk().expect("enough packets")
}

#[test]
fn hold_keeps_the_last_good_forces_on_the_line() {
    let Some((packets, reported)) = lose_the_link(SafeOutput::Hold) else {
        return;
    };
    let [last] = end(&packets);
    assert_eq!(last[..], reported[..]);
    assert!(last.iter().any(|force| *force != 0.0));
}

#[test]
fn zero_comes_out_at_once() {
    let Some((packets, reported)) = lose_the_link(SafeOutput::Zero) else {
        return;
    };
    let [before, last] = end(&packets);
    assert_eq!((last, &reported[..]), ([0.0; DAMPERS], &[0.0; DAMPERS][..]));
    assert!(before.iter().any(|force| *force != 0.0));
}

#[test]
fn a_ramp_comes_out_in_equal_parts() {
    let Some((packets, reported)) = lose_the_link(SafeOutput::RampToZero { ticks: 4 }) else {
        return;
    };
    let [good, ramp @ ..]: [Forces; 5] = end(&packets);
    let expected = [0.75, 0.5, 0.25, 0.0].map(|share| good.map(|force| force * share));
    assert_eq!((ramp, &reported[..]), (expected, &[0.0; DAMPERS][..]));
}

#[test]
fn zeros_come_out_after_a_fault() {
    let Some(images) = images() else {
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("outputs.bin");
    let emulator = Qemu::start_with_outputs(&images.join("fault"), Some(&file));
    let emulator = emulator.expect("the emulator starts");
    // The image sends the last packet and then waits for ever, so this test has to look when it comes.
    let zero = |packets: &[Forces]| packets.last() == Some(&[0.0; DAMPERS]);
    let pause = Duration::from_millis(2);
    let came = (0..STUCK.div_duration_f64(pause) as u32).any(|_| {
        std::thread::sleep(pause);
        zero(&packets(&file))
    });
    assert!(came, "{:?}", packets(&file));
    drop(emulator);
    let packets = packets(&file);
    assert!(packets.contains(&[1000.0; DAMPERS]), "{packets:?}");
}
