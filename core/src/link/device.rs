//! The device's end of the link: bytes in, responses out, ticks.

use super::board::{Line, Outputs};
use super::exchange::{Exchange, Load, Served, answer};
use super::frame::{FrameReader, REQUEST_BYTES, ResponseFrame};
use super::loaded::StepSizeError;
use super::message::{Counters, Response};
use super::refusal::Refusal;
use super::service::{Clock, Service, count};
use super::session::Session;
use crate::damper::Damper;
use crate::state::DamperState;

/// Bytes taken of the line before ticks are looked at again.
const BYTES_PER_PASS: usize = 32;

/// A bank of `N` dampers behind a serial link, the first `WATCHED` of which may have an estimate of their health.
///
/// Of zeros until [`Device::start`], so it lies in static storage that takes no flash and is never moved: 22 KB,
/// 13 KB a damper and 2.4 KB a watched one. A firmware calls [`Device::poll`] in a loop. While the host steps (after power on, and after
/// [`Request::Stop`](super::Request::Stop)) time is the tick of its step requests; after [`Request::Run`](super::Request::Run) it is that of the ticks due.
///
/// ```
/// use dashpot_core::Damper;
/// use dashpot_core::link::{Clock, Device, Header, Line, Outputs, PROTOCOL, Request, request_frame};
///
/// /// A host that says hello, and counts the bytes it gets back.
/// struct Host(std::vec::IntoIter<u8>, usize);
/// impl Line for Host {
///     fn receive(&mut self) -> Option<u8> {
///         self.0.next()
///     }
///     fn send(&mut self, _: u8) -> bool {
///         self.1 += 1;
///         true
///     }
/// }
/// struct Actuators([f32; 2]);
/// impl Outputs<2> for Actuators {
///     fn drive(&mut self, forces_n: &[f32; 2]) {
///         self.0 = *forces_n;
///     }
/// }
///
/// static DAMPER: Damper<f32> = Damper::<f32>::from_words(&[0; Damper::<f32>::WORDS]);
/// let mut device = Box::new(Device::<2>::new()); // in firmware a static
/// device.start(&[&DAMPER; 2], Clock { now: || 0, hz: 1_000_000 })?;
///
/// let hello = Request::Hello { protocol: PROTOCOL };
/// let hello = request_frame(Header { session: 1, sequence: 1 }, &hello);
/// let mut host = Host(hello.bytes().to_vec().into_iter(), 0);
/// let mut actuators = Actuators([f32::NAN; 2]);
/// for _ in 0..100 {
///     device.poll(0, &mut host, &mut actuators);
/// }
/// assert_eq!(device.counters().accepted, 1);
/// assert_eq!((host.1, actuators.0), (device.response().len(), [0.0; 2]));
/// # Ok::<(), dashpot_core::link::StepSizeError>(())
/// ```
#[derive(Debug)]
#[repr(C)] // what every byte needs first, where an instruction reaches it
pub struct Device<const N: usize, const WATCHED: usize = 0> {
    /// Bytes of the response still to send, from the end.
    unsent: usize,
    answers_with_notice: bool,
    intake: Intake,
    reader: FrameReader<REQUEST_BYTES>,
    /// The load that is under way while loading: as an option it would not be of zeros.
    load: Load,
    session: Session,
    /// Response to the last request of the session, kept to be given again.
    stored: ResponseFrame,
    /// Response to anything else.
    notice: ResponseFrame,
    service: Service<N, WATCHED>,
}

/// What becomes of a byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Intake {
    /// It belongs to a frame.
    Frames,
    /// It is dropped, for an image is being loaded from the buffer of the frames.
    Loading,
    /// As [`Intake::Loading`], within a frame.
    LoadingWithinFrame,
    /// It is dropped until its frame ends.
    Dropping,
}

impl<const N: usize, const WATCHED: usize> Default for Device<N, WATCHED> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize, const WATCHED: usize> Device<N, WATCHED> {
    /// All bits zero: without dampers until it is started.
    pub const fn new() -> Self {
        Self {
            unsent: 0,
            answers_with_notice: false,
            intake: Intake::Frames,
            reader: FrameReader::new(),
            load: Load::NONE,
            session: Session::NONE,
            stored: ResponseFrame::new(),
            notice: ResponseFrame::new(),
            service: Service::new(),
        }
    }

    /// Takes copies of `dampers`, at rest at 0, the host stepping. Steps are measured by `clock`.
    ///
    /// # Errors
    /// The dampers are not all built for one step; the device is as it was.
    pub fn start(
        &mut self,
        dampers: &[&Damper<f32>; N],
        clock: Clock,
    ) -> Result<(), StepSizeError> {
        self.service.start(dampers, clock)
    }

    /// One pass of a firmware's loop: runs the `due` ticks that the timer counted since the last pass, then does
    /// one thing for the link: sends what the line takes, loads a slice of a damper, or takes what the line has.
    /// Drives the outputs when they may have changed. Never waits.
    pub fn poll(&mut self, due: u32, line: &mut impl Line, outputs: &mut impl Outputs<N>) {
        if due > 0 {
            self.tick(due);
            outputs.drive(self.outputs_n());
        }
        if self.unsent > 0 {
            let response = self.response();
            let unsent = response.get(response.len().wrapping_sub(self.unsent)..);
            let unsent = unsent.unwrap_or_default();
            let sent = unsent.iter().take_while(|byte| line.send(**byte)).count();
            self.unsent = unsent.len() - sent;
            return;
        }
        let answered = if self.is_busy() {
            self.advance()
        } else {
            self.receive_waiting(line)
        };
        if answered {
            self.unsent = self.response().len();
            outputs.drive(self.outputs_n());
        }
    }

    /// Takes bytes of the line until there is a response to send, or none waits, or it took as many as a pass may.
    #[inline]
    fn receive_waiting(&mut self, line: &mut impl Line) -> bool {
        for _ in 0..BYTES_PER_PASS {
            match line.receive() {
                Some(byte) if self.receive(byte) => return true,
                Some(_) => {}
                None => return false,
            }
        }
        false
    }

    /// Takes a byte of the link; true when there is a response to send, before the next byte is taken.
    #[inline]
    pub fn receive(&mut self, byte: u8) -> bool {
        if self.intake != Intake::Frames {
            return self.drop_byte(byte);
        }
        self.reader.take(byte) && self.end_frame()
    }

    #[inline(never)]
    fn end_frame(&mut self) -> bool {
        let Ok(message) = self.reader.message() else {
            return self.corrupt();
        };
        let exchange = Exchange {
            session: &mut self.session,
            service: &mut self.service,
            stored: &mut self.stored,
            notice: &mut self.notice,
        };
        match exchange.serve(message) {
            Served::Stored => self.answers_with_notice = false,
            Served::Notice => self.answers_with_notice = true,
            Served::Loads(load) => {
                (self.load, self.intake) = (load, Intake::Loading);
                return false;
            }
        }
        true
    }

    /// Drops a byte that came while an image was being loaded, and what belongs to its frame.
    #[cold]
    fn drop_byte(&mut self, byte: u8) -> bool {
        self.intake = match (self.intake, byte) {
            (Intake::Loading | Intake::LoadingWithinFrame, 0) => Intake::Loading,
            (Intake::Loading | Intake::LoadingWithinFrame, _) => Intake::LoadingWithinFrame,
            (_, 0) => {
                self.intake = Intake::Frames;
                return self.corrupt();
            }
            (other, _) => other,
        };
        false
    }

    /// Whether an image is being loaded: bytes that come meanwhile are dropped.
    pub fn is_busy(&self) -> bool {
        matches!(self.intake, Intake::Loading | Intake::LoadingWithinFrame)
    }

    /// Whether bytes of the response are still to be sent by [`Device::poll`].
    pub fn is_sending(&self) -> bool {
        self.unsent > 0
    }

    /// Loads the next slice of an image; true when there is a response to send.
    pub fn advance(&mut self) -> bool {
        if !self.is_busy() {
            return false;
        }
        let load = &mut self.load;
        let image = self.reader.last_message(load.image.clone());
        let loaded = self
            .service
            .load_slice(load.damper, image, &mut load.progress);
        if loaded == Ok(false) {
            return false;
        }
        let header = load.header;
        self.intake = match self.intake {
            Intake::LoadingWithinFrame => Intake::Dropping,
            _ => Intake::Frames,
        };
        self.service.count_done(loaded.is_ok());
        answer(header, loaded.map(|_| Response::Done), &mut self.stored);
        self.answers_with_notice = false;
        true
    }

    /// A frame was broken on the way.
    #[inline(never)]
    fn corrupt(&mut self) -> bool {
        count(&mut self.service.counters.corrupt);
        self.answers_with_notice = true;
        answer(self.session.last(), Err(Refusal::Corrupt), &mut self.notice);
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

    /// Takes a sample of the real damper that a place stands for, as sensors of this board measure it: displacement
    /// (m), positive in extension, and force (N), positive when it resists extension, once in each step. False, and
    /// nothing done, where no model of health was loaded. What came of it is read over the link.
    #[inline]
    pub fn measured(&mut self, place: usize, displacement_m: f32, force_n: f32) -> bool {
        let watched = &mut self.service.watched;
        watched.sample(place, displacement_m, force_n)
    }

    /// Forces (N) for the actuators: of the last tick, or the safe output; 0 when stopped.
    pub fn outputs_n(&self) -> &[f32; N] {
        self.service.outputs_n()
    }

    /// Ticks since the dampers were put at rest.
    pub fn tick_number(&self) -> u32 {
        self.service.loaded().tick()
    }

    /// State of each damper.
    pub fn states(&self) -> &[DamperState<f32>; N] {
        self.service.loaded().states()
    }

    /// Step of the dampers (s): the period of the ticks.
    pub fn step_s(&self) -> f32 {
        self.service.loaded().step_s()
    }

    /// What happened so far.
    pub fn counters(&self) -> Counters {
        self.service.counters
    }
}
