//! The host's end of the link: one request at a time, repeated until it is answered.

use std::time::Duration;

use dashpot_core::Damper;
use dashpot_core::link::{
    FrameReader, Header, PROTOCOL, RESPONSE_BYTES, Refusal, Request, Response, Scalar, Welcome,
    request_frame,
};
use serde::Serialize;

use super::{Link, LinkError, RetryLimits};

/// Session numbers to try: the first may be the open one, by chance or after an earlier run.
const MOST_SESSIONS: u32 = 10;

/// Largest factor by which a wait grows. With eight tries a silent target is given up after 47 times the first wait.
const MAX_BACK_OFF: u32 = 8;

/// No wait grows beyond this: eight times the first wait for the longest frame.
const MAX_GROWN_WAIT: Duration = Duration::from_secs(12);

/// Faults of the link that the host noticed; every one of them was survived.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct LinkFaults {
    /// Tries without an answer in time.
    pub timeouts: u64,
    /// Requests sent again under the same sequence number.
    pub repeated_requests: u64,
    /// Requests that the target received broken.
    pub corrupt_requests: u64,
    /// Answers received broken.
    pub corrupt_answers: u64,
    /// Answers to earlier requests.
    pub stale_answers: u64,
    /// Sessions that the target no longer knew, as after a reset.
    pub lost_sessions: u64,
}

/// Asks a target over a link.
pub struct Client<L> {
    link: L,
    retry_limits: RetryLimits,
    header: Header,
    faults: LinkFaults,
    reader: FrameReader<RESPONSE_BYTES>,
    received: Vec<u8>,
    answer: Vec<u8>,
    /// Factor of the waits, 1 to [`MAX_BACK_OFF`].
    back_off: u32,
    /// Repeats of earlier requests whose answers are still under way.
    late_repeats: u32,
}

/// What a wait brought.
enum Waited {
    /// The answer.
    Answered,
    /// The target received the request broken.
    Broken,
    /// Nothing.
    TimedOut,
}

impl<L: Link> Client<L> {
    /// A client whose first session is the one after `session`; a number drawn for each run keeps it apart
    /// from the last run's.
    pub fn new(link: L, retry_limits: RetryLimits, session: u16) -> Self {
        Self {
            link,
            retry_limits,
            header: Header {
                session,
                sequence: 0,
            },
            faults: LinkFaults::default(),
            reader: FrameReader::new(),
            received: Vec::new(),
            answer: Vec::new(),
            back_off: 1,
            late_repeats: 0,
        }
    }

    /// Faults noticed so far.
    pub fn faults(&self) -> LinkFaults {
        self.faults
    }

    /// The link.
    pub fn link(&mut self) -> &mut L {
        &mut self.link
    }

    /// Opens a new session.
    ///
    /// # Errors
    /// No answer, a target of another protocol, or one whose dampers are not this host's in single precision.
    pub fn hello(&mut self) -> Result<Welcome<'_>, LinkError> {
        let hello = Request::Hello { protocol: PROTOCOL };
        let mut tries = 1;
        loop {
            self.header.session = self.header.session.wrapping_add(1);
            match self.exchange(&hello) {
                Err(LinkError::SessionLost) if tries < MOST_SESSIONS => tries += 1,
                done => break done?,
            }
        }
        let Response::Welcome(welcome) = self.response()? else {
            return Err(LinkError::Unreadable);
        };
        if welcome.scalar != Scalar::F32 {
            return Err(LinkError::DoublePrecision);
        }
        if welcome.image_bytes as usize != Damper::<f32>::IMAGE_BYTES {
            return Err(LinkError::Unreadable);
        }
        Ok(welcome)
    }

    /// Asks until there is an answer. The target carries the request out once, however often it is sent.
    ///
    /// # Errors
    /// No answer, or a refusal.
    pub fn request(&mut self, request: &Request<'_>) -> Result<Response<'_>, LinkError> {
        self.exchange(request)?;
        self.response()
    }

    /// Asks until the answer is there and no refusal.
    fn exchange(&mut self, request: &Request<'_>) -> Result<(), LinkError> {
        self.header.sequence = self.header.sequence.wrapping_add(1);
        let frame = request_frame(self.header, request);
        let frame = frame.bytes();
        if frame.is_empty() {
            return Err(LinkError::TooLong);
        }
        let wait = self.retry_limits.for_frame(frame.len());
        let start = self.link.now();
        let mut broken = 0;
        for again in 0..self.retry_limits.tries.max(1) {
            self.faults.repeated_requests += u64::from(again > 0);
            let sent = self.link.now();
            self.link.send(frame)?;
            let grown = wait.saturating_mul(self.back_off).min(MAX_GROWN_WAIT);
            match self.wait(grown.max(wait))? {
                Waited::Answered => {
                    // Which of several tries was answered is unknown, and so is the time it took.
                    if again == 0 {
                        let took = self.link.now().saturating_duration_since(sent);
                        self.calm_down(took, wait);
                    }
                    self.late_repeats = again - broken;
                    return match self.response()? {
                        Response::Refused(Refusal::NoSession | Refusal::OutOfOrder(_)) => {
                            self.faults.lost_sessions += 1;
                            Err(LinkError::SessionLost)
                        }
                        Response::Refused(refusal) => Err(LinkError::Refused(refusal)),
                        _ => Ok(()),
                    };
                }
                Waited::Broken => broken += 1,
                Waited::TimedOut => self.back_off = (2 * self.back_off).min(MAX_BACK_OFF),
            }
        }
        self.late_repeats = self.retry_limits.tries.max(1) - broken;
        Err(LinkError::Silent {
            limits: self.retry_limits,
            waited: self.link.now().saturating_duration_since(start),
        })
    }

    /// Shortens the waits to twice what the last answer took, at most by half.
    fn calm_down(&mut self, took: Duration, wait: Duration) {
        let needed = (1..MAX_BACK_OFF).find(|factor| wait.saturating_mul(*factor) >= 2 * took);
        let needed = needed.unwrap_or(MAX_BACK_OFF);
        self.back_off = needed.max(self.back_off / 2).max(1);
    }

    /// The last answer.
    fn response(&self) -> Result<Response<'_>, LinkError> {
        let answer = parse(&self.answer).ok_or(LinkError::Unreadable)?;
        Ok(answer.1)
    }

    /// Waits up to `time` for the answer to the last request.
    fn wait(&mut self, time: Duration) -> Result<Waited, LinkError> {
        let deadline = self.link.now() + time;
        loop {
            let received = std::mem::take(&mut self.received);
            for (index, byte) in received.iter().enumerate() {
                let message = match self.reader.push(*byte) {
                    None => continue,
                    Some(Err(_)) => {
                        self.faults.corrupt_answers += 1;
                        continue;
                    }
                    Some(Ok(message)) => message.bytes,
                };
                let (header, response) = parse(message).ok_or(LinkError::Unreadable)?;
                if response == Response::Refused(Refusal::Corrupt) {
                    self.faults.corrupt_requests += 1;
                    // Answers come in the order of the requests: this one may be to a repeat of an earlier one, part
                    // of which the target dropped while it was busy.
                    if self.late_repeats > 0 {
                        self.late_repeats -= 1;
                        continue;
                    }
                    self.received = received[index + 1..].to_vec();
                    return Ok(Waited::Broken);
                }
                if header == self.header {
                    self.answer = message.to_vec();
                    self.received = received[index + 1..].to_vec();
                    return Ok(Waited::Answered);
                }
                self.late_repeats = self.late_repeats.saturating_sub(1);
                self.faults.stale_answers += 1;
            }
            let left = deadline.saturating_duration_since(self.link.now());
            let mut buffer = [0; 1024];
            let count = self.link.receive(&mut buffer, left)?;
            if count == 0 {
                self.faults.timeouts += 1;
                return Ok(Waited::TimedOut);
            }
            self.received.extend_from_slice(&buffer[..count]);
        }
    }
}

fn parse(message: &[u8]) -> Option<(Header, Response<'_>)> {
    postcard::from_bytes(message).ok()
}
