//! The server over a stream in memory.

mod stream;

use std::cell::RefCell;
use std::collections::VecDeque;
use std::future::poll_fn;
use std::task::Poll;

use dashpot_core::Damper;
use dashpot_core::link::{
    Clock, Counters, Device, Header, Outputs, PROTOCOL, Request, request_frame,
};
use dashpot_core::parameters::{DamperParameters, Mount};
use dashpot_device::{Progress, ProgressCheck, Server, Ticks};
use embassy_futures::block_on;
use embedded_io::ErrorKind;

use stream::{Reader, Writer, quiet};

fn damper() -> Damper<f32> {
    let parameters = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6));
    parameters.build(1e-3).unwrap()
}

fn started() -> Box<Device<2, 1>> {
    let mut device = Box::new(Device::new());
    device.start(&[&damper(); 2], Clock::new(|| 0, 1)).unwrap();
    device
}

fn frame(sequence: u32, request: &Request<'_>) -> Vec<u8> {
    let header = Header {
        session: 1,
        sequence,
    };
    request_frame(header, request).bytes().to_vec()
}

fn step(tick: u32) -> Request<'static> {
    Request::Step {
        tick,
        displacements_m: [1e-4 * tick as f32; 2].into_iter().collect(),
    }
}

/// A hello, a whole image to load, steps with a damaged frame between them, and a run. Each has one answer.
fn conversation() -> [Vec<u8>; 6] {
    let image = damper().to_image();
    let load = Request::Load {
        damper: 1,
        image: &image,
    };
    let run = Request::Run {
        displacements_m: [0.0; 2].into_iter().collect(),
    };
    [
        frame(1, &Request::Hello { protocol: PROTOCOL }),
        frame(2, &load),
        frame(3, &step(1)),
        vec![9, 9, 0],
        frame(4, &step(2)),
        frame(5, &run),
    ]
}

/// Forces that were driven, the last ones last.
#[derive(Default)]
struct Driven(Vec<[f32; 2]>);

impl Outputs<2> for &mut Driven {
    fn drive(&mut self, forces_n: &[f32; 2]) {
        self.0.push(*forces_n);
    }
}

/// What the device answers byte by byte.
fn expected() -> (Vec<u8>, Counters) {
    let mut device = started();
    let mut answers = Vec::new();
    for byte in conversation().concat() {
        let mut answered = device.receive(byte);
        while device.is_busy() {
            answered = device.advance();
        }
        if answered {
            answers.extend_from_slice(device.response());
        }
    }
    (answers, device.counters())
}

#[test]
fn answers_do_not_depend_on_how_the_bytes_arrive() {
    let (answers, counters) = expected();
    assert_eq!((counters.accepted, counters.corrupt), (5, 1));
    for size in [1, 7, 63, 64, 65, 10_000] {
        let mut device = started();
        let mut driven = Driven::default();
        let mut server = Server {
            device: &mut device,
            outputs: &mut driven,
            ticks: &Ticks::new(),
            progress: &Progress::new(),
        };
        let mut reader = Reader(
            conversation()
                .iter()
                .flat_map(|frame| frame.chunks(size))
                .map(<[u8]>::to_vec)
                .collect(),
        );
        let mut writer = quiet();
        let end = block_on(server.serve(&mut reader, &mut writer));
        assert_eq!(end, ErrorKind::BrokenPipe);
        assert_eq!(writer.sent, answers, "chunks of {size}");
        assert_eq!(device.counters(), counters, "chunks of {size}");
        // One for each answer.
        assert_eq!(driven.0.len(), 6, "chunks of {size}");
    }
}

#[test]
fn a_failure_of_the_line_ends_the_call_but_not_the_session() {
    let mut device = started();
    let mut server = Server {
        device: &mut device,
        outputs: &mut Driven::default(),
        ticks: &Ticks::new(),
        progress: &Progress::new(),
    };
    let mut reader = Reader(VecDeque::from([
        frame(1, &Request::Hello { protocol: PROTOCOL }),
        vec![],
        frame(2, &step(1)),
    ]));
    let mut writer = quiet();
    let end = block_on(server.serve(&mut reader, &mut writer));
    assert_eq!(end, ErrorKind::Other);
    let end = block_on(server.serve(&mut reader, &mut writer));
    assert_eq!(end, ErrorKind::BrokenPipe);
    assert_eq!(device.counters().accepted, 2);
}

#[test]
fn ticks_run_while_an_answer_is_sent() {
    let ticks = Ticks::new();
    let progress = Progress::new();
    let mut device = started();
    let mut driven = Driven::default();
    let mut server = Server {
        device: &mut device,
        outputs: &mut driven,
        ticks: &ticks,
        progress: &progress,
    };
    let mut reader = Reader(conversation().into());
    let mut writer = Writer {
        sent: Vec::new(),
        waits: 5,
        while_waiting: || ticks.count(),
    };
    block_on(server.serve(&mut reader, &mut writer));
    assert_eq!(writer.sent, expected().0);
    // Only the last answer is sent while the tick runs free.
    assert_eq!((device.tick_number(), device.counters().overruns), (5, 0));
    assert_eq!(driven.0.len(), 6 + 6 * 5);
}

/// A line that fails at every read, as without a cable, is no reason to stop the ticks or to reset the board.
#[test]
fn ticks_run_while_every_read_fails() {
    let (ticks, progress) = (Ticks::new(), Progress::new());
    let mut device = started();
    let mut server = Server {
        device: &mut device,
        outputs: &mut Driven::default(),
        ticks: &ticks,
        progress: &progress,
    };
    let run = Request::Run {
        displacements_m: [0.0; 2].into_iter().collect(),
    };
    let hello = frame(1, &Request::Hello { protocol: PROTOCOL });
    block_on(server.serve(&mut Reader([hello, frame(2, &run)].into()), &mut quiet()));
    let mut check = ProgressCheck::default();
    for _ in 0..10 {
        ticks.count();
        let end = block_on(server.serve(&mut Reader([vec![]].into()), &mut quiet()));
        assert_eq!(end, ErrorKind::Other);
        assert!(check.both_moved(&progress));
    }
    assert_eq!(device.tick_number(), 10);
}

/// A watchdog is fed while the host is silent, and starves if a write never ends or the timer stops.
#[test]
fn the_watchdog_starves_if_link_or_tick_stands_still() {
    let (ticks, progress) = (Ticks::new(), Progress::new());
    let mut device = started();
    let mut server = Server {
        device: &mut device,
        outputs: &mut Driven::default(),
        ticks: &ticks,
        progress: &progress,
    };
    let mut check = ProgressCheck::default();
    let wait_with_ticks = |count: u32| {
        let mut left = count;
        let ticks = &ticks;
        poll_fn(move |context| {
            if left == 0 {
                return Poll::Ready(());
            }
            left -= 1;
            ticks.count();
            context.waker().wake_by_ref();
            Poll::Pending
        })
    };
    assert!(!check.both_moved(&progress));
    block_on(server.run_ticks_until(wait_with_ticks(3)));
    assert!(check.both_moved(&progress), "a silent host");
    block_on(server.run_ticks_until(wait_with_ticks(0)));
    assert!(!check.both_moved(&progress), "no tick");

    // Looks at the progress after each tick of a write that waits. The first looks see what was before the write.
    let looks = RefCell::new((check, Vec::new()));
    let mut writer = Writer {
        sent: Vec::new(),
        waits: 100,
        while_waiting: || {
            ticks.count();
            let (check, fed) = &mut *looks.borrow_mut();
            fed.push(check.both_moved(&progress));
        },
    };
    let hello = frame(1, &Request::Hello { protocol: PROTOCOL });
    block_on(server.serve(&mut Reader(VecDeque::from([hello])), &mut writer));
    let (mut check, fed) = looks.into_inner();
    assert_eq!(fed[2..], [false; 98]);
    assert!(check.both_moved(&progress), "the write ended");
}
