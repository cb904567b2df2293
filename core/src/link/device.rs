//! The device end of the link: takes bytes and ticks, returns responses.

use super::board::{Line, Outputs};
use super::exchange::{Exchange, Served, answer};
use super::frame::{FrameReader, REQUEST_BYTES, ResponseFrame};
use super::load::Load;
use super::loaded::StepSizeError;
use super::message::{Counters, Response};
use super::refusal::Refusal;
use super::service::{Clock, Service, count};
use super::session::Session;
use crate::damper::Damper;
use crate::state::DamperState;

/// Largest number of bytes read from the line before the next check for ticks.
const BYTES_PER_PASS: usize = 32;

/// A bank of `N` dampers behind a serial link. The first `WATCHED` dampers can have a health estimate.
///
/// All bits are zero until [`Device::start`], so a static variable takes no flash. It needs 22 KB, plus 13 KB for each
/// damper and 2.7 KB (2.6 KiB) for each watched damper. The firmware calls [`Device::poll`] in a loop.
///
/// After power on and after [`Request::Stop`](super::Request::Stop) the host determines the ticks: each step request is
/// one tick. After [`Request::Run`](super::Request::Run) the timer of the firmware determines the ticks.
///
/// ```
/// use dashpot_core::Damper;
/// use dashpot_core::link::{Clock, Device, Header, Line, Outputs, PROTOCOL, Request, request_frame};
///
/// /// A host that sends a hello and counts the bytes of the response.
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
/// device.start(&[&DAMPER; 2], Clock::new(|| 0, 1_000_000))?;
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
#[repr(C)] // the fields used for every byte come first, where one instruction can address them
pub struct Device<const N: usize, const WATCHED: usize = 0> {
    /// Number of bytes at the end of the response that are not sent yet.
    unsent: usize,
    answers_with_notice: bool,
    intake: Intake,
    reader: FrameReader<REQUEST_BYTES>,
    /// The load in progress, if any. This is not an `Option`, because the bits of `None` may not be zero.
    load: Load,
    session: Session,
    /// Response to the last request of the session, for repeated requests.
    stored: ResponseFrame,
    /// Response to any other message.
    notice: ResponseFrame,
    service: Service<N, WATCHED>,
}

/// No health model is loaded for a damper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no health model is loaded for this damper")]
#[non_exhaustive]
pub struct NotWatched;

/// How a byte is handled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Intake {
    /// The byte belongs to a frame.
    Frames,
    /// The byte is dropped because an image is being loaded from the frame buffer.
    Loading,
    /// Like [`Intake::Loading`], and the last dropped byte did not end its frame.
    LoadingWithinFrame,
    /// The loading has ended. The rest of a frame that began during the loading is dropped.
    Dropping,
}

impl<const N: usize, const WATCHED: usize> Default for Device<N, WATCHED> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize, const WATCHED: usize> Device<N, WATCHED> {
    /// A device without dampers: all bits are zero.
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

    /// Starts with copies of `dampers` at rest at 0, which the host steps. `clock` measures the duration of the steps.
    ///
    /// # Errors
    /// The dampers are built for different step sizes; the device is unchanged.
    pub fn start(
        &mut self,
        dampers: &[&Damper<f32>; N],
        clock: Clock,
    ) -> Result<(), StepSizeError> {
        self.service.start(dampers, clock)
    }

    /// Runs one pass of the firmware's loop. Never blocks.
    ///
    /// Runs the `due` ticks that the timer counted since the last pass. Then it does one thing for the link: sends
    /// bytes, loads a slice of an image, or reads bytes. It drives the outputs whenever they may have changed.
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

    /// Reads bytes from the line until there is a response, no byte is left, or the limit of a pass is reached. Returns
    /// true if there is a response to send.
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

    /// Takes a byte of the link. Returns true if there is a response, which must be sent before the next byte is taken.
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

    /// Drops a byte that arrived during loading, and the rest of its frame.
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

    /// True while an image is being loaded. Bytes that arrive then are dropped.
    pub fn is_busy(&self) -> bool {
        matches!(self.intake, Intake::Loading | Intake::LoadingWithinFrame)
    }

    /// True while [`Device::poll`] has bytes of a response to send.
    pub fn is_sending(&self) -> bool {
        self.unsent > 0
    }

    /// Loads the next slice of an image. Returns true if there is a response to send.
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

    /// Answers a corrupt frame.
    #[inline(never)]
    fn corrupt(&mut self) -> bool {
        count(&mut self.service.counters.corrupt);
        self.answers_with_notice = true;
        answer(self.session.last(), Err(Refusal::Corrupt), &mut self.notice);
        true
    }

    /// Response to send: a whole frame.
    pub fn response(&self) -> &[u8] {
        if self.answers_with_notice {
            self.notice.bytes()
        } else {
            self.stored.bytes()
        }
    }

    /// Runs each of the `due` ticks that the timer counted since the last call. Ticks beyond the first are counted as
    /// overruns. Does nothing while the host steps.
    pub fn tick(&mut self, due: u32) {
        self.service.tick(due);
    }

    /// Takes a sample of a real damper from sensors of this board. Call it once in each step.
    ///
    /// The displacement (m) is positive in extension, the force (N) when it resists extension. The host reads the
    /// estimate over the link.
    ///
    /// # Errors
    /// No health model is loaded for the damper of this index; nothing changes.
    #[inline]
    pub fn push_measurement(
        &mut self,
        damper: usize,
        displacement_m: f32,
        force_n: f32,
    ) -> Result<(), NotWatched> {
        let watched = &mut self.service.watched;
        if watched.sample(damper, displacement_m, force_n) {
            Ok(())
        } else {
            Err(NotWatched)
        }
    }

    /// Forces for the actuators (N): those of the last tick, or the safe outputs; 0 when stopped.
    pub fn outputs_n(&self) -> &[f32; N] {
        self.service.outputs_n()
    }

    /// Number of ticks since the dampers were put at rest.
    pub fn tick_number(&self) -> u32 {
        self.service.loaded().tick()
    }

    /// States of the dampers.
    pub fn states(&self) -> &[DamperState<f32>; N] {
        self.service.loaded().states()
    }

    /// Step of the dampers (s): the period of the ticks.
    pub fn step_s(&self) -> f32 {
        self.service.loaded().step_s()
    }

    /// Counters since power on.
    pub fn counters(&self) -> Counters {
        self.service.counters
    }
}
