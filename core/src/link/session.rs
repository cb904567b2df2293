//! Which request is next: sequence numbers, repeated requests, sessions.

use super::message::Header;
use super::refusal::Refusal;

/// The open session and its last request.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Session {
    last: Option<(Header, u32)>,
}

/// What to do with a request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// Carry it out.
    Next,
    /// Give the stored response again.
    Repeated,
    /// Of a session that is not open.
    NoSession,
    /// Not the next one of the session.
    OutOfOrder(u32),
}

impl Session {
    /// None is open.
    pub(crate) const NONE: Self = Self { last: None };

    /// Judges a request by its header and the CRC-32 of its message: a repeated one is the last one to
    /// the bit.
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

    /// Takes a request as the last one; a hello opens its session with it.
    pub(crate) fn advance(&mut self, header: Header, check: u32) {
        self.last = Some((header, check));
    }

    /// Header of the last request.
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
