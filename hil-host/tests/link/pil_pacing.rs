//! Paced ticks on a simulated clock.

use std::cell::Cell;
use std::rc::Rc;
use std::time::Duration;

use dashpot_core::link::{FrameReader, Header, REQUEST_BYTES, Request};
use dashpot_host_link::{Client, Desk, Event, Link, LinkError, Pace, Report, Session};
use dashpot_realtime::pacing::{Clock, Pacer};

use crate::pil_common::{RETRY_LIMITS, built, desk, motion};

/// Clock that advances by sleeping and by explicit steps.
#[derive(Clone, Default)]
struct SimulatedClock(Rc<Cell<u64>>);

impl Clock for SimulatedClock {
    fn now_ns(&self) -> u64 {
        self.0.get()
    }
    fn sleep_until_ns(&self, deadline_ns: u64) {
        self.0.set(deadline_ns);
    }
}

/// Simulated target that takes 300 us per step, and 1.9 ms for step 5.
struct Slow {
    desk: Desk<3>,
    clock: SimulatedClock,
    /// Time at which each step was sent (ns).
    sent_ns: Rc<std::cell::RefCell<Vec<u64>>>,
}

impl Link for Slow {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        let mut reader = FrameReader::<REQUEST_BYTES>::new();
        for byte in bytes {
            if let Some(Ok(message)) = reader.push(*byte) {
                let (_, request): (Header, Request<'_>) =
                    postcard::from_bytes(message.bytes).unwrap();
                if let Request::Step { tick, .. } = request {
                    let now_ns = self.clock.now_ns();
                    self.sent_ns.borrow_mut().push(now_ns);
                    let taken_ns = if tick == 5 { 1_900_000 } else { 300_000 };
                    self.clock.0.set(now_ns + taken_ns);
                }
            }
        }
        self.desk.send(bytes)
    }
    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
        self.desk.receive(buffer, timeout)
    }
}

struct Ran {
    report: Report,
    sent_ns: Vec<u64>,
    round_trips_ns: Vec<u64>,
    late: Vec<u32>,
}

fn run(pace: impl FnOnce(SimulatedClock) -> Pace<SimulatedClock>) -> Ran {
    let clock = SimulatedClock::default();
    let link = Slow {
        desk: desk(),
        clock: clock.clone(),
        sent_ns: Rc::default(),
    };
    let sent_ns = link.sent_ns.clone();
    let mut session = Session::open(Client::new(link, RETRY_LIMITS, 40)).unwrap();
    let (mut round_trips_ns, mut late) = (Vec::new(), Vec::new());
    let report = session
        .run(&[built("paper")], motion(10), &mut pace(clock), |record| {
            round_trips_ns.push(record.round_trip_ns);
            if record.events.contains(&Event::Late) {
                late.push(record.tick);
            }
            Ok(())
        })
        .unwrap();
    Ran {
        report,
        sent_ns: sent_ns.take(),
        round_trips_ns,
        late,
    }
}

#[test]
fn a_tick_is_sent_when_due_and_late_when_answered_after_the_next_was_due() {
    let ran = run(|clock| Pace::Paced(Box::new(Pacer::with_clock(1e-3, clock).unwrap())));
    // Step 5 is sent at 5 ms and answered at 6.9 ms. Step 6, due at 6 ms, follows at once and is answered at 7.2 ms,
    // after step 7 was due; step 7 is answered at 7.5 ms, in time.
    let sent_us: Vec<u64> = ran.sent_ns.iter().map(|ns| ns / 1000).collect();
    assert_eq!(
        sent_us,
        [1000, 2000, 3000, 4000, 5000, 6900, 7200, 8000, 9000, 10_000]
    );
    assert_eq!(ran.late, [5, 6]);
    let pacing = ran.report.pacing.unwrap();
    assert_eq!((pacing.missed_deadlines, pacing.missed_share), (2, 0.2));
    assert_eq!(pacing.lateness.worst_ns, 900e3);
    assert_eq!(pacing.response.worst_ns, 1.9e6);
    assert_eq!(ran.report.round_trip.worst_ns, 1.9e6);
    assert_eq!(ran.report.mismatches, 0);
}

#[test]
fn without_pacing_a_tick_follows_its_answer() {
    let ran = run(Pace::Free);
    let mut expected_ns = [300_000; 10];
    expected_ns[4] = 1_900_000;
    assert_eq!(ran.round_trips_ns, expected_ns);
    assert_eq!(ran.sent_ns[9], 8 * 300_000 + 1_900_000);
    assert_eq!((ran.report.pacing, ran.late), (None, Vec::new()));
}
