//! A master that speaks with a slave directly.

use dashpot_core::xcp::ErrorCode;
use dashpot_host_link::a2l::{Description, Measurement, Parameter};
use dashpot_host_link::xcp::{Image, Parameters, Slave};

/// Address of the first parameter.
pub const PARAMETERS: u32 = 0x2000_0000;

/// Sets up one list with one table of two entries, each a value, and starts it.
pub const LIST: [&[u8]; 9] = [
    &[0xD6],
    &[0xD5, 0, 1, 0],
    &[0xD4, 0, 0, 0, 1],
    &[0xD3, 0, 0, 0, 0, 2],
    &[0xE2, 0, 0, 0, 0, 0],
    &[0xE1, 0xFF, 8, 0, 0, 0, 0, 0x10],
    &[0xE1, 0xFF, 8, 0, 8, 0, 0, 0x10],
    &[0xE0, 0x10, 0, 0, 0, 0, 1, 0],
    &[0xDE, 1, 0, 0],
];

/// Two pages of three parameters, none of which may be negative.
#[derive(Clone)]
pub struct Pages {
    pub values: [[f64; 3]; 2],
    pub page: u8,
}

impl Parameters for Pages {
    fn pages(&self) -> u8 {
        2
    }
    fn values(&self, page: u8) -> &[f64] {
        self.values
            .get(usize::from(page))
            .map_or(&[], |values| values)
    }
    fn write(&mut self, page: u8, first: usize, values: &[f64]) -> Result<(), ErrorCode> {
        if values.iter().any(|value| value.is_nan() || *value < 0.0) {
            return Err(ErrorCode::OutOfRange);
        }
        self.values[usize::from(page)][first..first + values.len()].copy_from_slice(values);
        Ok(())
    }
    fn page(&self) -> u8 {
        self.page
    }
    fn use_page(&mut self, page: u8) -> Result<(), ErrorCode> {
        self.page = page;
        Ok(())
    }
}

/// A slave with `measured` values.
pub fn description(measured: usize) -> Description {
    let mut slave = Description::new("test vehicle", "127.0.0.1:5555".parse().unwrap());
    slave.measurements = (0..measured)
        .map(|number| Measurement {
            name: format!("value_{number}_m_per_s2"),
            description: format!("value \"{number}\""),
            unit: "m/s²".into(),
        })
        .collect();
    slave.parameters = ["clearance_m", "stiffness_n_per_m", "temperature_c"]
        .iter()
        .map(|name| Parameter {
            name: format!("damper_1.mount.{name}"),
            description: "a parameter".into(),
            unit: "°C".into(),
            min: 0.0,
            max: 1e9,
        })
        .collect();
    slave.pages = vec!["as new", "worn"];
    slave
}

/// A slave and its memory.
pub struct Test {
    pub slave: Box<Slave>,
    pub image: Image<Pages>,
}

impl Test {
    /// A slave with eight values and three parameters, without a session.
    pub fn new() -> Self {
        let pages = Pages {
            values: [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]],
            page: 0,
        };
        let mut image = Image::new(&description(8), pages);
        image.update(0.001, &[0.5; 8]);
        Self {
            slave: Box::default(),
            image,
        }
    }

    /// The same with a session.
    pub fn connected() -> Self {
        let mut test = Self::new();
        assert_eq!(test.ask(&[0xFF, 0]).len(), 7);
        test
    }

    /// The data of the response to a packet, which must be positive.
    #[track_caller]
    pub fn ask(&mut self, packet: &[u8]) -> Vec<u8> {
        let response = self.slave.receive(packet, &mut self.image).unwrap();
        assert_eq!(response[0], 0xFF, "{packet:x?}: {response:x?}");
        response[1..].to_vec()
    }

    /// The error code of the response to a packet.
    #[track_caller]
    pub fn refused(&mut self, packet: &[u8]) -> u8 {
        let response = self.slave.receive(packet, &mut self.image).unwrap();
        assert_eq!((response.len(), response[0]), (2, 0xFE), "{packet:x?}");
        response[1]
    }

    /// One list with one table of two entries, each a value, which is started if wanted.
    pub fn with_list(is_started: bool) -> Self {
        let mut test = Self::connected();
        let (start, configure) = LIST.split_last().unwrap();
        for packet in configure {
            test.ask(packet);
        }
        if is_started {
            test.ask(start);
        }
        test
    }

    /// The packets of samples of a tick.
    pub fn sample(&mut self) -> Vec<Vec<u8>> {
        let mut packets = Vec::new();
        let count = self
            .slave
            .sample(0, &self.image, |packet| packets.push(packet.to_vec()));
        assert_eq!(count, packets.len());
        packets
    }
}
