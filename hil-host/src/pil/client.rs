//! The host's end of the link: one request at a time, repeated until it is answered.

use std::fmt;
use std::time::{Duration, Instant};

use dashpot_core::link::{
    FrameReader, Header, PROTOCOL, RESPONSE_BYTES, Refusal, Request, Response, Welcome,
    request_frame,
};
use serde::Serialize;

use super::Link;
use crate::failure::Failure;

/// How long to wait for an answer, and how often to ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patience {
    /// Wait for each try.
    pub timeout: Duration,
    /// Tries of a request, 1 at least.
    pub tries: u32,
}

impl Default for Patience {
    /// Eight tries of a fifth of a second.
    fn default() -> Self {
        Self {
            timeout: Duration::from_millis(200),
            tries: 8,
        }
    }
}

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
    /// Answers to requests no longer asked.
    pub stale_answers: u64,
    /// Sessions that the target no longer knew, as after a reset.
    pub lost_sessions: u64,
}

/// Why a request has no result.
#[derive(Clone, Debug, PartialEq)]
pub enum LinkError {
    /// The line itself failed.
    Broken(Failure),
    /// No answer to any try.
    Silent(Patience),
    /// The target does not know the session: it was reset.
    SessionLost,
    /// The target said no.
    Refused(Refusal),
    /// An answer that is none of this protocol.
    Unreadable,
}

impl fmt::Display for LinkError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Broken(failure) => write!(f, "{failure}"),
            Self::Silent(patience) => write!(
                f,
                "no answer from the target to {} tries of {} ms",
                patience.tries,
                patience.timeout.as_millis()
            ),
            Self::SessionLost => f.write_str("the target was reset"),
            Self::Refused(Refusal::Protocol(version)) => write!(
                f,
                "the target speaks version {version} of the link protocol, this host {PROTOCOL}"
            ),
            Self::Refused(Refusal::StepSize) => {
                f.write_str("the target refused a damper built for another step")
            }
            Self::Refused(Refusal::Image) => f.write_str(
                "the target refused the damper's image as damaged or of another version",
            ),
            Self::Refused(Refusal::Running) => {
                f.write_str("the target's tick runs free; stop or reset the target first")
            }
            Self::Refused(refusal) => write!(f, "the target refused: {refusal:?}"),
            Self::Unreadable => f.write_str("the target answers in another protocol"),
        }
    }
}

impl From<LinkError> for Failure {
    fn from(error: LinkError) -> Self {
        Self::new(error.to_string())
    }
}

/// Asks a target over a link.
pub struct Client<L> {
    link: L,
    patience: Patience,
    header: Header,
    faults: LinkFaults,
    reader: FrameReader<RESPONSE_BYTES>,
    received: Vec<u8>,
    answer: Vec<u8>,
}

impl<L: Link> Client<L> {
    /// A client whose first session is the one after `session`; a number drawn for each run keeps it apart
    /// from the last run's.
    pub fn new(link: L, patience: Patience, session: u16) -> Self {
        Self {
            link,
            patience,
            header: Header {
                session,
                sequence: 0,
            },
            faults: LinkFaults::default(),
            reader: FrameReader::new(),
            received: Vec::new(),
            answer: Vec::new(),
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
    /// No answer, or a target of another protocol.
    pub fn hello(&mut self) -> Result<Welcome<'_>, LinkError> {
        self.header.session = self.header.session.wrapping_add(1);
        match self.request(&Request::Hello { protocol: PROTOCOL })? {
            Response::Welcome(welcome) => Ok(welcome),
            _ => Err(LinkError::Unreadable),
        }
    }

    /// Asks until there is an answer. The target carries the request out once, however often it is sent.
    ///
    /// # Errors
    /// No answer, or a refusal.
    pub fn request(&mut self, request: &Request<'_>) -> Result<Response<'_>, LinkError> {
        self.header.sequence = self.header.sequence.wrapping_add(1);
        let frame = request_frame(self.header, request);
        if frame.bytes().is_empty() {
            return Err(LinkError::Broken(Failure::new(
                "a request is too long for a frame",
            )));
        }
        for again in 0..self.patience.tries.max(1) {
            self.faults.repeated_requests += u64::from(again > 0);
            self.link.send(frame.bytes()).map_err(LinkError::Broken)?;
            if self.wait()? {
                return match parse(&self.answer) {
                    Some((_, Response::Refused(Refusal::NoSession | Refusal::OutOfOrder(_)))) => {
                        self.faults.lost_sessions += 1;
                        Err(LinkError::SessionLost)
                    }
                    Some((_, Response::Refused(refusal))) => Err(LinkError::Refused(refusal)),
                    Some((_, response)) => Ok(response),
                    None => Err(LinkError::Unreadable),
                };
            }
        }
        Err(LinkError::Silent(self.patience))
    }

    /// Waits for the answer to the last request; false when it should be sent again.
    fn wait(&mut self) -> Result<bool, LinkError> {
        let deadline = Instant::now() + self.patience.timeout;
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
                    self.received = received[index + 1..].to_vec();
                    return Ok(false);
                }
                if header == self.header {
                    self.answer = message.to_vec();
                    self.received = received[index + 1..].to_vec();
                    return Ok(true);
                }
                self.faults.stale_answers += 1;
            }
            let left = deadline.saturating_duration_since(Instant::now());
            let mut buffer = [0; 1024];
            let count = self
                .link
                .receive(&mut buffer, left)
                .map_err(LinkError::Broken)?;
            if count == 0 {
                self.faults.timeouts += 1;
                return Ok(false);
            }
            self.received.extend_from_slice(&buffer[..count]);
        }
    }
}

fn parse(message: &[u8]) -> Option<(Header, Response<'_>)> {
    postcard::from_bytes(message).ok()
}
