//! A simulated target, and the motion that drives it.

// Each test binary uses only some of these functions.
#![allow(dead_code)]

use std::collections::VecDeque;
use std::io::{ErrorKind, Read, Write};
use std::net::{Ipv4Addr, TcpListener};
use std::time::Duration;

use dashpot_core::Damper;
use dashpot_core::link::{FrameReader, Header, RESPONSE_BYTES, Response, ResponseFrame};
use dashpot_files::damper;
use dashpot_host_link::{Desk, Link, LinkError, RetryLimits, SessionError};
use dashpot_testbench::excitation::Excitation;

/// Long limits that cost no time: a simulated target never waits in real time, and over TCP an answer always arrives.
pub const RETRY_LIMITS: RetryLimits = RetryLimits {
    timeout: Duration::from_secs(300),
    tries: 30,
};

pub fn built(name: &str) -> Damper<f32> {
    let parameters = damper::load(name, &[]).unwrap();
    parameters.build(1e-3).unwrap()
}

/// Returns a simulated target whose three dampers differ from the driven ones.
pub fn desk() -> Desk<3> {
    Desk::new([
        built("reduced-vertical"),
        built("in-service"),
        built("reduced-lateral"),
    ])
    .unwrap()
}

/// The first `ticks` displacements of the synthetic ride (m).
pub fn ride(ticks: usize) -> Vec<f32> {
    let ride = Excitation::Ride.displacements_m(1e-3);
    ride.into_iter().take(ticks).map(|x| x as f32).collect()
}

pub fn motion(ticks: usize) -> impl FnMut() -> Result<Option<f32>, SessionError> {
    let mut ride = ride(ticks).into_iter();
    move || Ok(ride.next())
}

/// Simulated target whose answers pass through `change`.
pub struct Altered<F> {
    desk: Desk<3>,
    change: F,
    answers: VecDeque<u8>,
    reader: FrameReader<RESPONSE_BYTES>,
}

pub fn altered<F>(change: F) -> Altered<F>
where
    F: FnMut(Header, Response<'_>, &mut ResponseFrame) -> bool,
{
    Altered {
        desk: desk(),
        change,
        answers: VecDeque::new(),
        reader: FrameReader::new(),
    }
}

impl<F: FnMut(Header, Response<'_>, &mut ResponseFrame) -> bool> Link for Altered<F> {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.desk.send(bytes)?;
        let mut buffer = [0; 1024];
        let count = self.desk.receive(&mut buffer, Duration::ZERO)?;
        for byte in &buffer[..count] {
            if let Some(message) = self.reader.push(*byte) {
                let (header, response) = postcard::from_bytes(message.unwrap().bytes).unwrap();
                let mut frame = ResponseFrame::new();
                if (self.change)(header, response, &mut frame) {
                    self.answers.extend(frame.bytes());
                }
            }
        }
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], _: Duration) -> Result<usize, LinkError> {
        let count = buffer.len().min(self.answers.len());
        for (place, byte) in buffer.iter_mut().zip(self.answers.drain(..count)) {
            *place = byte;
        }
        Ok(count)
    }
}

/// Serves a target over a line until the host disconnects.
pub fn serve(
    mut line: impl Read + Write + Send + 'static,
    target: impl FnOnce() -> Box<dyn Link> + Send + 'static,
) {
    std::thread::spawn(move || answer(&mut line, &mut *target()));
}

fn answer(line: &mut (impl Read + Write), target: &mut dyn Link) {
    let mut buffer = [0; 1024];
    loop {
        let received = match line.read(&mut buffer) {
            Ok(count) if count > 0 => count,
            Err(error) if error.kind() == ErrorKind::TimedOut => continue,
            _ => return,
        };
        target.send(&buffer[..received]).unwrap();
        let count = target.receive(&mut buffer, Duration::ZERO).unwrap();
        if line.write_all(&buffer[..count]).is_err() {
            return;
        }
    }
}

/// Serves a target to one client after another; returns HOST:PORT.
pub fn serve_tcp(target: impl FnOnce() -> Box<dyn Link> + Send + 'static) -> String {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let address = listener.local_addr().unwrap();
    std::thread::spawn(move || {
        let mut target = target();
        for line in listener.incoming() {
            answer(&mut line.unwrap(), &mut *target);
        }
    });
    address.to_string()
}
