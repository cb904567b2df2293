//! The device's end of the link: bytes in, responses out, ticks.

use super::frame::{Frame, FrameReader, Message};
use super::message::{Counters, Header, Refusal, Request, Response};
use super::service::{Clock, Service, count};
use super::session::{Session, Verdict};
use crate::damper::Damper;

/// A bank of `N` dampers behind a serial link.
///
/// Feed every byte of the link to [`Device::receive`]; when it returns true, send
/// [`Device::response`] before the next byte is fed. Call [`Device::tick`] at the dampers' step. While the host steps
/// (after power on, and after [`Request::Stop`]) time is the tick of its step requests and
/// [`Device::tick`] does nothing; after [`Request::Run`] each call is one tick.
///
/// ```
/// use dashpot_core::Damper;
/// use dashpot_core::link::{Clock, Device, Frame, Header, PROTOCOL, Request};
///
/// static DAMPER: Damper<f32> = Damper::<f32>::from_words(&[0; Damper::<f32>::WORDS]);
/// let clock = Clock { now: || 0, hz: 1_000_000 };
/// let mut device = Device::new(&[&DAMPER; 2], clock);
///
/// let mut hello = Frame::new();
/// hello.write(&(Header { session: 1, sequence: 1 }, Request::Hello { protocol: PROTOCOL }));
/// let answered = hello.bytes().iter().filter(|byte| device.receive(**byte)).count();
/// assert_eq!(answered, 1);
/// assert_eq!(device.response().last(), Some(&0)); // a frame
/// assert_eq!(device.counters().accepted, 1);
/// ```
#[derive(Clone, Debug)]
pub struct Device<const N: usize> {
    reader: FrameReader,
    session: Session,
    service: Service<N>,
    /// Response to the last request of the session, kept to be given again.
    stored: Frame,
    /// Response to anything else.
    notice: Frame,
    answers_with_notice: bool,
}

impl<const N: usize> Device<N> {
    /// A device that holds copies of `dampers`, at rest at 0, the host stepping; the step is that of the
    /// first damper. Steps are measured by `clock`.
    pub fn new(dampers: &[&Damper<f32>; N], clock: Clock) -> Self {
        Self {
            reader: FrameReader::new(),
            session: Session::default(),
            service: Service::new(dampers, clock),
            stored: Frame::new(),
            notice: Frame::new(),
            answers_with_notice: false,
        }
    }

    /// Takes a byte of the link; true when there is a response to send.
    #[inline]
    pub fn receive(&mut self, byte: u8) -> bool {
        match self.reader.push(byte) {
            None => return false,
            Some(Err(_)) => {
                count(&mut self.service.counters.corrupt);
                self.answers_with_notice = true;
                answer(self.session.last(), Err(Refusal::Corrupt), &mut self.notice);
            }
            Some(Ok(message)) => {
                let (session, service) = (&mut self.session, &mut self.service);
                self.answers_with_notice = serve(
                    message,
                    session,
                    service,
                    &mut self.stored,
                    &mut self.notice,
                );
            }
        }
        true
    }

    /// The response to send: a whole frame.
    pub fn response(&self) -> &[u8] {
        if self.answers_with_notice {
            self.notice.bytes()
        } else {
            self.stored.bytes()
        }
    }

    /// Runs the `due` ticks that the timer counted since the last call, each one; more than one are
    /// counted as overruns. Nothing while the host steps.
    pub fn tick(&mut self, due: u32) {
        self.service.tick(due);
    }

    /// Forces (N) for the actuators: of the last tick, or the safe output; 0 when stopped.
    pub fn outputs_n(&self) -> &[f32; N] {
        self.service.outputs_n()
    }

    /// Step of the dampers (s): the period of [`Device::tick`].
    pub fn step_s(&self) -> f32 {
        self.service.step_s()
    }

    /// What happened so far.
    pub fn counters(&self) -> Counters {
        self.service.counters
    }
}

/// Judges and carries out a message; whether the answer is the notice.
#[inline(never)]
fn serve<const N: usize>(
    message: Message<'_>,
    session: &mut Session,
    service: &mut Service<N>,
    stored: &mut Frame,
    notice: &mut Frame,
) -> bool {
    let Ok((header, body)) = postcard::take_from_bytes::<Header>(message.bytes) else {
        count(&mut service.counters.unreadable);
        answer(session.last(), Err(Refusal::Unreadable), notice);
        return true;
    };
    let request = match postcard::take_from_bytes::<Request<'_>>(body) {
        Ok((request, [])) => Some(request),
        _ => None,
    };
    let verdict = session.judge(header, message.check);
    let opens = matches!(request, Some(Request::Hello { .. })) && verdict == Verdict::NoSession;
    match verdict {
        Verdict::Repeated => {
            count(&mut service.counters.repeated);
            return false;
        }
        Verdict::NoSession if !opens => count(&mut service.counters.no_session),
        Verdict::OutOfOrder(_) => count(&mut service.counters.out_of_order),
        _ => {
            let Some(request) = request else {
                count(&mut service.counters.unreadable);
                session.advance(header, message.check);
                answer(header, Err(Refusal::Unreadable), stored);
                return false;
            };
            let done = service.execute(&request);
            let refused = done.is_err();
            if opens && refused {
                // Another protocol: no session is opened.
                answer(header, done, notice);
                count(&mut service.counters.refused);
                return true;
            }
            session.advance(header, message.check);
            answer(header, done, stored);
            count(if refused {
                &mut service.counters.refused
            } else {
                &mut service.counters.accepted
            });
            return false;
        }
    }
    answer(header, Err(verdict.refusal()), notice);
    true
}

/// Writes a response as a frame.
#[inline(never)]
fn answer(header: Header, done: Result<Response<'_>, Refusal>, frame: &mut Frame) {
    let refused;
    let response = match &done {
        Ok(response) => response,
        Err(refusal) => {
            refused = Response::Refused(*refusal);
            &refused
        }
    };
    // Every response fits: see the test `the_longest_messages_fit`.
    let _ = frame.write(&(header, response));
}
