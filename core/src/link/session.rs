//! Order of requests: sequence numbers, repeated requests and sessions.

use super::message::Header;
use super::refusal::Refusal;

/// The open session and its last request.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Session {
    last: Option<(Header, u32)>,
}

/// How to handle a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// Carry it out.
    Next,
    /// Send the stored response again.
    Repeated,
    /// Refuse it: its session is not open.
    NoSession,
    /// Refuse it: this sequence number is expected.
    OutOfOrder(u32),
}

impl Session {
    /// No session is open.
    pub(crate) const NONE: Self = Self { last: None };

    /// Uses the header of a request and the CRC-32 of its message to decide how to handle it. A repeated request is
    /// identical to the last one.
    pub(crate) fn judge(&self, header: Header, check: u32) -> Verdict {
        let Some((last, last_check)) = self.last else {
            return Verdict::NoSession;
        };
        let expected = last.sequence.wrapping_add(1);
        if header.session != last.session {
            Verdict::NoSession
        } else if header.sequence == expected {
            Verdict::Next
        } else if header == last && check == last_check {
            Verdict::Repeated
        } else {
            Verdict::OutOfOrder(expected)
        }
    }

    /// Records a request as the last one. A hello opens its session.
    pub(crate) fn advance(&mut self, header: Header, check: u32) {
        self.last = Some((header, check));
    }

    /// Returns the header of the last request.
    pub(crate) fn last(&self) -> Header {
        self.last.map(|(header, _)| header).unwrap_or_default()
    }
}

impl Verdict {
    pub(crate) fn refusal(self) -> Refusal {
        match self {
            Self::OutOfOrder(expected) => Refusal::OutOfOrder(expected),
            _ => Refusal::NoSession,
        }
    }
}
