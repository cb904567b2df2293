//! What a slave measures and what can be calibrated.

use std::net::SocketAddr;

use dashpot_core::crc_32;

/// A measured value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Measurement {
    /// Name, of letters, digits and underscores.
    pub name: String,
    /// In words.
    pub description: String,
    /// Unit; `1` without one.
    pub unit: String,
}

/// A value that can be calibrated.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Name; its parts are separated by points.
    pub name: String,
    /// In words.
    pub description: String,
    /// Unit; `1` without one.
    pub unit: String,
    /// Smallest value that a tool offers.
    pub min: f64,
    /// Largest value that a tool offers.
    pub max: f64,
}

/// A slave: its values in the order of their addresses, and its address in the network.
#[derive(Debug, Clone, PartialEq)]
pub struct Description {
    /// Name.
    pub name: String,
    /// Measured values.
    pub measurements: Vec<Measurement>,
    /// Values that can be calibrated.
    pub parameters: Vec<Parameter>,
    /// Name of each page of the parameters.
    pub pages: Vec<&'static str>,
    /// Name of the event channel.
    pub event: &'static str,
    /// Time between two events, s.
    pub step_s: f64,
    /// Address of UDP and TCP.
    pub address: SocketAddr,
    /// Largest packet of samples, bytes.
    pub max_dto: u16,
}

impl Description {
    /// A slave without values, with events of 1 ms.
    pub fn new(name: &str, address: SocketAddr) -> Self {
        Self {
            name: name.to_owned(),
            measurements: Vec::new(),
            parameters: Vec::new(),
            pages: Vec::new(),
            event: "tick",
            step_s: 1e-3,
            address,
            max_dto: 1400,
        }
    }

    /// Names the layout of the memory: a tool compares it with that of its A2L file.
    pub fn epk(&self) -> String {
        let measured = self.measurements.iter().map(|value| &value.name);
        let parameters = self.parameters.iter().map(|value| &value.name);
        let names: Vec<&str> = measured.chain(parameters).map(String::as_str).collect();
        format!("dashpot-{:08x}", crc_32(names.join("\n").as_bytes()))
    }

    /// Cycle of the event and its unit as a power of ten of a nanosecond; 0 for a cycle that no byte holds.
    ///
    /// ```
    /// use dashpot_host_link::a2l::Description;
    /// let mut slave = Description::new("coach", "127.0.0.1:5555".parse()?);
    /// assert_eq!(slave.cycle(), (1, 6));
    /// slave.step_s = 250e-6;
    /// assert_eq!(slave.cycle(), (25, 4));
    /// # Ok::<(), std::net::AddrParseError>(())
    /// ```
    pub fn cycle(&self) -> (u8, u8) {
        let step_ns = (self.step_s * 1e9).round() as u64;
        let found = (0..=9).rev().find_map(|unit| {
            let unit_ns = 10_u64.pow(unit.into());
            let cycle = u8::try_from(step_ns / unit_ns).ok()?;
            (cycle > 0 && step_ns.is_multiple_of(unit_ns)).then_some((cycle, unit))
        });
        found.unwrap_or((0, 0))
    }
}
