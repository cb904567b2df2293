//! Host end of the link: sends one request at a time and repeats it until it is answered.

use std::time::{Duration, Instant};

use dashpot_core::Damper;
use dashpot_core::link::{
    FrameReader, Header, PROTOCOL, RESPONSE_BYTES, Refusal, Request, Response, Scalar, Welcome,
    request_frame,
};
use serde::Serialize;

use super::{Link, LinkError, RetryLimits};

/// Maximum number of session numbers to try; the first one may equal that of the open session.
const MAX_SESSIONS: u32 = 10;

/// Maximum factor by which a wait grows. With eight tries, the client waits 47 times the first wait in total before it
/// gives up.
const MAX_BACK_OFF: u32 = 8;

/// Maximum wait after back-off: eight times the first wait for the longest frame.
const MAX_GROWN_WAIT: Duration = Duration::from_secs(12);

/// Link faults that the host detected and recovered from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct LinkFaults {
    /// Tries that were not answered in time.
    pub timeouts: u64,
    /// Requests sent again under the same sequence number.
    pub repeated_requests: u64,
    /// Requests that reached the target corrupted.
    pub corrupt_requests: u64,
    /// Answers that reached the host corrupted.
    pub corrupt_answers: u64,
    /// Answers to earlier requests.
    pub stale_answers: u64,
    /// Sessions that the target no longer knew, for example after a reset.
    pub lost_sessions: u64,
}

/// How long a request waits for its answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Patience {
    /// Until the tries of the retry limits are used up.
    Tries,
    /// For the first wait of the retry limits.
    FirstWait,
    /// Until this time of the link.
    Until(Instant),
}

/// Sends requests to a target over a link.
pub struct Client<L> {
    link: L,
    retry_limits: RetryLimits,
    patience: Patience,
    header: Header,
    faults: LinkFaults,
    reader: FrameReader<RESPONSE_BYTES>,
    received: Vec<u8>,
    answer: Vec<u8>,
    /// Factor for the waits, 1 to [`MAX_BACK_OFF`].
    back_off: u32,
    /// Number of repeats of earlier requests whose answers are still on the way.
    late_repeats: u32,
}

/// Result of waiting for an answer.
enum WaitResult {
    /// The answer arrived.
    Answered,
    /// The target received a corrupted request.
    Corrupted,
    /// No answer arrived in time.
    TimedOut,
}

impl<L: Link> Client<L> {
    /// Creates a client whose first session number is `session` plus one. A random number avoids confusion with the
    /// previous run.
    pub fn new(link: L, retry_limits: RetryLimits, session: u16) -> Self {
        Self {
            link,
            retry_limits,
            patience: Patience::Tries,
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

    /// Faults detected so far.
    pub fn faults(&self) -> LinkFaults {
        self.faults
    }

    /// Returns the link.
    pub fn link(&mut self) -> &mut L {
        &mut self.link
    }

    /// How long requests wait for their answers.
    pub(super) fn patience(&self) -> Patience {
        self.patience
    }

    /// Sets how long requests wait for their answers. Only [`Patience::Tries`] repeats a request without an answer.
    pub(super) fn set_patience(&mut self, patience: Patience) {
        self.patience = patience;
    }

    /// Opens a new session.
    ///
    /// # Errors
    /// The target does not answer, uses another protocol, or its dampers differ from those of this host in single
    /// precision.
    pub fn hello(&mut self) -> Result<Welcome<'_>, LinkError> {
        let hello = Request::Hello { protocol: PROTOCOL };
        let mut tries = 1;
        loop {
            self.header.session = self.header.session.wrapping_add(1);
            match self.exchange(&hello) {
                Err(LinkError::SessionLost) if tries < MAX_SESSIONS => tries += 1,
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

    /// Sends a request until it is answered. The target executes it once, even if it is sent repeatedly.
    ///
    /// # Errors
    /// The target does not answer or refuses the request.
    pub fn request(&mut self, request: &Request<'_>) -> Result<Response<'_>, LinkError> {
        self.exchange(request)?;
        self.response()
    }

    /// Sends a request until it is answered; a refusal is an error.
    fn exchange(&mut self, request: &Request<'_>) -> Result<(), LinkError> {
        self.header.sequence = self.header.sequence.wrapping_add(1);
        let frame = request_frame(self.header, request);
        let frame = frame.bytes();
        if frame.is_empty() {
            return Err(LinkError::TooLong);
        }
        let wait = self.retry_limits.for_frame(frame.len());
        let start = self.link.now();
        let mut corrupted = 0;
        let mut limits = self.retry_limits;
        for repeat in 0..self.retry_limits.tries.max(1) {
            self.faults.repeated_requests += u64::from(repeat > 0);
            let sent = self.link.now();
            self.link.send(frame)?;
            let grown = wait.saturating_mul(self.back_off).min(MAX_GROWN_WAIT);
            let time = match self.patience {
                Patience::Tries => grown.max(wait),
                Patience::FirstWait => wait,
                Patience::Until(end) => end.saturating_duration_since(self.link.now()),
            };
            match self.wait(time)? {
                WaitResult::Answered => {
                    // After a repeat, it is unknown which try was answered and therefore how long the answer took.
                    if repeat == 0 && self.patience == Patience::Tries {
                        let took = self.link.now().saturating_duration_since(sent);
                        self.shorten_wait(took, wait);
                    }
                    self.late_repeats = repeat - corrupted;
                    return match self.response()? {
                        Response::Refused(Refusal::NoSession | Refusal::OutOfOrder(_)) => {
                            self.faults.lost_sessions += 1;
                            Err(LinkError::SessionLost)
                        }
                        Response::Refused(refusal) => Err(LinkError::Refused(refusal)),
                        _ => Ok(()),
                    };
                }
                WaitResult::Corrupted => corrupted += 1,
                WaitResult::TimedOut if self.patience != Patience::Tries => {
                    limits.tries = repeat + 1;
                    break;
                }
                WaitResult::TimedOut => self.back_off = (2 * self.back_off).min(MAX_BACK_OFF),
            }
        }
        self.late_repeats = limits.tries.max(1) - corrupted;
        Err(LinkError::Silent {
            limits,
            waited: self.link.now().saturating_duration_since(start),
        })
    }

    /// Shortens the waits to twice the time that the last answer took, but by at most half.
    fn shorten_wait(&mut self, took: Duration, wait: Duration) {
        let needed = (1..MAX_BACK_OFF).find(|factor| wait.saturating_mul(*factor) >= 2 * took);
        let needed = needed.unwrap_or(MAX_BACK_OFF);
        self.back_off = needed.max(self.back_off / 2).max(1);
    }

    /// Parses the last answer.
    fn response(&self) -> Result<Response<'_>, LinkError> {
        let answer = parse(&self.answer).ok_or(LinkError::Unreadable)?;
        Ok(answer.1)
    }

    /// Waits at most `time` for the answer to the last request.
    fn wait(&mut self, time: Duration) -> Result<WaitResult, LinkError> {
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
                    // Answers arrive in the order of the requests. This refusal may answer a repeat of an earlier
                    // request if the busy target dropped part of the repeat.
                    if self.late_repeats > 0 {
                        self.late_repeats -= 1;
                        continue;
                    }
                    self.received = received[index + 1..].to_vec();
                    return Ok(WaitResult::Corrupted);
                }
                if header == self.header {
                    self.answer = message.to_vec();
                    self.received = received[index + 1..].to_vec();
                    return Ok(WaitResult::Answered);
                }
                self.late_repeats = self.late_repeats.saturating_sub(1);
                self.faults.stale_answers += 1;
            }
            let left = deadline.saturating_duration_since(self.link.now());
            let mut buffer = [0; 1024];
            let count = self.link.receive(&mut buffer, left)?;
            if count == 0 {
                self.faults.timeouts += 1;
                return Ok(WaitResult::TimedOut);
            }
            self.received.extend_from_slice(&buffer[..count]);
        }
    }
}

fn parse(message: &[u8]) -> Option<(Header, Response<'_>)> {
    postcard::from_bytes(message).ok()
}
