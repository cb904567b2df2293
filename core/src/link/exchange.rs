//! Handles a message of the host: checks it, carries it out and answers it.

use super::frame::{Message, ResponseFrame};
use super::load::{Load, Progress};
use super::message::{Header, Request, Response};
use super::refusal::Refusal;
use super::service::{Service, count};
use super::session::{Session, Verdict};
use crate::encoding::Loading;
use crate::health::HealthLoading;

/// Result of handling a message.
pub(super) enum Served {
    /// Send the stored response.
    Stored,
    /// Send the notice.
    Notice,
    /// Load an image first.
    Loads(Load),
}

/// Session, service and response frames for handling a message.
pub(super) struct Exchange<'a, const N: usize, const WATCHED: usize> {
    pub(super) session: &'a mut Session,
    pub(super) service: &'a mut Service<N, WATCHED>,
    pub(super) stored: &'a mut ResponseFrame,
    pub(super) notice: &'a mut ResponseFrame,
}

impl<const N: usize, const WATCHED: usize> Exchange<'_, N, WATCHED> {
    /// Checks a message, carries it out and answers it.
    #[inline(never)]
    pub(super) fn serve(self, message: Message<'_>) -> Served {
        let counters = &mut self.service.counters;
        let Ok((header, body)) = postcard::take_from_bytes::<Header>(message.bytes) else {
            count(&mut counters.unreadable);
            answer(self.session.last(), Err(Refusal::Unreadable), self.notice);
            return Served::Notice;
        };
        let request = match postcard::take_from_bytes::<Request<'_>>(body) {
            Ok((request, [])) => Some(request),
            _ => None,
        };
        let verdict = self.session.judge(header, message.check);
        let opens = matches!(request, Some(Request::Hello { .. })) && verdict == Verdict::NoSession;
        let counter = match verdict {
            Verdict::Repeated => {
                count(&mut counters.repeated);
                return Served::Stored;
            }
            Verdict::OutOfOrder(_) => &mut counters.out_of_order,
            Verdict::NoSession if !opens => &mut counters.no_session,
            _ => return self.carry_out(header, message, request, opens),
        };
        count(counter);
        answer(header, Err(verdict.refusal()), self.notice);
        Served::Notice
    }

    fn carry_out(
        self,
        header: Header,
        message: Message<'_>,
        request: Option<Request<'_>>,
        opens: bool,
    ) -> Served {
        let Some(request) = request else {
            count(&mut self.service.counters.unreadable);
            self.session.advance(header, message.check);
            answer(header, Err(Refusal::Unreadable), self.stored);
            return Served::Stored;
        };
        let done = self.service.execute(&request);
        let carried_out = done.is_ok();
        let frame = if opens && !carried_out {
            // A hello with another protocol version opens no session.
            self.notice
        } else {
            self.session.advance(header, message.check);
            let loads = match request {
                Request::Load { damper, image } => {
                    Some((damper, image, Progress::Damper(Loading::START)))
                }
                Request::LoadHealth { damper, image } => {
                    Some((damper, image, Progress::Health(HealthLoading::START)))
                }
                _ => None,
            };
            if let Some((damper, image, progress)) = loads.filter(|_| carried_out) {
                // The image is at the end of the message.
                let end = message.bytes.len();
                return Served::Loads(Load {
                    header,
                    damper,
                    image: end.saturating_sub(image.len())..end,
                    progress,
                });
            }
            self.stored
        };
        answer(header, done, frame);
        self.service.count_done(carried_out);
        if opens && !carried_out {
            Served::Notice
        } else {
            Served::Stored
        }
    }
}

/// Writes a response as a frame.
#[inline(never)]
pub(super) fn answer(
    header: Header,
    done: Result<Response<'_>, Refusal>,
    frame: &mut ResponseFrame,
) {
    let refused;
    let response = match &done {
        Ok(response) => response,
        Err(refusal) => {
            refused = Response::Refused(*refusal);
            &refused
        }
    };
    // Every response fits, as the test `the_longest_messages_fit` shows.
    let _ = frame.write(&(header, response));
}
