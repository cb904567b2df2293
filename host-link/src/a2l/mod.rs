//! Descriptions of a slave's memory for measurement and calibration tools: A2L (ASAM MCD-2 MC, ASAP2 version 1.61).

mod aml;
mod description;
mod interface;
pub(crate) mod layout;
mod objects;

pub use description::{Description, Measurement, Parameter};

use std::fmt::{self, Write};

/// Writes the A2L file of a slave.
///
/// ```
/// use dashpot_host_link::a2l::{Description, Measurement, write};
/// let mut slave = Description::new("coach", "127.0.0.1:5555".parse()?);
/// slave.measurements.push(Measurement {
///     name: "time_s".into(),
///     description: "time".into(),
///     unit: "s".into(),
/// });
/// let text = write(&slave);
/// assert!(text.contains("/begin MEASUREMENT time_s \"time\" FLOAT64_IEEE unit_s 0 0"));
/// # Ok::<(), std::net::AddrParseError>(())
/// ```
pub fn write(slave: &Description) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _written = write_to(&mut text, slave);
    text
}

fn write_to(out: &mut String, slave: &Description) -> fmt::Result {
    let name = identifier(&slave.name);
    writeln!(out, "ASAP2_VERSION 1 61")?;
    writeln!(out, "/begin PROJECT dashpot \"Dashpot\"")?;
    writeln!(out, "/begin MODULE {name} {}", quoted(&slave.name))?;
    write!(out, "{}", aml::A2ML)?;
    interface::write_memory(out, slave)?;
    interface::write_protocol(out, slave)?;
    objects::write(out, slave)?;
    writeln!(out, "/end MODULE")?;
    writeln!(out, "/end PROJECT")
}

/// A text in quotation marks, in ASCII.
fn quoted(text: &str) -> String {
    let escaped = ascii(text).replace('\\', "\\\\").replace('"', "\\\"");
    format!("\"{escaped}\"")
}

/// A text in ASCII, as old tools read it.
fn ascii(text: &str) -> String {
    let known = text.replace('°', "deg").replace('²', "2").replace('³', "3");
    known.replace(|letter: char| !(' '..='~').contains(&letter), "?")
}

/// The form of a name in A2L: letters, digits and underscores.
fn identifier(name: &str) -> String {
    let name = name.replace(|letter: char| !letter.is_ascii_alphanumeric(), "_");
    match name.starts_with(|letter: char| letter.is_ascii_digit()) || name.is_empty() {
        true => format!("_{name}"),
        false => name,
    }
}
