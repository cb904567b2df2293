//! The host's end of the link: timeouts, session numbers, and refusals in words.

use std::cell::RefCell;
use std::rc::Rc;
use std::time::{Duration, Instant};

use dashpot_core::link::{Refusal, Request};
use dashpot_core::{Damper, ImageError};
use dashpot_host_link::{Client, Desk, Link, LinkError, RetryLimits};

use crate::pil_common::{RETRY_LIMITS, desk};

/// Peer that never answers; records how long the host waits.
struct Nobody(Instant, Rc<RefCell<Vec<Duration>>>);

impl Link for Nobody {
    fn send(&mut self, _: &[u8]) -> Result<(), LinkError> {
        Ok(())
    }

    fn receive(&mut self, _: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
        self.1.borrow_mut().push(self.0.elapsed() + timeout);
        Ok(0)
    }
}

#[test]
fn the_wait_allows_for_the_time_a_long_frame_takes() {
    let waits = Rc::default();
    let once = RetryLimits {
        timeout: Duration::from_millis(200),
        tries: 1,
    };
    let mut client = Client::new(Nobody(Instant::now(), Rc::clone(&waits)), once, 1);
    let image = &[0; Damper::<f32>::IMAGE_BYTES];
    let silent = client.request(&Request::Load { damper: 0, image });
    assert!(matches!(silent, Err(LinkError::Silent { limits, .. }) if limits == once));
    // At 115200 bit/s, a bridge needs 0.58 s for these bytes.
    let busy = Duration::from_secs_f64(image.len() as f64 * 10.0 / 115_200.0);
    let [wait] = waits.borrow()[..] else {
        panic!("one try, one wait")
    };
    assert!(wait >= once.timeout + busy, "{wait:?}");
}

/// A simulated target that several clients can reach.
#[derive(Clone)]
struct Shared(Rc<RefCell<Desk<3>>>);

impl Link for Shared {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.0.borrow_mut().send(bytes)
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, LinkError> {
        self.0.borrow_mut().receive(buffer, timeout)
    }
}

#[test]
fn a_session_number_in_use_is_skipped() {
    let desk = Shared(Rc::new(RefCell::new(desk())));
    let mut first = Client::new(desk.clone(), RETRY_LIMITS, u16::MAX);
    first.hello().unwrap();
    first.request(&Request::Status).unwrap();
    let mut second = Client::new(desk, RETRY_LIMITS, u16::MAX);
    second.hello().unwrap();
    second.request(&Request::Status).unwrap();
    // The first client has lost its session to the second, and takes the target back.
    let lost = first.request(&Request::Status);
    assert!(matches!(lost, Err(LinkError::SessionLost)));
    let reported = LinkError::SessionLost.to_string();
    assert!(
        reported.contains("another program opened a session"),
        "{reported}"
    );
    first.hello().unwrap();
    first.request(&Request::Status).unwrap();
}

#[test]
fn every_refusal_has_a_sentence() {
    for (refusal, part) in [
        (Refusal::Corrupt, "corrupted on its way"),
        (Refusal::Unreadable, "cannot read"),
        (Refusal::Protocol(9), "version 9"),
        (Refusal::NoSession, "say hello first"),
        (Refusal::OutOfOrder(8), "expects the sequence number 8"),
        (Refusal::Tick(7), "expects tick 7"),
        (Refusal::Count(6), "has 6 dampers"),
        (Refusal::Damper(5), "allowed: 0 to 4"),
        (Refusal::NeedsRebuild, "build a damper on the host"),
        (Refusal::Range, "a clearance of 0 to 0.1 m"),
        (
            Refusal::Image(ImageError::Version(1)),
            "format version 1, must be 4",
        ),
        (
            Refusal::Image(ImageError::Checksum),
            "the bytes are damaged",
        ),
        (Refusal::StepSize, "another step"),
        (Refusal::State, "it belongs to another damper"),
        (Refusal::Running, "is free-running; stop"),
        (Refusal::NotRunning, "is not free-running"),
        (Refusal::LinkLost, "lost the link"),
        (Refusal::Corrupted(3), "damper 3 was damaged"),
    ] {
        let reported = LinkError::Refused(refusal).to_string();
        assert!(reported.contains(part), "{refusal:?}: {reported}");
        assert!(!reported.contains(&format!("{refusal:?}")), "{reported}");
    }
}
