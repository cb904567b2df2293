//! A simulated device with two dampers behind a link, and the requests of a host.
#![allow(dead_code)] // each test uses only a part

use dashpot::damper;
use dashpot_core::link::{
    Clock, Counters, Device, Forces, FrameReader, Header, PROTOCOL, RESPONSE_BYTES, Reals, Refusal,
    Request, Response, Sample, request_frame,
};
use dashpot_core::{Damper, DamperState};

pub const SESSION: u16 = 77;

pub fn built(name: &str, overrides: &[&str]) -> Damper<f32> {
    damper(name, overrides).build(1e-3).unwrap()
}

/// Two different dampers behind a link, and the header of the next request.
pub struct Bench {
    pub device: Box<Device<2, 2>>,
    pub dampers: [Damper<f32>; 2],
    pub header: Header,
}

/// An answer from the device.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer(Vec<u8>);

impl Answer {
    pub fn response(&self) -> (Header, Response<'_>) {
        postcard::from_bytes(&self.0).unwrap()
    }
    pub fn refusal(&self) -> Option<Refusal> {
        match self.response().1 {
            Response::Refused(refusal) => Some(refusal),
            _ => None,
        }
    }
    pub fn forces(&self) -> Forces {
        match self.response().1 {
            Response::Forces(forces) => forces,
            other => panic!("{other:?}"),
        }
    }
}

pub fn reals(values: [f32; 2]) -> Reals {
    values.into_iter().collect()
}

impl Bench {
    pub fn new() -> Self {
        let dampers = [built("in-service", &[]), built("reduced-vertical", &[])];
        let clock = Clock::new(|| 0, 1);
        let mut device = Box::new(Device::new());
        device.start(&dampers.each_ref(), clock).unwrap();
        let header = Header {
            session: SESSION,
            sequence: 0,
        };
        Self {
            device,
            dampers,
            header,
        }
    }

    /// A bench with an open session.
    pub fn open() -> Self {
        let mut bench = Self::new();
        let hello = bench.ask(&Request::Hello { protocol: PROTOCOL });
        assert!(matches!(hello.response().1, Response::Welcome(_)));
        bench
    }

    pub fn feed(&mut self, bytes: &[u8]) -> Vec<Answer> {
        let mut answers = Vec::new();
        for byte in bytes {
            let mut answered = self.device.receive(*byte);
            while self.device.is_busy() {
                answered = self.device.advance();
            }
            if answered {
                let mut reader = FrameReader::<RESPONSE_BYTES>::new();
                let response = self.device.response().to_vec();
                let message = response.iter().find_map(|byte| {
                    reader
                        .push(*byte)
                        .map(|message| message.unwrap().bytes.to_vec())
                });
                answers.push(Answer(message.unwrap()));
            }
        }
        answers
    }

    pub fn send(&mut self, header: Header, request: &Request<'_>) -> Answer {
        let frame = request_frame(header, request);
        let mut answers = self.feed(frame.bytes());
        assert_eq!(answers.len(), 1);
        answers.remove(0)
    }

    pub fn ask(&mut self, request: &Request<'_>) -> Answer {
        self.header.sequence += 1;
        self.send(self.header, request)
    }

    pub fn done(&mut self, request: &Request<'_>) {
        let answer = self.ask(request);
        assert_eq!(answer.response(), (self.header, Response::Done));
    }

    pub fn step(&mut self, tick: u32, x: [f32; 2]) -> Answer {
        self.ask(&Request::Step {
            tick,
            displacements_m: reals(x),
        })
    }

    /// Returns the tick, and the states as bytes.
    pub fn states(&self) -> (u32, Vec<u8>) {
        let states = self.device.states().iter();
        let bytes = states.flat_map(DamperState::<f32>::to_bytes);
        (self.device.tick_number(), bytes.collect())
    }

    pub fn counters(&self) -> Counters {
        self.device.counters()
    }

    pub fn load(&mut self, damper: u8, image: &[u8]) -> Answer {
        self.ask(&Request::Load { damper, image })
    }

    pub fn telemetry(&mut self, damper: u8) -> (u32, Vec<Sample>) {
        match self.ask(&Request::Telemetry { damper }).response().1 {
            Response::Telemetry {
                overwritten,
                samples,
            } => (overwritten, samples.to_vec()),
            other => panic!("{other:?}"),
        }
    }

    /// Status bits and rejected inputs.
    pub fn status(&mut self, request: &Request<'_>) -> (Vec<u16>, Vec<u16>) {
        match self.ask(request).response().1 {
            Response::Status {
                status,
                rejected_inputs,
            } => (status.to_vec(), rejected_inputs.to_vec()),
            other => panic!("{other:?}"),
        }
    }
}
